// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's contact model templates. They need these headers before them, in this order.
#pragma once

// clang-format off
#include "fix_mesh_surface.h"
#include "global_properties.h"
#include "neighbor.h"
#include "vector_liggghts.h"
#include "modify.h"
#include "contact_models.h"
// clang-format on
