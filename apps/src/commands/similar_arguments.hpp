// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What objects are compared with: the options of `query --embedding`.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/similar_query.hpp"

#include <CLI/App.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace hypermap::app {

struct SimilarArguments {
  std::optional<std::string> embedding;
  std::optional<std::string> model;
  std::optional<std::size_t> top;

  void add_to(CLI::App& command);
  [[nodiscard]] bool is_asked() const { return embedding.has_value(); }
  /// `--model` or `--top` without `--embedding`.
  [[nodiscard]] bool is_incomplete() const { return !embedding && (model || top); }
};

/// Reads the vector. Errors: those of read_embedding_file; kInvalidArgument when file and command
/// line name different models. Requires: is_asked().
[[nodiscard]] Result<SimilarTo> read_vector(const SimilarArguments& arguments);

}  // namespace hypermap::app
