// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's contact model templates. They need these headers before them, in this order.
#pragma once

#include "fix_mesh_surface.h"
#include "global_properties.h"
#include "neighbor.h"
#include "vector_liggghts.h"
// clang-format on
#include "modify.h"
// clang-format off
#include "contact_models.h"
