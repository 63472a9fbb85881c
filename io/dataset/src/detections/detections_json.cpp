// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/codec/value_limits.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 4> kLabelKeys{"label", "class", "category", "name"};
constexpr std::array<std::string_view, 7> kFrameKeys{
    "image", "timestamp", "width", "height", "detections", "index", "detector"};
constexpr std::array<std::string_view, 11> kDetectionKeys{"label",
                                                          "class",
                                                          "category",
                                                          "name",
                                                          "class_id",
                                                          "score",
                                                          "bbox",
                                                          "bbox_xywh",
                                                          "scores",
                                                          "mask",
                                                          "embedding"};

constexpr std::array<std::string_view, 2> kMaskKeys = {"size", "counts"};

template <std::size_t N>
void note_unknown(const JsonNode& object,
                  const std::array<std::string_view, N>& known,
                  DetectionSetBuilder& builder) {
  for (std::size_t i = 0; i < object.size(); ++i) {
    const JsonNode member = object.at(i);
    if (std::find(known.begin(), known.end(), member.key()) == known.end()) {
      builder.note_unknown_key(member);
    }
  }
}

Result<std::string> label_of(const JsonNode& node, const DetectionReadOptions& options) {
  for (const std::string_view key : kLabelKeys) {
    if (const auto label = node.find(key)) return parse_label(*label, options.limits);
  }
  const auto id = node.find("class_id");
  if (!id || options.class_names.empty()) {
    return node.error(ErrorCode::kMalformedFile, "missing key \"label\" or \"class\"");
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto index, id->integer(0, static_cast<std::int64_t>(options.class_names.size()) - 1));
  return options.class_names[static_cast<std::size_t>(index)];
}

Result<PixelBox> box_of(const JsonNode& node) {
  const auto corners = node.find("bbox");
  const auto sized = node.find("bbox_xywh");
  if (corners && sized) {
    return node.error(ErrorCode::kMalformedFile, "has bbox and bbox_xywh, expected one of them");
  }
  if (corners) return parse_box(*corners, false);
  if (sized) return parse_box(*sized, true);
  return node.error(ErrorCode::kMalformedFile, "missing key \"bbox\" or \"bbox_xywh\"");
}

Result<NamedDetection> parse_detection(const JsonNode& node,
                                       const FrameDetections& frame,
                                       DetectionSetBuilder& builder) {
  HYPERMAP_TRY(node.expect(JsonKind::kObject));
  NamedDetection out;
  HYPERMAP_ASSIGN_OR_RETURN(out.label, label_of(node, builder.options()));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode score, node.require("score"));
  HYPERMAP_ASSIGN_OR_RETURN(out.score, parse_probability(score));
  HYPERMAP_ASSIGN_OR_RETURN(out.box_px, box_of(node));
  if (const auto scores = node.find("scores")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.scores, parse_scores(*scores, builder.options().limits));
  }
  if (const auto mask = node.find("mask"); mask && !mask->is(JsonKind::kNull)) {
    HYPERMAP_ASSIGN_OR_RETURN(out.mask, parse_mask(*mask, builder.options().limits));
    note_unknown(*mask, kMaskKeys, builder);
    const bool fits = frame.width_px == 0 || (out.mask->width_px == frame.width_px &&
                                              out.mask->height_px == frame.height_px);
    if (!fits) {
      return mask->error(ErrorCode::kMalformedFile,
                         "size must be the image's " + std::to_string(frame.height_px) + " x " +
                             std::to_string(frame.width_px) + ", is " +
                             std::to_string(out.mask->height_px) + " x " +
                             std::to_string(out.mask->width_px));
    }
  }
  if (const auto embedding = node.find("embedding")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.embeddings, parse_embeddings(*embedding, builder));
  }
  note_unknown(node, kDetectionKeys, builder);
  return out;
}

Result<Stamp> parse_json_stamp(const JsonNode& node) {
  std::string_view text = node.number_text();
  if (node.is(JsonKind::kString)) {
    HYPERMAP_ASSIGN_OR_RETURN(text, node.string());
  } else {
    HYPERMAP_TRY(node.expect(JsonKind::kNumber));
  }
  const auto stamp = parse_stamp(text);
  if (!stamp) return node.error(ErrorCode::kMalformedFile, stamp.error().what);
  return stamp->stamp;
}

