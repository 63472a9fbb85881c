// SPDX-License-Identifier: BSD-3-Clause
#include "plan_mask.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <utility>

namespace hypermap {
namespace {

struct Pixel {
  int col = 0;
  int row = 0;
};

/// Of each pixel the distance to the nearest set one in its column, `far` at most.
std::vector<int> column_distances(const PlanMask& mask, int far) {
  const auto cols = static_cast<std::size_t>(mask.cols());
  std::vector<int> distances(cols * static_cast<std::size_t>(mask.rows()), far);
  const auto pass = [&](int row, int before) {
    int* here = distances.data() + static_cast<std::size_t>(row) * cols;
    const int* there = distances.data() + static_cast<std::size_t>(before) * cols;
    for (std::size_t col = 0; col < cols; ++col) here[col] = std::min(here[col], there[col] + 1);
  };
  for (int row = 0; row < mask.rows(); ++row) {
    for (int col = 0; col < mask.cols(); ++col) {
      if (mask.at(col, row))
        distances[static_cast<std::size_t>(row) * cols + static_cast<std::size_t>(col)] = 0;
    }
    if (row > 0) pass(row, row - 1);
  }
  for (int row = mask.rows() - 2; row >= 0; --row) pass(row, row + 1);
  return distances;
}

/// Half of a chord of a disc, by the distance of the chord from its centre.
std::vector<int> half_chords(int radius) {
  std::vector<int> half;
  for (int y = 0; y <= radius; ++y) {
    int x = radius;
    while (x * x + y * y > radius * radius) --x;
    half.push_back(x);
  }
  return half;
}

/// How many intervals of a row begin, less those that end, at each pixel.
void add_interval(std::vector<int>& changes, int first, int last) {
  const int end = static_cast<int>(changes.size()) - 1;
  ++changes[static_cast<std::size_t>(std::max(first, 0))];
  --changes[static_cast<std::size_t>(std::min(last + 1, end))];
}

/// Sets in `reached` what is connected over edges with `from` through pixels where `passes`, and
/// tells how many those are.
template <class Passes>
std::size_t flood(PlanMask& reached, Pixel from, const Passes& passes) {
  constexpr std::array<Pixel, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<Pixel> open{from};
  reached.set(from.col, from.row);
  std::size_t count = 1;
  while (!open.empty()) {
    const Pixel here = open.back();
    open.pop_back();
    for (const Pixel& step : kSteps) {
      const Pixel next{here.col + step.col, here.row + step.row};
      const bool is_inside =
          next.col >= 0 && next.row >= 0 && next.col < reached.cols() && next.row < reached.rows();
      if (!is_inside || reached.at(next.col, next.row) || !passes(next)) continue;
      reached.set(next.col, next.row);
      open.push_back(next);
      ++count;
    }
  }
  return count;
}

auto inside_of(const PlanMask& mask) {
  return [&mask](const Pixel& pixel) { return mask.at(pixel.col, pixel.row); };
}

}  // namespace

PlanMask::PlanMask(int cols, int rows)
    : cols_(cols),
      rows_(rows),
      set_(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), 0) {}

std::size_t PlanMask::count() const noexcept {
  return static_cast<std::size_t>(std::count(set_.begin(), set_.end(), std::uint8_t{1}));
}

PlanMask PlanMask::complement() const {
  PlanMask out = *this;
  for (std::uint8_t& pixel : out.set_) pixel ^= 1U;
  return out;
}

PlanMask& PlanMask::operator|=(const PlanMask& other) noexcept {
  assert(cols_ == other.cols_ && rows_ == other.rows_);
  std::transform(set_.begin(), set_.end(), other.set_.begin(), set_.begin(), std::bit_or<>());
  return *this;
}

PlanMask& PlanMask::operator&=(const PlanMask& other) noexcept {
  assert(cols_ == other.cols_ && rows_ == other.rows_);
  std::transform(set_.begin(), set_.end(), other.set_.begin(), set_.begin(), std::bit_and<>());
  return *this;
}

