// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers in messages: shortest text that reads back equal, whatever the locale.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace hypermap {

[[nodiscard]] inline std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), error == std::errc{} ? end : buffer.data()};
}

}  // namespace hypermap
