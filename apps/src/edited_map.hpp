// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Commands that make one archive of another: read, edit, save, say.
#pragma once

#include "command.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "load_arguments.hpp"

#include <functional>
#include <string>

namespace hypermap::app {

struct EditedMap {
  MapArchive map;
  std::string text = {};                ///< Lines to print when it is written.
  ExitCode findings = ExitCode::kDone;  ///< kFindings when the edit told of something on stderr.
};

using MapEdit = std::function<Result<EditedMap>(MapArchive whole)>;

/// Reads the archive `file`, writes what `edit` makes of it as `output`, prints its text, and
/// reports what was found while reading. An error of `edit` that names no file is of `file`;
/// nothing is written then.
ExitCode run_edit(const std::string& file,
                  const std::string& output,
                  const LoadArguments& load,
                  const MapEdit& edit);

}  // namespace hypermap::app
