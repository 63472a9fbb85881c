// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/class_names.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <array>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNames = 65'535;
constexpr std::size_t kMaxClassNameBytes = 256;

constexpr std::array<std::string_view, 80> kCocoNames{
    "person",        "bicycle",       "car",           "motorbike",
    "aeroplane",     "bus",           "train",         "truck",
    "boat",          "traffic light", "fire hydrant",  "stop sign",
    "parking meter", "bench",         "bird",          "cat",
    "dog",           "horse",         "sheep",         "cow",
    "elephant",      "bear",          "zebra",         "giraffe",
    "backpack",      "umbrella",      "handbag",       "tie",
    "suitcase",      "frisbee",       "skis",          "snowboard",
    "sports ball",   "kite",          "baseball bat",  "baseball glove",
    "skateboard",    "surfboard",     "tennis racket", "bottle",
    "wine glass",    "cup",           "fork",          "knife",
    "spoon",         "bowl",          "banana",        "apple",
    "sandwich",      "orange",        "broccoli",      "carrot",
    "hot dog",       "pizza",         "donut",         "cake",
    "chair",         "sofa",          "pottedplant",   "bed",
    "diningtable",   "toilet",        "tvmonitor",     "laptop",
    "mouse",         "remote",        "keyboard",      "cell phone",
    "microwave",     "oven",          "toaster",       "sink",
    "refrigerator",  "book",          "clock",         "vase",
    "scissors",      "teddy bear",    "hair drier",    "toothbrush"};

Unexpected name_error(const std::filesystem::path& path,
                      int line,
                      ErrorCode code,
                      std::string what) {
  return Unexpected(Error{
      .code = code, .what = std::move(what), .file = path.string(), .field = "name", .line = line});
}

Result<void> check_name(const std::filesystem::path& path,
                        const TextLine& line,
                        std::string_view name) {
  if (name.empty()) {
    return name_error(path, line.number, ErrorCode::kMalformedFile, "must not be empty");
  }
  if (name.size() > kMaxClassNameBytes) {
    return name_error(path,
                      line.number,
                      ErrorCode::kLimit,
                      "at most 256 bytes are read, has " + std::to_string(name.size()));
  }
  if (first_bad_utf8(name) < name.size()) {
    return name_error(path, line.number, ErrorCode::kMalformedFile, "must be UTF-8");
  }
  return {};
}

}  // namespace

std::vector<std::string> coco_class_names() {
  return {kCocoNames.begin(), kCocoNames.end()};
}

Result<std::vector<std::string>> read_class_names(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text,
                            read_file(path, kMaxNames * (kMaxClassNameBytes + 2)));
  std::vector<TextLine> lines = split_lines(text);
  while (!lines.empty() && trimmed(lines.back().text).empty()) lines.pop_back();
  if (lines.empty()) {
    return name_error(path, 0, ErrorCode::kMalformedFile, "has no name, expected one a line");
  }
  if (lines.size() > kMaxNames) {
    return name_error(path, 0, ErrorCode::kLimit, "at most 65535 names are read");
  }
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const TextLine& line : lines) {
    const std::string name(trimmed(line.text));
    HYPERMAP_TRY(check_name(path, line, name));
    if (!seen.insert(canonical_class_name(name)).second) {
      return name_error(path,
                        line.number,
                        ErrorCode::kMalformedFile,
                        "must occur once, \"" + printable(name) + "\" is there before");
    }
    names.push_back(name);
  }
  return names;
}

}  // namespace hypermap
