// SPDX-License-Identifier: BSD-3-Clause
#include "label_images.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTableBytes = std::size_t{16} << 20U;
constexpr std::size_t kMinRegionPixels = 64;
constexpr std::uint32_t kInstancesPerClass = 1000;

/// NYU Depth V2, N. Silberman et al. 2012, in the order of the 40 classes, from 1 on.
constexpr std::array<std::string_view, 40> kNyu40{
    "wall",       "floor",          "cabinet",        "bed",
    "chair",      "sofa",           "table",          "door",
    "window",     "bookshelf",      "picture",        "counter",
    "blinds",     "desk",           "shelves",        "curtain",
    "dresser",    "pillow",         "mirror",         "floor mat",
    "clothes",    "ceiling",        "books",          "refrigerator",
    "television", "paper",          "towel",          "shower curtain",
    "box",        "whiteboard",     "person",         "night stand",
    "toilet",     "sink",           "lamp",           "bathtub",
    "bag",        "otherstructure", "otherfurniture", "otherprop"};

using NumberImage = Image<std::uint32_t>;

Result<NumberImage> read_numbers(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, read_image_file(path));
  if (image.channels != 1) {
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "has " + std::to_string(image.channels) +
                                    " channels, expected one of class or instance numbers",
                            .file = path.string()});
  }
  NumberImage out(image.width_px, image.height_px);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out.pixels()[i] = image.bits == 16 ? image.samples16[i] : image.samples8[i];
  }
  return out;
}

std::vector<std::string_view> split_tabs(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find('\t', at), line.size());
    cells.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return cells;
}

Result<LabelNames> parse_table(std::string_view text, const fs::path& path) {
  LabelNames names;
  std::size_t id_column = 0;
  std::size_t name_column = 0;
  for (const TextLine& line : split_lines(text)) {
    const auto cells = split_tabs(line.text);
    if (line.number == 1) {
      const auto id = std::find(cells.begin(), cells.end(), "id");
      const auto name = std::find(cells.begin(), cells.end(), "category");
      if (id == cells.end() || name == cells.end()) {
        return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                                .what = "must have the columns id and category",
                                .file = path.string(),
                                .line = 1});
      }
      id_column = static_cast<std::size_t>(id - cells.begin());
      name_column = static_cast<std::size_t>(name - cells.begin());
      continue;
    }
    if (trimmed(line.text).empty()) continue;
    const auto number = id_column < cells.size() ? parse_unsigned(cells[id_column]) : std::nullopt;
    if (!number || *number > std::numeric_limits<std::uint16_t>::max() ||
        name_column >= cells.size() || cells[name_column].empty()) {
      return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                              .what = "must have a number as id and a category",
                              .file = path.string(),
                              .line = line.number});
    }
    names.of_number.emplace(static_cast<std::uint32_t>(*number), std::string(cells[name_column]));
  }
  return names;
}

/// Lines `number name`; a name may have blanks, `#` begins a comment.
Result<LabelNames> parse_name_lines(std::string_view text, const fs::path& path) {
  LabelNames names;
  for (const TextLine& line : split_lines(text)) {
    const std::string_view content = trimmed(line.text);
    if (content.empty() || content.front() == '#') continue;
    const std::size_t blank = std::min(content.find_first_of(" \t"), content.size());
    const auto number = parse_unsigned(content.substr(0, blank));
    const std::string_view name = trimmed(content.substr(blank));
    const bool is_new = number && *number <= std::numeric_limits<std::uint16_t>::max() &&
                        !name.empty() && names.of_number.emplace(*number, std::string(name)).second;
    if (is_new) continue;
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "must have a number up to 65535, each once, and a name, is " +
                                    printable(content, 60),
                            .file = path.string(),
                            .line = line.number});
  }
  return names;
}

Result<LabelNames> read_names(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxTableBytes));
  const auto lines = split_lines(text);
  const bool is_table = !lines.empty() && lines[0].text.find('\t') != std::string_view::npos &&
                        lines[0].text.find("category") != std::string_view::npos;
  return is_table || path.extension() == ".tsv" ? parse_table(text, path)
                                                : parse_name_lines(text, path);
}

Error unnamed_number(std::uint32_t number, const std::string& image) {
  return {.code = ErrorCode::kUnsupported,
          .what = "class number " + std::to_string(number) +
                  " has no name in the 40 classes of NYU Depth V2, which are taken when no others "
                  "are given: name the numbers with `label_names` in the description, or in " +
                  std::string(kLabelTable),
          .file = image,
          .field = "class"};
}

/// Numbers of connected regions of equal value, 4 neighbours, from 1 on; 0 stays 0.
NumberImage connected_regions(const NumberImage& values) {
  NumberImage regions(values.width_px(), values.height_px(), 0);
  std::uint32_t next = 0;
  std::vector<std::pair<int, int>> open;
  for (int v = 0; v < values.height_px(); ++v) {
    for (int u = 0; u < values.width_px(); ++u) {
      if (values.at(u, v) == 0 || regions.at(u, v) != 0) continue;
      regions.at(u, v) = ++next;
      open.assign(1, {u, v});
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nx = x + dx;
          const int ny = y + dy;
          if (!values.contains(nx, ny) || regions.at(nx, ny) != 0) continue;
          if (values.at(nx, ny) != values.at(u, v)) continue;
          regions.at(nx, ny) = next;
          open.emplace_back(nx, ny);
        }
      }
    }
  }
  return regions;
}

