// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "scene.h"

namespace decks {

// Distance of two rods' axes (segments) by search, with nothing in common with the plug-in: for a
// point of the first the nearest of the second is a clamp; the distance is convex along the first,
// so that golden-section search finds its minimum (to 10^-9 of the length).
double slow_distance(const Rod &a, const Rod &b);

}  // namespace decks
