// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The names that a question asks for.
#pragma once

#include "hypermap/core/base/class_registry.hpp"

#include <algorithm>
#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// Some names, each in any spelling (`canonical_class_name`). A value.
class NameSelection {
 public:
  /// Implicit, as one name is a question: that name.
  template <std::convertible_to<std::string_view> Text>
  NameSelection(const Text& name)  // NOLINT(google-explicit-constructor)
      : canonical_{canonical_class_name(name)} {}

  /// These names. Requires: canonical, ascending, each once.
  [[nodiscard]] static NameSelection of_canonical(std::vector<std::string> names) {
    return NameSelection(std::move(names), Canonical());
  }

  /// Whether `name` is one of them. Cost: log n comparisons.
  [[nodiscard]] bool contains(std::string_view name) const {
    return std::binary_search(canonical_.begin(), canonical_.end(), canonical_class_name(name));
  }

  /// Ascending.
  [[nodiscard]] std::span<const std::string> canonical_names() const noexcept { return canonical_; }

  friend bool operator==(const NameSelection&, const NameSelection&) = default;

 private:
  struct Canonical {};
  NameSelection(std::vector<std::string> names, Canonical /*form*/)
      : canonical_(std::move(names)) {}

  std::vector<std::string> canonical_;
};

}  // namespace hypermap
