// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The contour reward G of a labelling, and how it changes when a block changes sides.
///
/// Source: [seeds] 3.2: over all cells, the share of equal pairs among the labels of the 3 x 3
/// patch around it, which is the sum of squared shares of labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A square of 2^level cells, cut off at the edges of the grid, by its place among its like.
struct Block {
  int col = 0;
  int row = 0;
};

/// G. Shape: rows x cols, row-major. Cost: O(cells).
[[nodiscard]] double contour_reward(int cols, int rows, std::span<const std::int32_t> labels);

/// How strongly the labels around a block pull it. A patch of n cells, k of them in the block, a of
/// them outside with label A, b with B, has its squared shares changed by 2 k (b - a) / n^2 when
/// the block goes from A to B. Summed over patches that is a weighted count of the cells of B
/// within two of the block minus that of A, and the weight of a cell is a product of one for its
/// column and one for its row.
class ContourPull {
 public:
  ContourPull() = default;
  /// For blocks of 2^level cells.
  ContourPull(int cols, int rows, int level);

  /// G changes by of(to) - of(from) when the block goes from one label to another.
  [[nodiscard]] double of(std::int32_t label,
                          Block block,
                          std::span<const std::int32_t> labels) const;

 private:
  /// Of the cells along one side of the grid that matter to a block.
  struct Side {
    int first = 0;  ///< The first cell within two of the block.
    int begin = 0;  ///< The block's cells: begin to before end.
    int end = 0;
    std::vector<double> weights;  ///< From `first` on.
  };
  [[nodiscard]] static std::vector<Side> sides_of(int num_cells, int level);

  int cols_ = 0;
  std::vector<Side> by_col_;
  std::vector<Side> by_row_;
};

}  // namespace hypermap
