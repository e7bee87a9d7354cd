// SPDX-License-Identifier: GPL-2.0-or-later
// Joining numbered pictures to a film with the program ffmpeg.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace spherocylinder {

CLI::Validator film_name();  // ends in .mp4 or .webm

// Joins NAME_0001.png, NAME_0002.png ... of `picture` NAME.png to the film `path`, `rate` pictures
// a second. Without ffmpeg on the PATH it says so in one line on stderr and leaves the pictures.
// Throws InputError if ffmpeg fails.
void write_film(const std::string &path, const std::string &picture, double rate);

}  // namespace spherocylinder
