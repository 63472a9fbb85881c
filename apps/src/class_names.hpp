// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the names of classes mean in a call, and which of them mean nothing in a map.
#pragma once

#include "command.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

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

/// Warns on stderr of the classes of `file`, by their canonical names, that neither the map nor its
/// vocabulary knows: what the file says of them does nothing. Returns kFindings for any, else
/// kDone.
ExitCode warn_of_unknown_classes(const MapArchive& archive,
                                 const std::string& file,
                                 const std::vector<std::string>& class_names);

}  // namespace hypermap::app
