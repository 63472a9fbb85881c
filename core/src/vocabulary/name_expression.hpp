// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A regular expression over names, within bounds of time and memory.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace hypermap {

/// Threads: one at a time.
class NameExpression {
 public:
  /// Errors: kInvalidArgument with the place of what is wrong.
  [[nodiscard]] static Result<NameExpression> create(std::string_view expression);

  /// Whether it matches the whole name, upper and lower case alike. Requires: UTF-8.
  /// Errors: kLimit.
  [[nodiscard]] Result<bool> matches(std::string_view name) const;

 private:
  struct Compiled;
  explicit NameExpression(std::shared_ptr<const Compiled> compiled)
      : compiled_(std::move(compiled)) {}

  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace hypermap