/// Which image the frame is about: name or stamp, and perhaps its size.
Result<FrameDetections> parse_frame_head(const JsonNode& root) {
  FrameDetections frame;
  if (const auto image = root.find("image")) {
    HYPERMAP_ASSIGN_OR_RETURN(frame.image, image->string());
  }
  if (const auto stamp = root.find("timestamp")) {
    HYPERMAP_ASSIGN_OR_RETURN(frame.stamp, parse_json_stamp(*stamp));
  }
  if (frame.image.empty() && !frame.stamp) {
    return root.error(ErrorCode::kMalformedFile, "missing key \"image\" or \"timestamp\"");
  }
  const auto width = root.find("width");
  const auto height = root.find("height");
  if (width.has_value() != height.has_value()) {
    return root.error(ErrorCode::kMalformedFile, "must have width and height or neither");
  }
  if (width) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto w, width->integer(1, kMaxImageSidePx));
    HYPERMAP_ASSIGN_OR_RETURN(const auto h, height->integer(1, kMaxImageSidePx));
    frame.width_px = static_cast<int>(w);
    frame.height_px = static_cast<int>(h);
  }
  return frame;
}

}  // namespace

Result<PixelBox> parse_box(const JsonNode& node, bool is_xywh) {
  HYPERMAP_TRY(node.expect(JsonKind::kArray));
  if (node.size() != 4) {
    return node.error(ErrorCode::kMalformedFile,
                      "must have 4 numbers, has " + std::to_string(node.size()));
  }
  std::array<double, 4> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(v.at(i), node.at(i).number());
    if (!(std::abs(v.at(i)) <= kMaxCoordinate)) {
      return node.at(i).error(ErrorCode::kMalformedFile,
                              "must be within 1e6 pixels, is " + json_number(v.at(i)));
    }
  }
  const PixelBox box =
      is_xywh ? PixelBox{v[0], v[1], v[0] + v[2], v[1] + v[3]} : PixelBox{v[0], v[1], v[2], v[3]};
  if (box.u_max_px > box.u_min_px && box.v_max_px > box.v_min_px) return box;
  return node.error(ErrorCode::kMalformedFile,
                    "must have an area, is " + json_number(box.width_px()) + " x " +
                        json_number(box.height_px()) + " pixels");
}

Result<Probability> parse_probability(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, node.number());
  if (value >= 0.0 && value <= 1.0) return Probability(value);
  return node.error(ErrorCode::kMalformedFile, "must be in 0 .. 1, is " + json_number(value));
}

Result<std::string> parse_label(const JsonNode& node, const DetectionLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
  if (text.empty()) return node.error(ErrorCode::kMalformedFile, "must not be empty");
  if (text.size() > limits.max_label_bytes) {
    return node.error(ErrorCode::kLimit,
                      "at most " + std::to_string(limits.max_label_bytes) +
                          " bytes are read, has " + std::to_string(text.size()));
  }
  if (text.find('\0') != std::string_view::npos) {
    return node.error(ErrorCode::kMalformedFile, "must not hold NUL");
  }
  return std::string(text);
}

Result<std::vector<NamedScore>> parse_scores(const JsonNode& node, const DetectionLimits& limits) {
  HYPERMAP_TRY(node.expect(JsonKind::kObject));
  std::vector<NamedScore> scores;
  std::set<std::string> classes;
  scores.reserve(node.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const JsonNode member = node.at(i);
    if (member.key().empty() || member.key().size() > limits.max_label_bytes ||
        member.key().find('\0') != std::string_view::npos) {
      return member.error(ErrorCode::kMalformedFile,
                          "class name must have 1 .. " + std::to_string(limits.max_label_bytes) +
                              " bytes and no NUL");
    }
    if (!classes.insert(canonical_class_name(member.key())).second) {
      return member.error(ErrorCode::kMalformedFile,
                          "must name each class once, is another spelling of one before");
    }
    HYPERMAP_ASSIGN_OR_RETURN(const Probability p, parse_probability(member));
    scores.push_back({std::string(member.key()), p});
    sum += p.value();
  }
  if (!scores.empty() && sum > 0.0) return scores;
  return node.error(ErrorCode::kMalformedFile, "must have a sum > 0");
}

Result<void> parse_frame_json(const JsonNode& root, DetectionSetBuilder& builder) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode list, root.require("detections"));
  HYPERMAP_TRY(list.expect(JsonKind::kArray));
  HYPERMAP_ASSIGN_OR_RETURN(FrameDetections frame, parse_frame_head(root));
  if (list.size() > builder.options().limits.max_per_frame) {
    return list.error(ErrorCode::kLimit,
                      "at most " + std::to_string(builder.options().limits.max_per_frame) +
                          " detections of a frame are read, has " + std::to_string(list.size()));
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(NamedDetection detection,
                              parse_detection(list.at(i), frame, builder));
    if (frame.width_px > 0 && !clipped(detection.box_px, frame.width_px, frame.height_px)) {
      return list.at(i).error(ErrorCode::kMalformedFile, "box lies wholly outside the image");
    }
    frame.detections.push_back(std::move(detection));
  }
  note_unknown(root, kFrameKeys, builder);
  return builder.add(std::move(frame), root.line());
}

}  // namespace hypermap
