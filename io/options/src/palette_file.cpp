// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/palette_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// Of "#rrggbb".
std::optional<Rgb8> parse_color(std::string_view text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return Rgb8{static_cast<std::uint8_t>(value >> 16U),
              static_cast<std::uint8_t>((value >> 8U) & 0xFFU),
              static_cast<std::uint8_t>(value & 0xFFU)};
}

}  // namespace

Result<ClassPalette> read_palette(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, document.root().as_map());
  ClassPalette palette;
  for (const auto& [name, node] : entries) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
    const auto color = parse_color(text);
    if (!color) {
      return Unexpected(node.error("must be a colour as \"#rrggbb\" in quotes, is \"" +
                                   printable(text, 40) + "\""));
    }
    const auto set = palette.set(name, *color);
    if (!set) return Unexpected(node.error(set.error().what));
  }
  return palette;
}

}  // namespace hypermap
