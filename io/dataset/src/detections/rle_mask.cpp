// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/value_limits.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

Result<std::vector<std::uint32_t>> parse_runs(const JsonNode& node) {
  if (node.is(JsonKind::kString)) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
    auto runs = decompress_runs(text);
    if (!runs) return node.error(ErrorCode::kMalformedFile, runs.error().what);
    return runs;
  }
  HYPERMAP_TRY(node.expect(JsonKind::kArray));
  std::vector<std::uint32_t> runs;
  runs.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto run,
                              node.at(i).integer(0, std::numeric_limits<std::uint32_t>::max()));
    runs.push_back(static_cast<std::uint32_t>(run));
  }
  return runs;
}

Result<std::pair<int, int>> parse_size(const JsonNode& node, const DetectionLimits& limits) {
  HYPERMAP_TRY(node.expect(JsonKind::kArray));
  if (node.size() != 2) return node.error(ErrorCode::kMalformedFile, "must be [height, width]");
  HYPERMAP_ASSIGN_OR_RETURN(const auto height, node.at(0).integer(1, kMaxImageSidePx));
  HYPERMAP_ASSIGN_OR_RETURN(const auto width, node.at(1).integer(1, kMaxImageSidePx));
  if (static_cast<std::uint64_t>(width * height) > limits.max_image_pixels) {
    return node.error(ErrorCode::kLimit,
                      "at most " + std::to_string(limits.max_image_pixels) + " pixels are read");
  }
  return std::pair{static_cast<int>(width), static_cast<int>(height)};
}

/// One number of the compressed form: five bits a character, lowest first, bit 5 says "more".
Result<std::int64_t> take_number(std::string_view text, std::size_t& at) {
  std::int64_t value = 0;
  for (unsigned shift = 0; shift < 40; shift += 5) {
    if (at >= text.size()) return fail(ErrorCode::kMalformedFile, "compressed runs are cut");
    const int code = text[at++] - '0';
    if (code < 0 || code > 63) {
      return fail(ErrorCode::kMalformedFile, "compressed runs hold a character outside '0' .. 'o'");
    }
    value |= static_cast<std::int64_t>(code & 31) << shift;
    if ((code & 32) != 0) continue;
    const bool is_negative = (code & 16) != 0;
    return is_negative ? value - (std::int64_t{1} << (shift + 5)) : value;
  }
  return fail(ErrorCode::kMalformedFile, "compressed runs hold a number of more than 40 bits");
}

}  // namespace

Result<std::vector<std::uint32_t>> decompress_runs(std::string_view text) {
  std::vector<std::uint32_t> runs;
  for (std::size_t at = 0; at < text.size();) {
    HYPERMAP_ASSIGN_OR_RETURN(std::int64_t run, take_number(text, at));
    if (runs.size() > 2) run += runs[runs.size() - 2];
    if (run < 0 || run > std::numeric_limits<std::uint32_t>::max()) {
      return fail(ErrorCode::kMalformedFile, "must not hold a run of " + std::to_string(run));
    }
    runs.push_back(static_cast<std::uint32_t>(run));
  }
  return runs;
}

Result<RleMask> parse_mask(const JsonNode& node, const DetectionLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode size, node.require("size"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode counts, node.require("counts"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto sides, parse_size(size, limits));
  RleMask mask{.width_px = sides.first, .height_px = sides.second, .runs = {}};
  HYPERMAP_ASSIGN_OR_RETURN(mask.runs, parse_runs(counts));
  std::uint64_t sum = 0;
  for (const std::uint32_t run : mask.runs) sum += run;
  const auto pixels =
      static_cast<std::uint64_t>(mask.width_px) * static_cast<std::uint64_t>(mask.height_px);
  if (sum != pixels) {
    return counts.error(
        ErrorCode::kMalformedFile,
        "runs must sum to " + std::to_string(pixels) + " pixels, sum to " + std::to_string(sum));
  }
  return mask;
}

PixelRect bounds_of(const RleMask& mask) {
  const auto height = static_cast<std::size_t>(mask.height_px);
  PixelRect bounds;
  std::size_t at = 0;
  bool is_set = false;
  for (const std::uint32_t run : mask.runs) {
    if (is_set && run > 0) {
      const std::size_t last = at + run - 1;
      const bool is_in_one_column = at / height == last / height;
      bounds = united(bounds,
                      {static_cast<int>(at / height),
                       is_in_one_column ? static_cast<int>(at % height) : 0,
                       static_cast<int>(last / height) + 1,
                       is_in_one_column ? static_cast<int>(last % height) + 1 : mask.height_px});
    }
    at += run;
    is_set = !is_set;
  }
  return bounds;
}

MaskImage decode(const RleMask& mask) {
  MaskImage image(mask.width_px, mask.height_px);
  const auto height = static_cast<std::size_t>(mask.height_px);
  std::size_t at = 0;
  bool is_set = false;
  for (const std::uint32_t run : mask.runs) {
    const std::size_t end = at + run;
    while (is_set && at < end) {  // column by column; the image begins with 0
      const std::size_t column = at / height;
      const std::size_t column_end = std::min(end, (column + 1) * height);
      for (std::size_t row = at - column * height; at < column_end; ++at, ++row)
        image.at(static_cast<int>(column), static_cast<int>(row)) = 1;
    }
    at = end;
    is_set = !is_set;
  }
  return image;
}

RleMask encode(const MaskImage& mask) {
  RleMask out{.width_px = mask.width_px(), .height_px = mask.height_px(), .runs = {}};
  std::uint8_t value = 0;
  std::uint32_t run = 0;
  for (int u = 0; u < mask.width_px(); ++u) {
    for (int v = 0; v < mask.height_px(); ++v) {
      const auto pixel = static_cast<std::uint8_t>(mask.at(u, v) != 0 ? 1 : 0);
      if (pixel != value) {
        out.runs.push_back(std::exchange(run, 0U));
        value = pixel;
      }
      ++run;
    }
  }
  if (run > 0) out.runs.push_back(run);
  return out;
}

}  // namespace hypermap
