// SPDX-License-Identifier: BSD-3-Clause
// Forms whose boxes are shares of the input: SSD, DETR.
#include "network_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

NumberTable table_of(const NetworkOutput& output) {
  return {.values = output.values, .row_step = output.shape.back()};
}

/// Probabilities of exponents up to a factor.
std::vector<double> softmax(std::vector<double> logits) {
  const double largest = *std::max_element(logits.begin(), logits.end());
  double sum = 0.0;
  for (double& logit : logits) {
    logit = std::exp(logit - largest);
    sum += logit;
  }
  for (double& share : logits) share /= sum;
  return logits;
}

/// Corners, and probabilities of the background and the classes.
class SsdRows final : public NetworkRows {
 public:
  SsdRows(const NetworkOutput& boxes, const NetworkOutput& scores, const NetworkSize& size)
      : boxes_(table_of(boxes)),
        scores_(table_of(scores)),
        num_rows_(boxes.shape[1]),
        size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept override { return num_rows_; }
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    return best_of(scores_.cells(row, 1, size_.num_classes), 1.0);
  }
  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    const double side = size_.input_side_px;
    return {boxes_.at(row, 0) * side,
            boxes_.at(row, 1) * side,
            boxes_.at(row, 2) * side,
            boxes_.at(row, 3) * side};
  }

 private:
  NumberTable boxes_;
  NumberTable scores_;
  std::size_t num_rows_;
  NetworkSize size_;
};

/// Rows of a DetectionOutput: image, class from 1 on, score, corners. Class 0 and image -1: none.
class DetectionOutputRows final : public NetworkRows {
 public:
  DetectionOutputRows(const NetworkOutput& output, const NetworkSize& size)
      : table_(table_of(output)), num_rows_(output.shape[2]), size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept override { return num_rows_; }
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    const double label = table_.at(row, 1);
    if (table_.at(row, 0) < 0.0 || label == 0.0) return {};
    const bool is_class = label >= 1.0 && label <= static_cast<double>(size_.num_classes);
    if (!is_class) return {.score = std::numeric_limits<double>::quiet_NaN()};
    return {.score = table_.at(row, 2), .best_class = static_cast<std::size_t>(label) - 1};
  }
  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    const double side = size_.input_side_px;
    return {table_.at(row, 3) * side,
            table_.at(row, 4) * side,
            table_.at(row, 5) * side,
            table_.at(row, 6) * side};
  }
  [[nodiscard]] bool is_suppressed() const noexcept override { return true; }

 private:
  NumberTable table_;
  std::size_t num_rows_;
  NetworkSize size_;
};

/// Centre and size, and logits of the classes and of no object.
class DetrRows final : public NetworkRows {
 public:
  DetrRows(const NetworkOutput& boxes, const NetworkOutput& logits, const NetworkSize& size)
      : boxes_(table_of(boxes)),
        logits_(table_of(logits)),
        num_rows_(boxes.shape[1]),
        size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept override { return num_rows_; }
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    auto classes = softmax(logits_.cells(row, 0, size_.num_classes + 1));
    classes.pop_back();
    return best_of(std::move(classes), 1.0);
  }
  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    const double side = size_.input_side_px;
    const double u = boxes_.at(row, 0) * side;
    const double v = boxes_.at(row, 1) * side;
    const double half_width = 0.5 * boxes_.at(row, 2) * side;
    const double half_height = 0.5 * boxes_.at(row, 3) * side;
    return {u - half_width, v - half_height, u + half_width, v + half_height};
  }
  [[nodiscard]] bool is_suppressed() const noexcept override { return true; }

 private:
  NumberTable boxes_;
  NumberTable logits_;
  std::size_t num_rows_;
  NetworkSize size_;
};

}  // namespace

std::unique_ptr<const NetworkRows> query_rows(std::span<const NetworkOutput> outputs,
                                              const OutputLayout& layout,
                                              const NetworkSize& size) {
  const NetworkOutput& boxes = outputs[layout.boxes];
  if (!layout.scores) return std::make_unique<DetectionOutputRows>(boxes, size);
  if (layout.form == NetworkForm::kSsd) {
    return std::make_unique<SsdRows>(boxes, outputs[*layout.scores], size);
  }
  return std::make_unique<DetrRows>(boxes, outputs[*layout.scores], size);
}

}  // namespace hypermap
