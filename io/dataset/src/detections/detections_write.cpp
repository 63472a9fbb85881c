// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace hypermap {
namespace {

std::string number_list(std::span<const double> numbers) {
  std::string out = "[";
  for (const double number : numbers) {
    if (out.size() > 1) out += ", ";
    out += json_number(number);
  }
  return out + "]";
}

std::string scores_json(std::span<const NamedScore> scores) {
  std::string out = "{";
  for (const NamedScore& score : scores) {
    if (out.size() > 1) out += ", ";
    out += json_quoted(score.label) + ": " + json_number(score.probability.value());
  }
  return out + "}";
}

std::string mask_json(const RleMask& mask) {
  std::string out = "{\"size\": [" + std::to_string(mask.height_px) + ", " +
                    std::to_string(mask.width_px) + "], \"counts\": [";
  bool is_first = true;
  for (const std::uint32_t run : mask.runs) {
    if (!std::exchange(is_first, false)) out += ", ";
    out += std::to_string(run);
  }
  return out + "]}";
}

std::string detection_json(const NamedDetection& detection) {
  const PixelBox& box = detection.box_px;
  std::string out = "{\"label\": " + json_quoted(detection.label) +
                    ", \"score\": " + json_number(detection.score.value()) + ", \"bbox\": " +
                    number_list(std::array{box.u_min_px, box.v_min_px, box.u_max_px, box.v_max_px});
  if (!detection.scores.empty()) out += ", \"scores\": " + scores_json(detection.scores);
  if (detection.mask) out += ", \"mask\": " + mask_json(*detection.mask);
  if (!detection.embeddings.empty()) {
    out += ", \"embedding\": " + embeddings_json(detection.embeddings);
  }
  return out + "}";
}

std::string coco_json(const NamedDetection& detection,
                      const FrameDetections& frame,
                      std::size_t image_id,
                      std::size_t category_id) {
  const PixelBox& box = detection.box_px;
  std::string out =
      "{\"image_id\": " + std::to_string(image_id) +
      ", \"file_name\": " + json_quoted(frame.image) +
      ", \"category_id\": " + std::to_string(category_id) +
      ", \"category\": " + json_quoted(detection.label) + ", \"bbox\": " +
      number_list(std::array{box.u_min_px, box.v_min_px, box.width_px(), box.height_px()}) +
      ", \"score\": " + json_number(detection.score.value());
  if (!detection.scores.empty()) out += ", \"scores\": " + scores_json(detection.scores);
  if (detection.mask) out += ", \"segmentation\": " + mask_json(*detection.mask);
  if (!detection.embeddings.empty()) {
    out += ", \"embedding\": " + embeddings_json(detection.embeddings);
  }
  return out + "}";
}

}  // namespace

std::string to_json_line(const FrameDetections& frame) {
  std::string out = "{";
  if (!frame.image.empty()) out += "\"image\": " + json_quoted(frame.image) + ", ";
  if (frame.stamp) out += "\"timestamp\": " + stamp_text(*frame.stamp) + ", ";
  if (frame.width_px > 0) {
    out += "\"width\": " + std::to_string(frame.width_px) +
           ", \"height\": " + std::to_string(frame.height_px) + ", ";
  }
  out += "\"detections\": [";
  bool is_first = true;
  for (const NamedDetection& detection : frame.detections) {
    if (!std::exchange(is_first, false)) out += ", ";
    out += detection_json(detection);
  }
  return out + "]}\n";
}

Result<std::string> to_coco_results(std::span<const FrameDetections> frames,
                                    std::span<const std::string> class_names) {
  std::map<std::string_view, std::size_t> id_of_class;
  for (std::size_t i = 0; i < class_names.size(); ++i) id_of_class.try_emplace(class_names[i], i);
  std::string out = "[";
  for (std::size_t image_id = 0; image_id < frames.size(); ++image_id) {
    for (const NamedDetection& detection : frames[image_id].detections) {
      const auto id = id_of_class.find(detection.label);
      if (id == id_of_class.end()) {
        return fail(ErrorCode::kNotFound,
                    "must be one of the class names, is \"" + printable(detection.label) + "\"",
                    "label");
      }
      out += out.size() > 1 ? ",\n" : "\n";
      out += coco_json(detection, frames[image_id], image_id, id->second);
    }
  }
  return out + "\n]\n";
}

}  // namespace hypermap
