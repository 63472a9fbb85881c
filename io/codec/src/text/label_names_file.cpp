// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/label_names_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <charconv>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxLabelNameBytes = 256;

std::optional<std::int64_t> whole_number(const std::string& text) {
  std::int64_t number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

Result<std::map<std::int64_t, std::string>> label_names_of(const YamlNode& root) {
  std::map<std::int64_t, std::string> names;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, root.as_map());
  for (const auto& [key, node] : entries) {
    const auto label = whole_number(key);
    if (!label) return Unexpected(node.error("its key must be a whole number"));
    if (node.is_null()) continue;
    HYPERMAP_ASSIGN_OR_RETURN(std::string name, node.as_string());
    if (name.empty() || name.size() > kMaxLabelNameBytes)
      return Unexpected(node.error("must be a name of 1 to 256 bytes"));
    names[*label] = std::move(name);
  }
  if (names.empty()) return Unexpected(root.error("names no label"));
  return names;
}

}  // namespace

Result<std::map<std::int64_t, std::string>> parse_label_names(std::string_view yaml,
                                                              const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(yaml, source));
  return label_names_of(document.root());
}

Result<std::map<std::int64_t, std::string>> read_label_names(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  return label_names_of(document.root());
}

}  // namespace hypermap
