// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Classes of an input that options name.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"

#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// The names that texts ask for, each once, and which of them are no class of the input: these are
/// among the names as they were written, and nothing is of them.
struct NamedClasses {
  std::vector<std::string> names;
  std::vector<Finding> findings;
};

/// Of the classes of an input (`asked_names`); findings and errors name `option`.
/// Errors: those of asked_names; kNotFound for a prefix or an expression that no class fits.
[[nodiscard]] Result<NamedClasses> named_classes(std::span<const std::string> texts,
                                                 const char* option,
                                                 const ClassRegistry& classes,
                                                 const ClassVocabulary& vocabulary);

}  // namespace hypermap
