// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The option by which a call says what the names of classes mean.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

/// `--class-names FILE`: for this call, instead of what the map says.
struct ClassNames {
  std::string file;

  void add_to(CLI::App& command, const char* effect = "instead of those that the map keeps");
  /// The vocabulary of the file; none when none was given. Errors: those of read_vocabulary.
  [[nodiscard]] Result<std::optional<ClassVocabulary>> given() const;
  /// Puts that of the file, if one was given, in the place of `vocabulary`. Errors: as `given`.
  [[nodiscard]] Result<void> replace(ClassVocabulary& vocabulary) const;
};

}  // namespace hypermap::app
