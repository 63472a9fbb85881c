// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Relations as a sentence.
#pragma once

#include "hypermap/core/places/relations.hpp"

#include <functional>
#include <string>

namespace hypermap {

/// How an object is called: "cup 12".
using ObjectNaming = std::function<std::string(ObjectId)>;

/// "cup 12 is on diningtable 3, beside bottle 7"; what rests on the floor is said to, and of what
/// nothing supports (kUnknown), that what it stands on was not seen or has no class.
/// Requires: the graph knows the object.
[[nodiscard]] std::string sentence_of(const RelationGraph& graph,
                                      ObjectId id,
                                      const ObjectNaming& naming);

}  // namespace hypermap
