// SPDX-License-Identifier: BSD-3-Clause
#include "voted_cells_code.hpp"

#include "adaptive_bits.hpp"
#include "cell_coder.hpp"
#include "cell_tree.hpp"
#include "sorted_cells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr int kMaxCodeLevels = 32;
/// Of differences of two 32-bit integers, which a 32-bit one holds when they are not negative.
std::uint32_t difference(std::int32_t value, std::int32_t origin) {
  return static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(origin);
}

std::string encoded(std::vector<RelativeCell> cells, int levels) {
  CellCoder coder{BitEncoder{}};
  const SortedCells sorted(std::move(cells), levels);
  CellLevel level = root_level();
  for (int height = levels; height-- > 0;) {
    const auto shift = static_cast<unsigned>(height);
    auto children = sorted.children(shift).begin();
    for (std::size_t i = 1; i < level.size(); ++i, ++children) {
      (void)coder.code_children(level, level[i], height, *children);
      level[i].children = *children;
    }
    level = next_level(level, shift);
  }
  std::vector<std::uint32_t> votes(level.size());
  for (std::size_t i = 1; i < level.size(); ++i)
    votes[i] = coder.code_votes(level[i], votes, sorted.cells()[i - 1].votes);
  return coder.bits().finish();
}

/// Ascending by x, y, z. Cost: linear, a pass for each byte that a coordinate has.
void sort_cells(std::vector<RelativeCell>& cells, int levels) {
  std::vector<RelativeCell> sorted(cells.size());
  for (std::size_t axis = 3; axis-- > 0;) {
    for (unsigned shift = 0; shift < static_cast<unsigned>(levels); shift += 8U) {
      const auto digit = [&](const RelativeCell& cell) { return cell.at[axis] >> shift & 0xFFU; };
      std::array<std::size_t, 257> places{};
      for (const RelativeCell& cell : cells) ++places[digit(cell) + 1];
      for (std::size_t i = 1; i < places.size(); ++i) places[i] += places[i - 1];
      for (const RelativeCell& cell : cells) sorted[places[digit(cell)]++] = cell;
      cells.swap(sorted);
    }
  }
}

Unexpected malformed(const char* field, std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what), field);
}

Result<void> check_sizes(const VotedCellsCode& code, std::uint32_t max_cells) {
  if (code.levels < 0 || code.levels > kMaxCodeLevels)
    return malformed("levels", "must be in 0 .. 32, is " + std::to_string(code.levels));
  if (code.num_cells > max_cells)
    return malformed("num_cells",
                     "are more cells than max_cells = " + std::to_string(max_cells) + ", " +
                         std::to_string(code.num_cells));
  const std::uint64_t most = std::uint64_t{kMaxCellsPerByte} * code.bytes.size();
  if (code.num_cells <= most) return {};
  return malformed("bytes",
                   "are too few for " + std::to_string(code.num_cells) + " cells, " +
                       std::to_string(code.bytes.size()));
}

std::size_t least_bytes(std::size_t num_cells) {
  return (num_cells + kMaxCellsPerByte - 1) / kMaxCellsPerByte;
}

/// All bytes were used, or are the zeros that fill the least size.
Result<void> check_end(const VotedCellsCode& code, std::size_t num_used) {
  const std::size_t expected = std::max(num_used, least_bytes(code.num_cells));
  if (code.bytes.size() < expected) return malformed("bytes", "end before the last cell");
  const std::size_t last_of_code = code.bytes.find_last_not_of('\0') + 1;
  if (code.bytes.size() > expected || last_of_code > num_used)
    return malformed("bytes", "go on after the last cell");
  return {};
}

Result<std::vector<RelativeCell>> decoded(const VotedCellsCode& code) {
  CellCoder coder{BitDecoder(code.bytes)};
  CellLevel level = root_level();
  for (int height = code.levels; height-- > 0;) {
    std::size_t num_children = 0;
    for (std::size_t i = 1; i < level.size(); ++i) {
      const std::uint32_t children = coder.code_children(level, level[i], height, 0);
      num_children += num_in(children);
      level[i].children = static_cast<std::uint8_t>(children);
      if (num_children > code.num_cells)
        return malformed("bytes", "are of more than " + std::to_string(code.num_cells) + " cells");
    }
    level = next_level(level, static_cast<unsigned>(height));
  }
  const std::size_t num_cells = level.size() - 1;
  if (num_cells != code.num_cells)
    return malformed("bytes",
                     "are of " + std::to_string(num_cells) + " cells, expected " +
                         std::to_string(code.num_cells));
  std::vector<std::uint32_t> votes(level.size());
  for (std::size_t i = 1; i < level.size(); ++i) votes[i] = coder.code_votes(level[i], votes, 0);
  HYPERMAP_TRY(check_end(code, coder.bits().num_bytes_used()));
  std::vector<RelativeCell> cells;
  cells.reserve(num_cells);
  for (std::size_t i = 1; i < level.size(); ++i)
    cells.push_back({.at = level[i].low, .votes = votes[i]});
  return cells;
}

}  // namespace

VotedCellsCode voted_cells_code(std::span<const PointVote> votes) {
  VotedCellsCode code;
  if (votes.empty()) return code;
  code.num_cells = static_cast<std::uint32_t>(votes.size());
  code.origin = votes.front().cell;
  for (const PointVote& vote : votes) {
    code.origin = {.x = std::min(code.origin.x, vote.cell.x),
                   .y = std::min(code.origin.y, vote.cell.y),
                   .z = std::min(code.origin.z, vote.cell.z)};
  }
  std::vector<RelativeCell> cells;
  cells.reserve(votes.size());
  std::uint32_t bits = 0;
  for (const PointVote& vote : votes) {
    cells.push_back({.at = {difference(vote.cell.x, code.origin.x),
                            difference(vote.cell.y, code.origin.y),
                            difference(vote.cell.z, code.origin.z)},
                     .votes = vote.votes});
    for (const std::uint32_t coordinate : cells.back().at) bits |= coordinate;
  }
  code.levels = static_cast<int>(std::bit_width(bits));
  code.bytes = encoded(std::move(cells), code.levels);
  if (code.bytes.size() < least_bytes(votes.size())) code.bytes.resize(least_bytes(votes.size()));
  return code;
}

Result<std::vector<PointVote>> voted_cells(const VotedCellsCode& code, std::uint32_t max_cells) {
  HYPERMAP_TRY(check_sizes(code, max_cells));
  if (code.num_cells == 0) {
    if (!code.bytes.empty()) return malformed("bytes", "are of no cells");
    return std::vector<PointVote>{};
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<RelativeCell> relative, decoded(code));
  sort_cells(relative, code.levels);
  std::vector<PointVote> votes;
  votes.reserve(relative.size());
  const std::array origin{code.origin.x, code.origin.y, code.origin.z};
  for (const RelativeCell& cell : relative) {
    std::array<std::int32_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t sum = std::int64_t{origin.at(axis)} + std::int64_t{cell.at.at(axis)};
      if (sum > std::numeric_limits<std::int32_t>::max())
        return malformed("bytes", "have a cell beyond 2^31");
      at.at(axis) = static_cast<std::int32_t>(sum);
    }
    votes.push_back({.cell = {.x = at[0], .y = at[1], .z = at[2]}, .votes = cell.votes});
  }
  return votes;
}

}  // namespace hypermap
