// SPDX-License-Identifier: BSD-3-Clause
#include "mask_cells.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {
namespace {

/// 1 within `reach` of a mark along one line of cells, `stride` apart.
void widen_line(const std::uint8_t* marks,
                std::size_t count,
                std::size_t stride,
                std::size_t reach,
                std::uint8_t* into) {
  std::size_t end = 0;  // all before it are written
  for (std::size_t i = 0; i < count; ++i) {
    if (marks[i * stride] == 0) continue;
    const std::size_t last = std::min(count, i + reach + 1);
    for (std::size_t k = std::max(end, i - std::min(i, reach)); k < last; ++k) into[k * stride] = 1;
    end = std::max(end, last);
  }
}

}  // namespace

std::vector<std::uint8_t> widened(const DepthWindow& window,
                                  const std::vector<std::uint8_t>& marks,
                                  int reach) {
  const auto width = static_cast<std::size_t>(window.width());
  const auto height = static_cast<std::size_t>(window.height());
  const auto cells = static_cast<std::size_t>(reach);
  std::vector<std::uint8_t> in_rows(marks.size(), 0);
  for (std::size_t y = 0; y < height; ++y) {
    widen_line(&marks[y * width], width, 1, cells, &in_rows[y * width]);
  }
  std::vector<std::uint8_t> result(marks.size(), 0);
  for (std::size_t x = 0; x < width; ++x) {
    widen_line(&in_rows[x], height, width, cells, &result[x]);
  }
  return result;
}

}  // namespace hypermap
