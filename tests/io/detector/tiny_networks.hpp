// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Networks that give the same numbers for every image, of any form, and what a detector sees by
/// them.
#pragma once

#include "hypermap/io/detector/onnx_detector.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"
#include "support/tiny_onnx.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {

inline constexpr int kTinySide = 32;  // grids of 4 x 4, 2 x 2 and 1 x 1 cells: 21 rows
inline constexpr std::int64_t kTinyCells = 21;

inline OnnxDetectorOptions two_classes() {
  return {.input_side_px = kTinySide, .class_names = {"cup", "chair"}};
}

struct SeenByNetwork {
  NetworkForm form = NetworkForm::kAuto;
  std::vector<Detection> detections;
};

inline Result<SeenByNetwork> look(const std::vector<TinyOutput>& outputs,
                                  const ColorImage& image = ColorImage(kTinySide, kTinySide),
                                  const OnnxDetectorOptions& options = two_classes()) {
  const TempDir dir;
  write_text(dir / "m.onnx", test::tiny_onnx(kTinySide, kTinySide, outputs));
  ClassRegistry registry;
  auto detector = OnnxDetector::load(dir / "m.onnx", options, registry);
  if (!detector) return Unexpected(detector.error());
  auto found = detector->detect(image);
  if (!found) return Unexpected(found.error());
  return SeenByNetwork{detector->form(), std::move(*found)};
}

inline std::string refusal(const Result<SeenByNetwork>& seen) {
  return seen ? std::string("was accepted") : to_string(seen.error());
}

/// A table of zeros with some rows.
inline std::vector<float> table(
    std::int64_t num_rows,
    std::int64_t length,
    const std::vector<std::pair<std::size_t, std::vector<float>>>& rows) {
  std::vector<float> values(static_cast<std::size_t>(num_rows * length), 0.0F);
  for (const auto& [row, numbers] : rows) {
    std::copy(numbers.begin(), numbers.end(), values.begin() + static_cast<long>(row) * length);
  }
  return values;
}

inline std::vector<float> transposed(const std::vector<float>& values, std::int64_t num_rows) {
  const auto rows = static_cast<std::size_t>(num_rows);
  const std::size_t length = values.size() / rows;
  std::vector<float> out(values.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < length; ++i) out[i * rows + row] = values[row * length + i];
  }
  return out;
}

inline void expect_box(const Detection& detection, const PixelBox& box_px) {
  EXPECT_NEAR(detection.box_px.u_min_px, box_px.u_min_px, 1e-4);
  EXPECT_NEAR(detection.box_px.v_min_px, box_px.v_min_px, 1e-4);
  EXPECT_NEAR(detection.box_px.u_max_px, box_px.u_max_px, 1e-4);
  EXPECT_NEAR(detection.box_px.v_max_px, box_px.v_max_px, 1e-4);
}

inline void expect_scores(const Detection& detection, double score, double cup, double chair) {
  EXPECT_NEAR(detection.score.value(), score, 1e-6);
  ASSERT_EQ(detection.class_scores.size(), 2U);
  EXPECT_NEAR(detection.class_scores[0].probability.value(), cup, 1e-6);
  EXPECT_NEAR(detection.class_scores[1].probability.value(), chair, 1e-6);
}

/// The one detection of a network; a failure of the test when there is another number.
inline Detection only(const Result<SeenByNetwork>& seen, NetworkForm form) {
  EXPECT_TRUE(seen) << refusal(seen);
  if (!seen || seen->detections.size() != 1) {
    ADD_FAILURE() << (seen ? seen->detections.size() : 0) << " detections";
    return {};
  }
  EXPECT_EQ(name_of(seen->form), name_of(form));
  return seen->detections.front();
}

inline TinyOutput yolox(std::vector<float> values) {
  return {"output", {1, kTinyCells, 7}, std::move(values)};
}
inline TinyOutput yolov5(std::vector<float> values) {
  return {"output", {1, 3 * kTinyCells, 7}, std::move(values)};
}
inline TinyOutput yolov8(const std::vector<float>& rows) {
  return {"output0", {1, 6, kTinyCells}, transposed(rows, kTinyCells)};
}
inline TinyOutput detection_output(std::vector<float> values) {
  const auto rows = static_cast<std::int64_t>(values.size()) / 7;
  return {"detection_out", {1, 1, rows, 7}, std::move(values)};
}
inline std::vector<TinyOutput> two_outputs(const char* boxes_name,
                                           std::vector<float> boxes,
                                           const char* scores_name,
                                           std::vector<float> scores) {
  const auto rows = static_cast<std::int64_t>(boxes.size()) / 4;
  return {{boxes_name, {1, rows, 4}, std::move(boxes)},
          {scores_name, {1, rows, 3}, std::move(scores)}};
}

}  // namespace hypermap::test
