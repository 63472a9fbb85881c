// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/options_file.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "option_yaml.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kPresetKey = "preset";

constexpr OptionRow kMapRows[] = {
    option::section<&MapOptions::mapper>(""),
    option::section<&MapOptions::layers>("projection"),
};

using BoundOptions = std::vector<BoundOption>;

BoundOptions options_of(MapOptions& options) {
  return bind_options(option_table(options), &options);
}

const BoundOption* find_option(const BoundOptions& options, std::string_view name) {
  const auto found = std::find_if(
      options.begin(), options.end(), [&](const auto& option) { return option.name == name; });
  return found == options.end() ? nullptr : &*found;
}

bool is_section(const BoundOptions& options, const std::string& name) {
  return std::any_of(options.begin(), options.end(), [&](const auto& option) {
    return option.name.starts_with(name + ".");
  });
}

/// Of what an options file has no key for. The nearest may be a section.
std::string unknown_text(const BoundOptions& options, const std::string& name) {
  std::vector<std::string_view> names{kPresetKey};
  for (const BoundOption& option : options) {
    const std::string_view full = option.name;
    names.push_back(full);
    for (std::size_t dot = full.find('.'); dot != full.npos; dot = full.find('.', dot + 1)) {
      names.push_back(full.substr(0, dot));
    }
  }
  return "unknown option \"" + printable(name) + "\"" + did_you_mean(name, names);
}

Result<void> apply(const BoundOptions& options, const YamlNode& node, const std::string& prefix) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [key, value] : entries) {
    const std::string name = prefix + key;
    if (name == kPresetKey) continue;
    if (const BoundOption* option = find_option(options, name)) {
      HYPERMAP_TRY(assign_yaml(*option, value));
    } else if (is_section(options, name)) {
      HYPERMAP_TRY(apply(options, value, name + "."));
    } else {
      return Unexpected(value.error(unknown_text(options, name), ErrorCode::kNotFound));
    }
  }
  return {};
}

/// Of a name that a value is given to: only whole ones can have one.
std::string no_option_text(const BoundOptions& options, const std::string& name) {
  std::vector<std::string_view> names;
  names.reserve(options.size());
  for (const BoundOption& option : options) names.emplace_back(option.name);
  if (!is_section(options, name)) {
    return "unknown option \"" + printable(name) + "\"" + did_you_mean(name, names);
  }
  const auto first = std::ranges::find_if(
      names, [&](std::string_view one) { return one.starts_with(name + "."); });
  return "\"" + name + "\" is a group of options, such as \"" + std::string(*first) + "\"";
}

Result<void> set_option(MapOptions& options, std::string_view name, std::string_view text) {
  const BoundOptions known = options_of(options);
  const BoundOption* option = find_option(known, name);
  if (option == nullptr) {
    return fail(ErrorCode::kNotFound, no_option_text(known, std::string(name)), "option");
  }
  const auto document = parse_yaml(text, SourceName{});
  const Result<void> assigned =
      document ? assign_yaml(*option, document->root()) : Unexpected(document.error());
  if (assigned) return {};
  return fail(ErrorCode::kInvalidArgument, assigned.error().what, std::string(name));
}

Result<ObjectPipelineOptions> preset_from(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
  if (const auto name = preset_of(text)) return preset(*name);
  return Unexpected(node.error(not_one_of(text, preset_names())));
}

std::string comment_of(const OptionRow& row) {
  const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
  return std::string(row.effect) + " " + range_text(row) + unit + "; " + std::string(row.source);
}

/// Parts of a dotted name.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back().push_back(c);
    }
  }
  return parts;
}

}  // namespace

const OptionTable& option_table(const MapOptions&) {
  static constexpr OptionTable kTable{kMapRows};
  return kTable;
}

Result<void> validate(const MapOptions& options) {
  return check_options(MapOptions{with_ranges(options.mapper), options.layers});
}

std::vector<OptionDescription> describe_options(const MapOptions& options) {
  MapOptions described = options;
  std::vector<OptionDescription> out;
  for (const BoundOption& option : options_of(described)) {
    const OptionRow& row = *option.row;
    out.push_back({.name = option.name,
                   .value = yaml_text(option),
                   .unit = std::string(row.unit),
                   .range = range_text(row),
                   .choices = {row.choices.begin(), row.choices.end()},
                   .source = std::string(row.source),
                   .effect = std::string(row.effect)});
  }
  return out;
}

Result<MapOptions> with_option(const MapOptions& options,
                               std::string_view name,
                               std::string_view text) {
  MapOptions out = options;
  HYPERMAP_TRY(set_option(out, name, text));
  HYPERMAP_TRY(validate(out));
  return out;
}

Result<void> check_option(std::string_view name, std::string_view text) {
  MapOptions scratch;
  return set_option(scratch, name, text);
}

Result<MapOptions> read_options(const std::filesystem::path& path, const MapOptions& base) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  const YamlNode root = document.root();
  MapOptions out = base;
  if (const auto node = root.find(kPresetKey)) {
    HYPERMAP_ASSIGN_OR_RETURN(out.mapper.objects, preset_from(*node));
  }
  HYPERMAP_TRY(apply(options_of(out), root, ""));
  if (auto ok = validate(out); !ok) {
    Error error = std::move(ok).error();
    error.file = path.string();
    return Unexpected(std::move(error));
  }
  return out;
}

std::string write_options(const MapOptions& options) {
  std::string out;
  std::vector<std::string> open;
  MapOptions written = options;
  for (const BoundOption& option : options_of(written)) {
    const std::vector<std::string> parts = parts_of(option.name);
    const std::size_t depth = parts.size() - 1;
    std::size_t shared = 0;
    while (shared < depth && shared < open.size() && open[shared] == parts[shared]) ++shared;
    for (std::size_t level = shared; level < depth; ++level) {
      if (level == 0 && !out.empty()) out += "\n";
      out += std::string(2 * level, ' ') + parts[level] + ":\n";
    }
    open.assign(parts.begin(), parts.end() - 1);
    const std::string indent(2 * depth, ' ');
    if (depth == 0) out += "\n";
    out += indent + "# " + comment_of(*option.row) + "\n";
    out += indent + parts.back() + ": " + yaml_text(option) + "\n";
  }
  return out;
}

}  // namespace hypermap
