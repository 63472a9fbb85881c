// SPDX-License-Identifier: BSD-3-Clause
// Forms whose rows are the cells of grids: YOLOX, YOLOv5, YOLOv8, NanoDet.
#include "network_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// Where a row's cell lies: its stride and its column and row in cells.
struct OutputCell {
  int stride_px = 0;
  int column = 0;
  int row = 0;
};

std::vector<OutputCell> cells_of(const OutputGrids& grids, int input_side_px) {
  std::vector<OutputCell> cells;
  cells.reserve(grids.num_rows);
  for (const int stride : grids.strides_px) {
    const int side = (input_side_px + stride - 1) / stride;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) cells.push_back({stride, column, row});
    }
  }
  return cells;
}

PixelBox box_around(double u, double v, double width, double height) {
  return {u - 0.5 * width, v - 0.5 * height, u + 0.5 * width, v + 0.5 * height};
}

/// Columns of a YOLO row: 0 .. 3 the box, then objectness if it has one, then the classes.
class YoloRows : public NetworkRows {
 public:
  YoloRows(NumberTable table, std::size_t num_rows, std::size_t num_classes, bool has_objectness)
      : table_(table),
        num_rows_(num_rows),
        num_classes_(num_classes),
        has_objectness_(has_objectness) {}

  [[nodiscard]] std::size_t size() const noexcept override { return num_rows_; }

  /// A row of no object needs no look at its classes, which are 1 at most.
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    const double objectness = has_objectness_ ? table_.at(row, 4) : 1.0;
    if (objectness <= 0.0) return {};
    return best_of(table_.cells(row, has_objectness_ ? 5 : 4, num_classes_), objectness);
  }

  /// Centre and size in pixels of the input.
  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    return box_around(table_.at(row, 0), table_.at(row, 1), table_.at(row, 2), table_.at(row, 3));
  }

 protected:
  [[nodiscard]] const NumberTable& table() const noexcept { return table_; }

 private:
  NumberTable table_;
  std::size_t num_rows_;
  std::size_t num_classes_;
  bool has_objectness_;
};

/// Centre = (raw + cell) * stride, size = e^raw * stride.
class YoloxRows final : public YoloRows {
 public:
  YoloxRows(NumberTable table, std::vector<OutputCell> cells, std::size_t num_classes)
      : YoloRows(table, cells.size(), num_classes, true), cells_(std::move(cells)) {}

  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    const OutputCell& cell = cells_[row];
    const double stride = cell.stride_px;
    return box_around((table().at(row, 0) + cell.column) * stride,
                      (table().at(row, 1) + cell.row) * stride,
                      std::exp(table().at(row, 2)) * stride,
                      std::exp(table().at(row, 3)) * stride);
  }

 private:
  std::vector<OutputCell> cells_;
};

/// Classes, then for each side (left, top, right, bottom) logits of its distance, 0 .. B - 1
/// strides: the distance is their mean. Source: Li et al. 2020, "Generalized Focal Loss".
class NanodetRows final : public NetworkRows {
 public:
  NanodetRows(NumberTable table,
              std::vector<OutputCell> cells,
              double cell_centre,
              std::size_t num_classes)
      : table_(table),
        cells_(std::move(cells)),
        cell_centre_(cell_centre),
        num_classes_(num_classes),
        num_bins_((table.row_step - num_classes) / 4) {}

  [[nodiscard]] std::size_t size() const noexcept override { return cells_.size(); }
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    return best_of(table_.cells(row, 0, num_classes_), 1.0);
  }
  [[nodiscard]] PixelBox box_px(std::size_t row) const override {
    const OutputCell& cell = cells_[row];
    const double stride = cell.stride_px;
    const double u = (cell.column + cell_centre_) * stride;
    const double v = (cell.row + cell_centre_) * stride;
    return {u - distance(row, 0) * stride,
            v - distance(row, 1) * stride,
            u + distance(row, 2) * stride,
            v + distance(row, 3) * stride};
  }

 private:
  [[nodiscard]] double distance(std::size_t row, std::size_t side) const {
    const auto logits = table_.cells(row, num_classes_ + side * num_bins_, num_bins_);
    const double largest = *std::max_element(logits.begin(), logits.end());
    double sum = 0.0;
    double weighted = 0.0;
    for (std::size_t bin = 0; bin < logits.size(); ++bin) {
      const double weight = std::exp(logits[bin] - largest);
      sum += weight;
      weighted += static_cast<double>(bin) * weight;
    }
    return weighted / sum;
  }

  NumberTable table_;
  std::vector<OutputCell> cells_;
  double cell_centre_;  ///< Where in a cell its point lies, in strides.
  std::size_t num_classes_;
  std::size_t num_bins_;
};

}  // namespace

std::unique_ptr<const NetworkRows> cell_rows(const NetworkOutput& output,
                                             const OutputLayout& layout,
                                             const NetworkSize& size) {
  const NumberTable by_row{.values = output.values, .row_step = output.shape[2]};
  const OutputGrids grids = output_grids(size.input_side_px, layout.has_stride_64);
  if (layout.form == NetworkForm::kYolox) {
    return std::make_unique<YoloxRows>(
        by_row, cells_of(grids, size.input_side_px), size.num_classes);
  }
  if (layout.form == NetworkForm::kYolov5) {
    return std::make_unique<YoloRows>(by_row, output.shape[1], size.num_classes, true);
  }
  if (layout.form == NetworkForm::kYolov8) {
    const NumberTable by_column{
        .values = output.values, .row_step = 1, .column_step = output.shape[2]};
    return std::make_unique<YoloRows>(by_column, output.shape[2], size.num_classes, false);
  }
  // The later networks, with a fourth grid, have their points at the cells' corners.
  const double cell_centre = layout.has_stride_64 ? 0.0 : 0.5;
  return std::make_unique<NanodetRows>(
      by_row, cells_of(grids, size.input_side_px), cell_centre, size.num_classes);
}

}  // namespace hypermap
