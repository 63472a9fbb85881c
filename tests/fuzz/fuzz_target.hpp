// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What fuzz targets have in common: a reader of strangers' bytes each, and as oracle its writer.
///
/// Without a finding a target returns; a broken promise ends the program, as the fuzzer asks for.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>

namespace hypermap::fuzz {

inline const SourceName kFuzzSource{.file = "fuzzed"};

inline void require(bool holds, std::string_view promise) {
  if (holds) return;
  std::cerr << "broken promise: " << promise << "\n";
  std::abort();
}

template <class T>
const T& require(const Result<T>& result, std::string_view promise) {
  if (!result) std::cerr << to_string(result.error()) << "\n";
  require(result.has_value(), promise);
  return *result;
}

inline const std::string& require(const std::string& text, std::string_view /*promise*/) {
  return text;
}

/// What `read` takes, `write` can write; that reads as an equal value and is written to the same
/// bytes. `write` gives text, or a result.
template <class Read, class Write, class Equal = std::equal_to<>>
void require_round_trip(std::string_view bytes, Read read, Write write, Equal equal = {}) {
  const auto first = read(bytes);
  if (!first) return;
  const std::string written = require(write(*first), "what was read can be written");
  const auto again = read(std::string_view(written));
  require(equal(require(again, "what was written is read"), *first),
          "what was written reads as an equal value");
  require(require(write(*again), "what was read again can be written") == written,
          "equal values are written to equal bytes");
}

/// The bytes as a file of this name, for readers of paths: in a folder of this process.
[[nodiscard]] std::filesystem::path file_of(std::string_view bytes, const std::string& name);

}  // namespace hypermap::fuzz
