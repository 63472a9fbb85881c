// SPDX-License-Identifier: BSD-3-Clause
// All forms of detections; frames are written as lines of JSON and read again.
#include "fuzz_target.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {
namespace {

DetectionReadOptions detection_options() {
  DetectionReadOptions options;
  options.limits.max_image_pixels = 1U << 16U;
  return options;
}

Result<DetectionSet> detections_of(std::string_view text) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            parse_detections(text, kFuzzSource.file, detection_options()));
  return std::move(loaded.value);
}

std::string lines_of(const DetectionSet& set) {
  std::string lines;
  for (const FrameDetections& frame : set.frames) lines += to_json_line(frame);
  return lines;
}

void check_masks(const FrameDetections& frame) {
  for (const NamedDetection& detection : frame.detections) {
    if (!detection.mask) continue;
    const MaskImage pixels = decode(*detection.mask);
    require(decode(encode(pixels)) == pixels, "a mask is coded without loss");
  }
}

}  // namespace

void fuzz_detections(std::string_view bytes) {
  static_cast<void>(read_detections(file_of(bytes, "detections.txt"), detection_options()));
  const auto set = detections_of(bytes);
  if (!set) return;
  for (const FrameDetections& frame : set->frames) check_masks(frame);
  if (set->frames.empty()) return;
  const auto again = detections_of(lines_of(*set));
  require(require(again, "what was written is read").frames == set->frames, "as the same frames");
}

}  // namespace hypermap::fuzz
