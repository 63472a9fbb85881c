// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_sizes.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "layers/layer_files.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// A part by the name or the stem of its members.
struct NamedPart {
  std::string file;
  PartSize size;
};

std::string_view before_dot(std::string_view member) {
  return member.substr(0, member.find('.'));
}

std::vector<NamedPart> named_parts(const HypermapConfig& config) {
  std::vector<NamedPart> parts;
  parts.push_back({std::string(kConfigName), {.name = "configuration"}});
  for (const LayerEntry& layer : config.layers) {
    parts.push_back({stem_of(layer.info), {.name = layer.info.name, .kind = layer.class_name}});
  }
  for (const ExtensionEntry& extension : config.extensions) {
    parts.push_back({extension.file, {.name = extension.name, .kind = extension.format}});
  }
  return parts;
}

/// The part that a member is of: the one that names it, else the one whose stem it has.
NamedPart* part_of(std::vector<NamedPart>& parts, std::string_view member) {
  const auto find = [&](std::string_view file) {
    const auto found = std::ranges::find(parts, file, &NamedPart::file);
    return found == parts.end() ? nullptr : &*found;
  };
  NamedPart* named = find(member);
  return named != nullptr ? named : find(before_dot(member));
}

/// Sizes of the members, part by part.
std::vector<PartSize> part_sizes(const HypermapConfig& config, const ZipReader& zip) {
  std::vector<NamedPart> parts = named_parts(config);
  NamedPart others{{}, {.name = "other members"}};
  for (const ZipMember& member : zip.members()) {
    NamedPart* part = part_of(parts, member.name);
    PartSize& size = part != nullptr ? part->size : others.size;
    size.num_bytes += member.num_bytes;
    size.num_packed_bytes += member.num_packed_bytes;
  }
  if (others.size.num_bytes > 0) parts.push_back(std::move(others));
  std::vector<PartSize> sizes;
  sizes.reserve(parts.size());
  for (NamedPart& part : parts) sizes.push_back(std::move(part.size));
  std::ranges::stable_sort(sizes, std::greater(), &PartSize::num_packed_bytes);
  return sizes;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

/// Keys of a JSON object, each with the text of its value. Requires: one of our own writing, whose
/// keys have no escapes.
std::vector<std::pair<std::string_view, std::string_view>> members_of_line(std::string_view line) {
  std::vector<std::pair<std::string_view, std::string_view>> members;
  int depth = 0;
  bool is_text = false;
  std::size_t begin = 1;
  const auto close_member = [&](std::size_t end) {
    const std::string_view member = line.substr(begin, end - begin);
    const std::size_t colon = member.find(':');
    members.emplace_back(member.substr(1, colon - 2), member.substr(colon + 1));
    begin = end + 1;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_text) {
      if (c == '\\') ++i;
      is_text = c != '"';
    } else if (c == '"') {
      is_text = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      if (--depth == 0) close_member(i);
    } else if (c == ',' && depth == 1) {
      close_member(i);
    }
  }
  return members;
}

/// The packed size of each text by itself, in their order.
Result<std::vector<std::uint64_t>> packed_alone(std::span<const std::string_view> texts) {
  ZipLimits limits;
  limits.max_entries = texts.size();
  ZipWriter writer(limits);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    HYPERMAP_TRY(writer.add(std::to_string(i), texts[i]));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, writer.finish());
  HYPERMAP_ASSIGN_OR_RETURN(const ZipReader zip, ZipReader::create(view_bytes(bytes), limits));
  std::vector<std::uint64_t> sizes;
  sizes.reserve(texts.size());
  for (const ZipMember& member : zip.members()) sizes.push_back(member.num_packed_bytes);
  return sizes;
}

/// Of the member's text, the lines of objects: their states, and their cells in the same order.
struct LinesOfObjects {
  std::span<const std::string_view> states;
  std::span<const std::string_view> cells;
};

Result<std::vector<ObjectFieldSize>> field_sizes(const LinesOfObjects& objects) {
  std::map<std::string_view, std::string> values;
  const auto add = [&values](std::string_view key, std::string_view value) {
    std::string& all = values[key];
    all += value;
    all += '\n';
  };
  for (const std::string_view line : objects.states) {
    for (const auto& [key, value] : members_of_line(line)) add(key, value);
  }
  for (const std::string_view line : objects.cells) add("cells", line);
  std::vector<std::string_view> texts;
  std::vector<ObjectFieldSize> fields;
  for (const auto& [key, text] : values) {
    texts.emplace_back(text);
    fields.push_back({.key = std::string(key), .num_bytes = text.size()});
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::uint64_t> packed, packed_alone(texts));
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].num_packed_bytes = packed[i];
  std::ranges::stable_sort(fields, std::greater(), &ObjectFieldSize::num_packed_bytes);
  return fields;
}