/// One instance: how often each class number lies in it, and which pixels.
struct Region {
  std::map<std::uint32_t, std::size_t> votes;
  std::vector<std::size_t> pixels;
};

std::map<std::uint32_t, Region> regions_of(const NumberImage& classes,
                                           const NumberImage& instance_ids) {
  std::map<std::uint32_t, Region> regions;
  for (std::size_t i = 0; i < instance_ids.size(); ++i) {
    const std::uint32_t instance_id = instance_ids.pixels()[i];
    if (instance_id == 0) continue;
    Region& region = regions[instance_id];
    ++region.votes[classes.pixels()[i]];
    region.pixels.push_back(i);
  }
  return regions;
}

/// The class most of the region's pixels have; the lowest number of equals.
std::uint32_t majority(const Region& region) {
  return std::max_element(region.votes.begin(),
                          region.votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

NamedDetection detection_of(const Region& region, const std::string& name, int width, int height) {
  MaskImage mask(width, height, 0);
  PixelBox box{static_cast<double>(width), static_cast<double>(height), 0.0, 0.0};
  for (const std::size_t pixel : region.pixels) {
    mask.pixels()[pixel] = 1;
    const auto u = static_cast<double>(pixel % static_cast<std::size_t>(width));
    const std::size_t row = pixel / static_cast<std::size_t>(width);
    const auto v = static_cast<double>(row);
    box = {std::min(box.u_min_px, u),
           std::min(box.v_min_px, v),
           std::max(box.u_max_px, u + 1.0),
           std::max(box.v_max_px, v + 1.0)};
  }
  NamedDetection out;
  out.label = name;
  out.score = Probability(1.0);
  out.box_px = box;
  out.mask = encode(mask);
  return out;
}

Result<std::pair<NumberImage, NumberImage>> read_classes_and_instances(const fs::path& labels,
                                                                       const fs::path& instances) {
  if (instances.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(NumberImage classes, read_numbers(labels));
    NumberImage instance_ids = connected_regions(classes);
    return std::pair{std::move(classes), std::move(instance_ids)};
  }
  HYPERMAP_ASSIGN_OR_RETURN(NumberImage instance_ids, read_numbers(instances));
  if (labels.empty()) {
    NumberImage classes = instance_ids;
    for (std::uint32_t& value : classes.pixels()) value /= kInstancesPerClass;
    return std::pair{std::move(classes), std::move(instance_ids)};
  }
  HYPERMAP_ASSIGN_OR_RETURN(NumberImage classes, read_numbers(labels));
  if (classes.width_px() != instance_ids.width_px() ||
      classes.height_px() != instance_ids.height_px()) {
    return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                            .what = "must have the size of the label image",
                            .file = instances.string()});
  }
  return std::pair{std::move(classes), std::move(instance_ids)};
}

}  // namespace

Result<LabelNames> read_label_names(const fs::path& folder, const std::string& chosen) {
  if (!chosen.empty()) return read_names(folder / chosen);
  for (const fs::path& place : {folder, folder / "..", folder / "../.."}) {
    std::error_code ec;
    const fs::file_type type = fs::status(place / kLabelTable, ec).type();
    // What cannot be looked at is not absent: reading it says why.
    if (type != fs::file_type::regular && type != fs::file_type::none) continue;
    return read_names(place / kLabelTable);
  }
  LabelNames names{.are_assumed = true};
  for (std::size_t i = 0; i < kNyu40.size(); ++i) {
    names.of_number.emplace(static_cast<std::uint32_t>(i + 1), std::string(kNyu40.at(i)));
  }
  return names;
}

Result<FrameDetections> read_label_detections(const fs::path& labels,
                                              const fs::path& instances,
                                              const LabelNames& names,
                                              const DetectionLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto images, read_classes_and_instances(labels, instances));
  const auto& [classes, instance_ids] = images;
  FrameDetections frame;
  frame.image = labels.empty() ? instances.string() : labels.string();
  frame.width_px = classes.width_px();
  frame.height_px = classes.height_px();
  for (const auto& [instance_id, region] : regions_of(classes, instance_ids)) {
    if (region.pixels.size() < kMinRegionPixels) continue;
    const std::uint32_t number = majority(region);
    const auto name = names.of_number.find(number);
    if (name == names.of_number.end()) {
      if (names.are_assumed && number != 0) return Unexpected(unnamed_number(number, frame.image));
      continue;
    }
    if (frame.detections.size() >= limits.max_per_frame) {
      return Unexpected(Error{.code = ErrorCode::kLimit,
                              .what = "at most " + std::to_string(limits.max_per_frame) +
                                      " instances in an image are read",
                              .file = frame.image});
    }
    frame.detections.push_back(detection_of(region, name->second, frame.width_px, frame.height_px));
  }
  return frame;
}

}  // namespace hypermap
