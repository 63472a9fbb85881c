// SPDX-License-Identifier: BSD-3-Clause
// Mask R-CNN: boxes, labels, scores and masks of objects, each an output.
#include "network_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

class MaskRcnnRows final : public NetworkRows {
 public:
  MaskRcnnRows(std::span<const NetworkOutput> outputs,
               const OutputLayout& layout,
               const NetworkSize& size)
      : boxes_({.values = outputs[layout.boxes].values, .row_step = 4}),
        scores_(outputs[*layout.scores].values),
        labels_(outputs[*layout.labels].values),
        masks_(outputs[*layout.masks]),
        size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept override { return scores_.size(); }

  /// Labels count from 1 on; 0 is background.
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    const double label = static_cast<double>(labels_[row]);
    if (label == 0.0) return {};
    const bool is_class = label >= 1.0 && label <= static_cast<double>(size_.num_classes);
    if (!is_class) return {.score = std::numeric_limits<double>::quiet_NaN()};
    return {.score = static_cast<double>(scores_[row]),
            .best_class = static_cast<std::size_t>(label) - 1};
  }

  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    return {boxes_.at(row, 0), boxes_.at(row, 1), boxes_.at(row, 2), boxes_.at(row, 3)};
  }

  [[nodiscard]] bool is_suppressed() const noexcept override { return true; }

  /// Of several masks that of the label. A mask of the input's size is one of the input, another
  /// one of the box.
  [[nodiscard]] std::optional<MaskGrid> mask(std::size_t row) const override {
    const std::size_t num_masks = masks_.shape[1];
    const auto label = static_cast<std::size_t>(labels_[row]);
    const bool has_background = num_masks == size_.num_classes + 1;
    const std::size_t channel = num_masks == 1 ? 0 : (has_background ? label : label - 1);
    const std::size_t num_cells = masks_.shape[2] * masks_.shape[3];
    const auto values = masks_.values.subspan((row * num_masks + channel) * num_cells, num_cells);
    const double side = size_.input_side_px;
    const auto whole = static_cast<std::size_t>(size_.input_side_px);
    const bool is_of_input = masks_.shape[2] == whole && masks_.shape[3] == whole;
    const PixelBox box = box_px(row);
    if (!is_of_input && (box.width_px() <= 0.0 || box.height_px() <= 0.0)) return std::nullopt;
    return MaskGrid{.place_px = is_of_input ? PixelBox{0.0, 0.0, side, side} : box,
                    .width = static_cast<int>(masks_.shape[3]),
                    .height = static_cast<int>(masks_.shape[2]),
                    .values = {values.begin(), values.end()},
                    .threshold = 0.5};
  }

 private:
  NumberTable boxes_;
  std::span<const float> scores_;
  std::span<const float> labels_;
  const NetworkOutput& masks_;
  NetworkSize size_;
};

}  // namespace

std::unique_ptr<const NetworkRows> mask_rcnn_rows(std::span<const NetworkOutput> outputs,
                                                  const OutputLayout& layout,
                                                  const NetworkSize& size) {
  return std::make_unique<MaskRcnnRows>(outputs, layout, size);
}

}  // namespace hypermap
