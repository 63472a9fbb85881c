// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/options_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "option_row.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kPresetKey = "preset";

std::vector<OptionRow> all_rows() {
  std::vector<OptionRow> rows;
  for (auto part : {map_option_rows(),
                    segmentation_option_rows(),
                    association_option_rows(),
                    presence_option_rows(),
                    layer_option_rows()}) {
    std::move(part.begin(), part.end(), std::back_inserter(rows));
  }
  return rows;
}

const OptionRow* find_row(const std::vector<OptionRow>& rows, std::string_view name) {
  const auto found = std::find_if(
      rows.begin(), rows.end(), [&](const OptionRow& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

bool is_section(const std::vector<OptionRow>& rows, const std::string& name) {
  return std::any_of(rows.begin(), rows.end(), [&](const OptionRow& row) {
    return row.name.starts_with(name + ".");
  });
}

/// "unknown option, did you mean ...?"; the nearest may be a section.
std::string unknown_text(const std::vector<OptionRow>& rows, const std::string& name) {
  std::vector<std::string_view> names{kPresetKey};
  for (const OptionRow& row : rows) {
    const std::string_view full = row.name;
    names.push_back(full);
    for (std::size_t dot = full.find('.'); dot != full.npos; dot = full.find('.', dot + 1)) {
      names.push_back(full.substr(0, dot));
    }
  }
  const auto nearest = nearest_name(name, names);
  const std::string hint = nearest ? ", did you mean \"" + std::string(*nearest) + "\"?" : "";
  return "unknown option \"" + printable(name) + "\"" + hint;
}

Result<void> apply(const std::vector<OptionRow>& rows,
                   const YamlNode& node,
                   const std::string& prefix,
                   MapOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [key, value] : entries) {
    const std::string name = prefix + key;
    if (name == kPresetKey) continue;
    if (const OptionRow* row = find_row(rows, name)) {
      HYPERMAP_TRY(row->assign(options, value));
    } else if (is_section(rows, name)) {
      HYPERMAP_TRY(apply(rows, value, name + ".", options));
    } else {
      return Unexpected(value.error(unknown_text(rows, name), ErrorCode::kNotFound));
    }
  }
  return {};
}

Result<ObjectPipelineOptions> preset_from(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
  if (const auto name = preset_of(text)) return preset(*name);
  return Unexpected(node.error("must be one of default, smap, hypermap, is " + printable(text)));
}

std::string comment_of(const OptionRow& row) {
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  return row.effect + " " + row.range + unit + "; " + row.source;
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

Result<void> validate(const MapOptions& options) {
  HYPERMAP_TRY(validate(options.mapper));
  return validate(options.layers);
}

std::vector<OptionDescription> describe_options(const MapOptions& options) {
  std::vector<OptionDescription> out;
  for (const OptionRow& row : all_rows()) {
    out.push_back({row.name, row.text(options), row.unit, row.range, row.source, row.effect});
  }
  return out;
}

Result<MapOptions> with_option(const MapOptions& options,
                               std::string_view name,
                               std::string_view text) {
  const std::vector<OptionRow> rows = all_rows();
  const OptionRow* row = find_row(rows, name);
  if (row == nullptr) {
    return fail(ErrorCode::kNotFound, unknown_text(rows, std::string(name)), "option");
  }
  MapOptions out = options;
  const auto document = parse_yaml(text, SourceName{});
  Result<void> assigned =
      document ? row->assign(out, document->root()) : Unexpected(document.error());
  if (!assigned) {
    return fail(ErrorCode::kInvalidArgument, assigned.error().what, std::string(name));
  }
  HYPERMAP_TRY(validate(out));
  return out;
}

Result<MapOptions> read_options(const std::filesystem::path& path, const MapOptions& base) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  const YamlNode root = document.root();
  MapOptions out = base;
  if (const auto node = root.find(kPresetKey)) {
    HYPERMAP_ASSIGN_OR_RETURN(out.mapper.objects, preset_from(*node));
  }
  HYPERMAP_TRY(apply(all_rows(), root, "", out));
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
  for (const OptionRow& row : all_rows()) {
    const std::vector<std::string> parts = parts_of(row.name);
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
    out += indent + "# " + comment_of(row) + "\n";
    out += indent + parts.back() + ": " + row.text(options) + "\n";
  }
  return out;
}

}  // namespace hypermap
