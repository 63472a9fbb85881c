// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Relations as a sentence.
#pragma once

#include "hypermap/core/places/relations.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace hypermap {

/// How an object is called: "cup 12".
using ObjectNaming = std::function<std::string(ObjectId)>;

/// "cup 12 is on diningtable 3 by refrigerator 2, beside bottle 7": of what it is on, in, under or
/// a part of, the nearest that is beside that is told, too. What rests on the floor is said to, and
/// of what nothing supports (kUnknown), that what it stands on was not seen or has no class.
/// `place` stands first: "cup 12 is in the kitchen (room 2), on diningtable 3"; empty: nothing is
/// said of it. Requires: the graph knows the object.
[[nodiscard]] std::string sentence_of(const RelationGraph& graph,
                                      ObjectId id,
                                      const ObjectNaming& naming,
                                      std::string_view place = {});

}  // namespace hypermap
