// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where bytes came from, as errors name it.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <string>
#include <utility>

namespace hypermap {

/// A file as the caller named it, and within an archive the member.
struct SourceName {
  std::string file;
  std::string entry = {};
};

/// `error` with the parts of `source` that it does not name yet.
[[nodiscard]] inline Error with_source(Error error, const SourceName& source) {
  if (error.file.empty()) error.file = source.file;
  if (error.entry.empty()) error.entry = source.entry;
  return error;
}

}  // namespace hypermap
