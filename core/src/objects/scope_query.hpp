// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects of a scope, found by place.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/objects/object_scope.hpp"

#include <vector>

namespace hypermap {

/// Around the cone from its apex on. Requires: its half angle is below a quarter turn.
[[nodiscard]] Box bounds(const ActiveCone& cone);

/// Those that the scope contains, ascending. Requires: each has its centroid in its box.
/// Cost: with a cone that of the objects around it, at any number of others; else one pass.
[[nodiscard]] std::vector<ObjectId> objects_in(const ObjectMap& objects, const ObjectScope& scope);

}  // namespace hypermap
