// SPDX-License-Identifier: BSD-3-Clause
#include "network_rows.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {

RowScores best_of(std::vector<double> classes, double objectness) {
  RowScores out{.score = objectness};
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < classes.size(); ++c) {
    if (classes[c] <= best) continue;
    best = classes[c];
    out.best_class = c;
    if (std::isnan(best)) break;
  }
  out.score = objectness * best;
  out.classes = std::move(classes);
  return out;
}

std::vector<double> NumberTable::cells(std::size_t row,
                                       std::size_t first,
                                       std::size_t count) const {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = at(row, first + i);
  return out;
}

std::unique_ptr<const NetworkRows> rows_of(std::span<const NetworkOutput> outputs,
                                           const OutputLayout& layout,
                                           const NetworkSize& size) {
  switch (layout.form) {
    case NetworkForm::kSsd:
    case NetworkForm::kDetr:
      return query_rows(outputs, layout, size);
    case NetworkForm::kMaskRcnn:
      return mask_rcnn_rows(outputs, layout, size);
    default:
      return cell_rows(outputs, layout, size);
  }
}

}  // namespace hypermap
