// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a network says of one image, row by row, whatever its form.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "mask_grid.hpp"
#include "network_output.hpp"
#include "output_layout.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// How sure a row is of what.
struct RowScores {
  double score = 0.0;                ///< NaN where a number of the row is.
  std::size_t best_class = 0;        ///< In the network's order.
  std::vector<double> classes = {};  ///< Probability of each; empty: the row names its class alone.
};

class NetworkRows {
 public:
  NetworkRows() = default;
  NetworkRows(const NetworkRows&) = delete;
  NetworkRows& operator=(const NetworkRows&) = delete;
  NetworkRows(NetworkRows&&) = delete;
  NetworkRows& operator=(NetworkRows&&) = delete;
  virtual ~NetworkRows() = default;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// Requires: row < size().
  [[nodiscard]] virtual RowScores scores(std::size_t row) const = 0;
  /// In pixels of the input, of any size. Requires: row < size().
  [[nodiscard]] virtual PixelBox box_px(std::size_t row) const = 0;
  /// Whether the network itself gives an object but one row.
  [[nodiscard]] virtual bool is_suppressed() const noexcept { return false; }
  /// What is known of the object's pixels. Requires: a row with a class.
  [[nodiscard]] virtual std::optional<MaskGrid> mask(std::size_t /*row*/) const { return {}; }
};

/// The best of the class probabilities times objectness; of equals the first.
[[nodiscard]] RowScores best_of(std::vector<double> classes, double objectness);

/// A table of numbers, row by row or column by column.
struct NumberTable {
  std::span<const float> values;
  std::size_t row_step = 0;
  std::size_t column_step = 1;

  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return static_cast<double>(values[row * row_step + column * column_step]);
  }
  /// `count` numbers of a row.
  [[nodiscard]] std::vector<double> cells(std::size_t row,
                                          std::size_t first,
                                          std::size_t count) const;
};

/// Rows of the outputs, which must live as long. Requires: `layout` is that of `outputs`.
[[nodiscard]] std::unique_ptr<const NetworkRows> rows_of(std::span<const NetworkOutput> outputs,
                                                         const OutputLayout& layout,
                                                         const NetworkSize& size);
/// The same for the forms whose rows are cells of grids, for SSD and DETR, and for Mask R-CNN.
[[nodiscard]] std::unique_ptr<const NetworkRows> cell_rows(std::span<const NetworkOutput> outputs,
                                                           const OutputLayout& layout,
                                                           const NetworkSize& size);
[[nodiscard]] std::unique_ptr<const NetworkRows> query_rows(std::span<const NetworkOutput> outputs,
                                                            const OutputLayout& layout,
                                                            const NetworkSize& size);
[[nodiscard]] std::unique_ptr<const NetworkRows> mask_rcnn_rows(
    std::span<const NetworkOutput> outputs, const OutputLayout& layout, const NetworkSize& size);

}  // namespace hypermap
