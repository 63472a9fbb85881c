// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rules that name classes, said of all that the names mean.
#pragma once

#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/core/places/relation_options.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"

namespace hypermap {

/// What belongs where and how large it is, also by aliases and of what is of a super-class that the
/// rules name: each name has its own rule, else that of its class, else that of the nearest
/// super-class with one. Boundary: an empty vocabulary changes nothing.
[[nodiscard]] PlaceRules with_vocabulary(PlaceRules rules, const ClassVocabulary& vocabulary);

/// Holders, parts and wholes, also by their aliases and of what is of super-classes among them.
/// Boundary: an empty vocabulary changes nothing.
[[nodiscard]] RelationOptions with_vocabulary(RelationOptions options,
                                              const ClassVocabulary& vocabulary);

}  // namespace hypermap
