// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/codec/value_limits.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

struct TextDetection {
  NamedDetection detection;
  bool is_share = false;
};

Unexpected line_error(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

Result<std::vector<double>> parse_line(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view word : split_words(line)) {
    const auto value = parse_double(word);
    if (!value || !(std::abs(*value) <= kMaxCoordinate)) {
      return line_error("must be a number within 1e6, is " + printable(word, 60), "line");
    }
    numbers.push_back(*value);
  }
  return numbers;
}

bool is_share(double value) {
  return value >= 0.0 && value <= 1.0;
}

/// Five numbers are a class and four shares, or four pixels and a score.
bool begins_with_class(const std::vector<double>& n) {
  return n.size() == 6 ||
         (std::floor(n[0]) == n[0] && std::all_of(n.begin() + 1, n.end(), is_share));
}

Result<std::string> class_name(double number, const std::vector<std::string>& given) {
  const std::vector<std::string> names = given.empty() ? coco_class_names() : given;
  if (number >= 0.0 && number < static_cast<double>(names.size()) && std::floor(number) == number) {
    return names[static_cast<std::size_t>(number)];
  }
  return line_error("must be a class number in 0 .. " + std::to_string(names.size() - 1) + ", is " +
                        json_number(number),
                    "class");
}

Result<Probability> probability(double value) {
  if (is_share(value)) return Probability(value);
  return line_error("must be in 0 .. 1, is " + json_number(value), "score");
}

/// class, centre, size [, score]; in shares of the image.
Result<TextDetection> yolo_detection(const std::vector<double>& n,
                                     const DetectionReadOptions& options) {
  TextDetection out;
  out.is_share = true;
  HYPERMAP_ASSIGN_OR_RETURN(out.detection.label, class_name(n[0], options.class_names));
  HYPERMAP_ASSIGN_OR_RETURN(out.detection.score, probability(n.size() == 6 ? n[5] : 1.0));
  out.detection.box_px = {
      n[1] - 0.5 * n[3], n[2] - 0.5 * n[4], n[1] + 0.5 * n[3], n[2] + 0.5 * n[4]};
  return out;
}

/// upper left corner, size, score; in pixels.
Result<TextDetection> plain_detection(const std::vector<double>& n,
                                      const DetectionReadOptions& options) {
  TextDetection out;
  out.detection.label = options.class_names.size() == 1 ? options.class_names.front() : "object";
  HYPERMAP_ASSIGN_OR_RETURN(out.detection.score, probability(n[4]));
  out.detection.box_px = {n[0], n[1], n[0] + n[2], n[1] + n[3]};
  return out;
}

Result<TextDetection> parse_line(std::string_view line, const DetectionReadOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> n, parse_line(line));
  if (n.size() != 5 && n.size() != 6) {
    return line_error("must have 5 or 6 numbers, has " + std::to_string(n.size()), "line");
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      TextDetection out,
      begins_with_class(n) ? yolo_detection(n, options) : plain_detection(n, options));
  const PixelBox& box = out.detection.box_px;
  if (box.width_px() > 0.0 && box.height_px() > 0.0) return out;
  return line_error(
      "must have an area, is " + json_number(box.width_px()) + " x " + json_number(box.height_px()),
      "box");
}

}  // namespace

Result<void> parse_detection_text(std::string_view text,
                                  const std::string& file,
                                  const std::string& image,
                                  DetectionSetBuilder& builder) {
  FrameDetections frame;
  frame.image = image;
  for (const TextLine& line : split_lines(text)) {
    if (trimmed(line.text).empty()) continue;
    auto parsed = parse_line(line.text, builder.options());
    if (parsed && !frame.detections.empty() && parsed->is_share != frame.boxes_are_shares) {
      parsed = line_error("must be in the form of the lines before", "line");
    }
    if (!parsed) {
      Error error = std::move(parsed).error();
      error.file = file;
      error.line = line.number;
      return Unexpected(std::move(error));
    }
    frame.boxes_are_shares = parsed->is_share;
    frame.detections.push_back(std::move(parsed->detection));
  }
  return builder.add(std::move(frame), 0);
}

}  // namespace hypermap
