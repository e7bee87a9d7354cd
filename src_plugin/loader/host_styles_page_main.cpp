// SPDX-License-Identifier: GPL-2.0-or-later
// Prints docs/with_liggghts.md.
#include <cstdio>

#include "loader/host_styles_page.h"

int main() { fputs(spherocylinder::host_styles_page().c_str(), stdout); }
