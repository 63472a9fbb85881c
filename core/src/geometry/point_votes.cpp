// SPDX-License-Identifier: BSD-3-Clause
#include "point_votes.hpp"

#include <boost/sort/pdqsort/pdqsort.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace hypermap {
namespace {

/// The cell of twice the edge that a cell lies in; rounds towards minus infinity.
PointCell widened(const PointCell& cell) {
  const auto half = [](std::int32_t i) { return (i - (i & 1)) / 2; };
  return {half(cell.x), half(cell.y), half(cell.z)};
}

/// The cells of one object lie close together: each becomes one number, of the same order. None
/// when they do not.
class PackedCells {
 public:
  [[nodiscard]] static std::optional<PackedCells> around(std::span<const PointCell> cells) {
    PackedCells packed(cells.front());
    PointCell high = cells.front();
    for (const PointCell& cell : cells) {
      packed.low_ = {std::min(packed.low_.x, cell.x),
                     std::min(packed.low_.y, cell.y),
                     std::min(packed.low_.z, cell.z)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y), std::max(high.z, cell.z)};
    }
    const auto fits = [](std::int32_t from, std::int32_t to) {
      return std::int64_t{to} - from < std::int64_t{1} << kBits;
    };
    const bool all_fit =
        fits(packed.low_.x, high.x) && fits(packed.low_.y, high.y) && fits(packed.low_.z, high.z);
    return all_fit ? std::optional(packed) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t pack(const PointCell& cell) const {
    const auto part = [](std::int32_t from, std::int32_t at) {
      return static_cast<std::uint64_t>(at - from);
    };
    return part(low_.x, cell.x) << 2 * kBits | part(low_.y, cell.y) << kBits | part(low_.z, cell.z);
  }
  [[nodiscard]] PointCell unpack(std::uint64_t number) const {
    const auto part = [](std::uint64_t shifted) {
      return static_cast<std::int32_t>(shifted & ((std::uint64_t{1} << kBits) - 1));
    };
    return {
        low_.x + part(number >> 2 * kBits), low_.y + part(number >> kBits), low_.z + part(number)};
  }

 private:
  static constexpr unsigned kBits = 21;
  explicit PackedCells(const PointCell& low) : low_(low) {}
  PointCell low_;
};

/// Ascending, each once.
void sort_unique(std::vector<PointCell>& cells) {
  if (cells.empty()) return;
  const auto packed = PackedCells::around(cells);
  if (!packed) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return;
  }
  std::vector<std::uint64_t> numbers;
  numbers.reserve(cells.size());
  for (const PointCell& cell : cells) numbers.push_back(packed->pack(cell));
  boost::sort::pdqsort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  cells.clear();
  for (const std::uint64_t number : numbers) cells.push_back(packed->unpack(number));
}

}  // namespace

std::vector<PointVote> widened(std::span<const PointVote> votes) {
  std::vector<PointVote> out;
  out.reserve(votes.size());
  for (const PointVote& vote : votes) out.push_back({widened(vote.cell), vote.votes});
  std::sort(out.begin(), out.end());  // of equal cells the one with most votes comes last
  std::size_t kept = 0;
  for (const PointVote& vote : out) {
    if (kept > 0 && out[kept - 1].cell == vote.cell) --kept;
    out[kept++] = vote;
  }
  out.resize(kept);
  return out;
}

std::vector<PointVote> votes_of(std::span<const Eigen::Vector3f> points, double edge_m) {
  std::vector<PointCell> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d point = p.cast<double>();
    if (!(point.array().abs() <= kMaxVotedCoordinateM).all()) continue;
    const Eigen::Vector3d cell = (point / edge_m).array().floor();
    cells.push_back({static_cast<std::int32_t>(cell.x()),
                     static_cast<std::int32_t>(cell.y()),
                     static_cast<std::int32_t>(cell.z())});
  }
  sort_unique(cells);
  std::vector<PointVote> votes;
  votes.reserve(cells.size());
  for (const PointCell& cell : cells) votes.push_back({cell, 1});
  return votes;
}

Eigen::Vector3d centre_of(const PointCell& cell, double edge_m) {
  return edge_m * (Eigen::Vector3d(cell.x, cell.y, cell.z).array() + 0.5);
}

std::uint32_t typical_votes(std::span<const PointVote> votes) {
  constexpr std::uint32_t kMaxCounted = 4096;
  std::uint64_t total = 0;
  std::uint32_t most = 0;
  for (const PointVote& vote : votes) {
    total += vote.votes;
    most = std::max(most, vote.votes);
  }
  if (total == 0) return 1;
  if (most > kMaxCounted) {
    std::vector<std::uint32_t> counts;
    for (const PointVote& vote : votes) counts.push_back(vote.votes);
    std::sort(counts.begin(), counts.end());
    std::uint64_t below = 0;
    std::size_t i = 0;
    while (2 * (below += counts[i]) < total) ++i;
    return counts[i];
  }
  std::vector<std::uint32_t> cells_with(most + 1, 0);
  for (const PointVote& vote : votes) ++cells_with[vote.votes];
  std::uint64_t below = 0;
  std::uint32_t typical = 0;
  while (2 * (below += std::uint64_t{typical} * cells_with[typical]) < total) ++typical;
  return typical;
}

std::vector<PointVote> sum_of(std::span<const PointVote> mine, std::span<const PointVote> votes) {
  std::vector<PointVote> sum;
  sum.reserve(mine.size() + votes.size());
  auto next = mine.begin();
  for (const PointVote& vote : votes) {
    while (next != mine.end() && next->cell < vote.cell) sum.push_back(*next++);
    sum.push_back(vote);
    if (next != mine.end() && next->cell == vote.cell) sum.back().votes += (next++)->votes;
  }
  sum.insert(sum.end(), next, mine.end());
  return sum;
}

}  // namespace hypermap
