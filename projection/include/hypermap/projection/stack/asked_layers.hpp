// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which layers of a stack a text asks for.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The full names of the layers, ascending, that `text` means, the first of these that fits:
/// 1. The layer of that name, with or without the stack's parent before it, and all below it.
/// 2. Layers whose name below the parent is a class that `asked_names` finds: by an alias, a
///    super-class, a prefix or an expression.
///
/// Errors: kNotFound when none fits, telling the names that were looked for or those that there
/// are; those of asked_names; all with the field "layers".
[[nodiscard]] Result<std::vector<std::string>> asked_layers(std::string_view text,
                                                            const GridStack& stack,
                                                            const ClassVocabulary& vocabulary);

}  // namespace hypermap
