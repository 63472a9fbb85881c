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

/// A mask as a sum of prototypes: K grids over the whole input, and K factors of an object.
struct Prototypes {
  std::span<const float> values;
  std::size_t count = 0;
  int width = 0;
  int height = 0;
};

Prototypes prototypes_of(const NetworkOutput& output) {
  return {.values = output.values,
          .count = output.shape[1],
          .width = static_cast<int>(output.shape[3]),
          .height = static_cast<int>(output.shape[2])};
}

/// Cells [begin, end) of `size` that lie in a part of the input, and one more on each side.
struct CellRange {
  int begin = 0;
  int end = 0;
};

CellRange cells_in(double min_px, double max_px, double cell_px, int size) {
  const double last = size - 1;
  const double first = std::clamp(std::floor(min_px / cell_px) - 1.0, 0.0, last);
  const double end = std::clamp(std::ceil(max_px / cell_px) + 1.0, first + 1.0, last + 1.0);
  return {static_cast<int>(first), static_cast<int>(end)};
}

/// The sum of the prototypes around a box of the input.
MaskGrid mixed(const Prototypes& prototypes,
               std::span<const double> factors,
               const PixelBox& box,
               int input_side_px) {
  const double cell_u_px = static_cast<double>(input_side_px) / prototypes.width;
  const double cell_v_px = static_cast<double>(input_side_px) / prototypes.height;
  const CellRange us = cells_in(box.u_min_px, box.u_max_px, cell_u_px, prototypes.width);
  const CellRange vs = cells_in(box.v_min_px, box.v_max_px, cell_v_px, prototypes.height);
  MaskGrid grid{.place_px = {us.begin * cell_u_px,
                             vs.begin * cell_v_px,
                             us.end * cell_u_px,
                             vs.end * cell_v_px},
                .width = us.end - us.begin,
                .height = vs.end - vs.begin,
                .values = {},
                .threshold = 0.0};
  const auto width = static_cast<std::size_t>(prototypes.width);
  const std::size_t num_cells = width * static_cast<std::size_t>(prototypes.height);
  for (int v = vs.begin; v < vs.end; ++v) {
    for (int u = us.begin; u < us.end; ++u) {
      double sum = 0.0;
      for (std::size_t k = 0; k < prototypes.count; ++k) {
        const std::size_t cell = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
        sum += factors[k] * static_cast<double>(prototypes.values[k * num_cells + cell]);
      }
      grid.values.push_back(static_cast<float>(sum));
    }
  }
  return grid;
}

/// Columns of a YOLO row: 0 .. 3 the box, then objectness if it has one, then the classes, then
/// the factors of prototypes of masks.
class YoloRows : public NetworkRows {
 public:
  YoloRows(NumberTable table, std::size_t num_rows, std::size_t num_classes, bool has_objectness)
      : table_(table),
        num_rows_(num_rows),
        num_classes_(num_classes),
        has_objectness_(has_objectness) {}

  /// Requires: a row has as many numbers after its classes.
  void set_prototypes(const Prototypes& prototypes, int input_side_px) {
    prototypes_ = prototypes;
    input_side_px_ = input_side_px;
  }

  [[nodiscard]] std::optional<MaskGrid> mask(std::size_t row) const override {
    if (prototypes_.count == 0) return std::nullopt;
    const auto factors =
        table_.cells(row, (has_objectness_ ? 5 : 4) + num_classes_, prototypes_.count);
    return mixed(prototypes_, factors, box_px(row), input_side_px_);
  }

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
  Prototypes prototypes_;
  int input_side_px_ = 0;
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

/// Rows whose boxes are in pixels of the input.
std::unique_ptr<YoloRows> pixel_rows(const NetworkOutput& output,
                                     NetworkForm form,
                                     const NetworkSize& size) {
  if (form == NetworkForm::kYolov5) {
    return std::make_unique<YoloRows>(
        NumberTable{.values = output.values, .row_step = output.shape[2]},
        output.shape[1],
        size.num_classes,
        true);
  }
  return std::make_unique<YoloRows>(
      NumberTable{.values = output.values, .row_step = 1, .column_step = output.shape[2]},
      output.shape[2],
      size.num_classes,
      false);
}

}  // namespace

std::unique_ptr<const NetworkRows> cell_rows(std::span<const NetworkOutput> outputs,
                                             const OutputLayout& layout,
                                             const NetworkSize& size) {
  const NetworkOutput& output = outputs[layout.boxes];
  if (layout.form == NetworkForm::kYolov5 || layout.form == NetworkForm::kYolov8) {
    auto rows = pixel_rows(output, layout.form, size);
    if (layout.masks)
      rows->set_prototypes(prototypes_of(outputs[*layout.masks]), size.input_side_px);
    return rows;
  }
  const NumberTable by_row{.values = output.values, .row_step = output.shape[2]};
  const OutputGrids grids = output_grids(size.input_side_px, layout.has_stride_64);
  if (layout.form == NetworkForm::kYolox) {
    return std::make_unique<YoloxRows>(
        by_row, cells_of(grids, size.input_side_px), size.num_classes);
  }
  // The later networks, with a fourth grid, have their points at the cells' corners.
  const double cell_centre = layout.has_stride_64 ? 0.0 : 0.5;
  return std::make_unique<NanodetRows>(
      by_row, cells_of(grids, size.input_side_px), cell_centre, size.num_classes);
}

}  // namespace hypermap