/// Of each object its two lines, packed by themselves.
Result<std::vector<std::uint64_t>> sizes_alone(const LinesOfObjects& objects) {
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<std::uint64_t> sizes, packed_alone(objects.states));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::uint64_t> cells, packed_alone(objects.cells));
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] += cells[i];
  return sizes;
}

/// Requires: the archive that `zip` is has objects, by ascending id.
Result<ObjectSizes> object_sizes(const ObjectMap& objects,
                                 const HypermapConfig& config,
                                 const ZipReader& zip) {
  const std::string& file =
      std::ranges::find(config.extensions, kObjectsFormat, &ExtensionEntry::format)->file;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, zip.read(file));
  const std::vector<std::string_view> lines = lines_of(text);
  const std::size_t num_objects = objects.size();
  const std::span<const std::string_view> all(lines);
  const LinesOfObjects of_objects{.states = all.subspan(1, num_objects),
                                  .cells = all.subspan(1 + num_objects, num_objects)};
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<std::uint64_t> alone, sizes_alone(of_objects));
  ObjectSizes sizes{.num_objects = num_objects};
  sizes.mean =
      static_cast<double>(zip.find(file)->num_packed_bytes) / static_cast<double>(num_objects);
  const auto largest = std::ranges::max_element(alone);
  sizes.largest_alone = *largest;
  std::size_t place = static_cast<std::size_t>(largest - alone.begin());
  for (const Object& object : objects.objects()) {
    if (place-- == 0) sizes.largest = object.id;
  }
  sizes.num_large = static_cast<std::size_t>(
      std::ranges::count_if(alone, [](std::uint64_t size) { return size > kLargeObjectBytes; }));
  const auto middle = alone.begin() + static_cast<std::ptrdiff_t>(alone.size() / 2);
  std::ranges::nth_element(alone, middle);
  sizes.median_alone = *middle;
  HYPERMAP_ASSIGN_OR_RETURN(sizes.fields, field_sizes(of_objects));
  return sizes;
}

std::size_t num_named_classes(const MapArchive& archive) {
  std::set<std::string_view> names;
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto* semantic = layer.content.as<SemanticLayer>();
    if (semantic == nullptr) continue;
    for (const SemanticObject& object : semantic->objects()) names.insert(object.name);
  }
  return names.size();
}

double height_of(const MapArchive& archive) {
  double height_m = 0.0;
  for (const Layer& layer : archive_layers(archive)) {
    const auto bounds = layer.content->statistics().bounds;
    if (bounds) height_m = std::max(height_m, bounds->sizes().z());
  }
  return height_m;
}

std::optional<GridSizes> sizes_as_grids(const MapArchive& archive) {
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto* occupancy = layer.content.as<OccupancyLayer>();
    if (occupancy == nullptr || occupancy->grid.geometry().num_cells() == 0) continue;
    const GridGeometry& geometry = occupancy->grid.geometry();
    GridSizes sizes{.num_classes = num_named_classes(archive),
                    .cell_edge_m = geometry.resolution_m};
    sizes.flat_bytes = geometry.num_cells() * sizes.num_classes;
    const double levels = std::ceil(height_of(archive) / geometry.resolution_m - 1e-6);
    sizes.volume_bytes = sizes.flat_bytes * static_cast<std::uint64_t>(std::max(levels, 0.0));
    return sizes;
  }
  return std::nullopt;
}

}  // namespace

Result<ArchiveSizes> archive_sizes(const MapArchive& archive) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, write_archive(archive));
  HYPERMAP_ASSIGN_OR_RETURN(const ZipReader zip, ZipReader::create(view_bytes(bytes)));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, zip.read(kConfigName));
  HYPERMAP_ASSIGN_OR_RETURN(
      const Loaded<HypermapConfig> config,
      parse_hypermap_config(
          text, {.file = "archive", .entry = std::string(kConfigName)}, archive_layer_types()));
  ArchiveSizes sizes{.num_bytes = bytes.size(), .parts = part_sizes(config.value, zip)};
  if (archive.objects.size() > 0) {
    HYPERMAP_ASSIGN_OR_RETURN(sizes.objects, object_sizes(archive.objects, config.value, zip));
  }
  sizes.as_grids = sizes_as_grids(archive);
  return sizes;
}

}  // namespace hypermap