// A set pixel at the distance y in its column reaches a chord of the disc in this row. Farther ones
// of the same column reach less, so the nearest of each column decides.
PlanMask dilated(const PlanMask& mask, int radius) {
  const std::vector<int> distances = column_distances(mask, radius + 1);
  const std::vector<int> half = half_chords(radius);
  PlanMask out(mask.cols(), mask.rows());
  std::vector<int> changes;
  for (int row = 0; row < mask.rows(); ++row) {
    changes.assign(static_cast<std::size_t>(mask.cols()) + 1, 0);
    for (int col = 0; col < mask.cols(); ++col) {
      const int d =
          distances[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.cols()) +
                    static_cast<std::size_t>(col)];
      if (d > radius) continue;
      const int reach = half[static_cast<std::size_t>(d)];
      add_interval(changes, col - reach, col + reach);
    }
    int num_open = 0;
    for (int col = 0; col < mask.cols(); ++col) {
      num_open += changes[static_cast<std::size_t>(col)];
      if (num_open > 0) out.set(col, row);
    }
  }
  return out;
}

PlanMask eroded(const PlanMask& mask, int radius) {
  return dilated(mask.complement(), radius).complement();
}

PlanMask closed(const PlanMask& mask, int radius) {
  return eroded(dilated(mask, radius), radius);
}

PlanMask opened(const PlanMask& mask, int radius) {
  return dilated(eroded(mask, radius), radius);
}

PlanMask with_holes_filled(const PlanMask& mask) {
  PlanMask outside(mask.cols(), mask.rows());
  const auto is_open = [&](const Pixel& pixel) { return !mask.at(pixel.col, pixel.row); };
  const auto enter = [&](int col, int row) {
    if (is_open({col, row}) && !outside.at(col, row)) flood(outside, {col, row}, is_open);
  };
  for (int col = 0; col < mask.cols(); ++col) {
    enter(col, 0);
    enter(col, mask.rows() - 1);
  }
  for (int row = 0; row < mask.rows(); ++row) {
    enter(0, row);
    enter(mask.cols() - 1, row);
  }
  return outside.complement();
}

PlanMask without_corner_contacts(PlanMask mask) {
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (int row = 0; row + 1 < mask.rows(); ++row) {
      for (int col = 0; col + 1 < mask.cols(); ++col) {
        const bool rises = mask.at(col, row) && mask.at(col + 1, row + 1);
        const bool falls = mask.at(col + 1, row) && mask.at(col, row + 1);
        const int num_set = static_cast<int>(mask.at(col, row)) + mask.at(col + 1, row) +
                            mask.at(col, row + 1) + mask.at(col + 1, row + 1);
        if (num_set != 2 || !(rises || falls)) continue;
        mask.set(rises ? col : col + 1, row + 1);
        is_done = false;
      }
    }
  }
  return mask;
}

MaskParts without_specks(const PlanMask& mask, double share) {
  PlanMask seen(mask.cols(), mask.rows());
  std::vector<std::pair<Pixel, std::size_t>> parts;
  for (int row = 0; row < mask.rows(); ++row) {
    for (int col = 0; col < mask.cols(); ++col) {
      if (!mask.at(col, row) || seen.at(col, row)) continue;
      parts.emplace_back(Pixel{col, row}, flood(seen, {col, row}, inside_of(mask)));
    }
  }
  std::size_t most = 0;
  for (const auto& [pixel, count] : parts) most = std::max(most, count);
  MaskParts kept{PlanMask(mask.cols(), mask.rows()), 0};
  for (const auto& [pixel, count] : parts) {
    if (static_cast<double>(count) < share * static_cast<double>(most)) continue;
    flood(kept.mask, pixel, inside_of(mask));
    ++kept.num_parts;
  }
  return kept;
}

}  // namespace hypermap
