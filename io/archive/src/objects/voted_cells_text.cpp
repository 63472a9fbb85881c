// SPDX-License-Identifier: BSD-3-Clause
#include "voted_cells_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace hypermap {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";
constexpr std::string_view kVoteDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// Of each character its place among `digits`, or kNoDigit.
constexpr std::uint8_t kNoDigit = 0xFF;
using DigitValues = std::array<std::uint8_t, 256>;
constexpr DigitValues values_of(std::string_view digits) {
  DigitValues values{};
  for (std::uint8_t& value : values) value = kNoDigit;
  for (std::size_t i = 0; i < digits.size(); ++i)
    values.at(static_cast<unsigned char>(digits[i])) = static_cast<std::uint8_t>(i);
  return values;
}
constexpr DigitValues kHexValues = values_of(kHexDigits);
constexpr DigitValues kVoteValues = values_of(kVoteDigits);

/// Of the digit at `index`; kNoDigit where the text ends before.
std::uint8_t value_at(std::string_view text, std::size_t index, const DigitValues& values) {
  return index < text.size() ? values.at(static_cast<unsigned char>(text[index])) : kNoDigit;
}

constexpr unsigned kBitsOfVoteDigit = 5;
constexpr std::uint32_t kMoreDigits = 1U << kBitsOfVoteDigit;
constexpr int kMaxLevels = 32;

class CellReader {
 public:
  CellReader(const VotedCellsText& text, std::uint32_t max_cells)
      : text_(text), max_cells_(max_cells), masks_(text.masks), votes_(text.votes) {}

  Result<std::vector<PointVote>> read() {
    if (text_.levels < 0 || text_.levels > kMaxLevels)
      return fail(ErrorCode::kMalformedFile,
                  "must be in 0 .. 32, is " + std::to_string(text_.levels),
                  "levels");
    cells_.reserve(std::min<std::size_t>(votes_.size(), max_cells_));
    if (!votes_.empty()) HYPERMAP_TRY(read_node({0, 0, 0}, text_.levels));
    if (!masks_.empty() || !votes_.empty())
      return fail(ErrorCode::kMalformedFile,
                  "has digits beyond the last cell",
                  masks_.empty() ? "votes" : "cells");
    std::sort(cells_.begin(), cells_.end());
    return std::move(cells_);
  }

 private:
  Result<void> read_node(const std::array<std::uint32_t, 3>& low, int level) {
    if (level == 0) return read_cell(low);
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t mask, take_mask());
    for (std::uint32_t k = 0; k < 8; ++k) {
      if ((mask >> k & 1U) == 0) continue;
      const auto shift = static_cast<unsigned>(level - 1);
      HYPERMAP_TRY(read_node({low[0] + ((k >> 2U & 1U) << shift),
                              low[1] + ((k >> 1U & 1U) << shift),
                              low[2] + ((k & 1U) << shift)},
                             level - 1));
    }
    return {};
  }

  Result<void> read_cell(const std::array<std::uint32_t, 3>& at) {
    const auto x = coordinate(text_.origin.x, at[0]);
    const auto y = coordinate(text_.origin.y, at[1]);
    const auto z = coordinate(text_.origin.z, at[2]);
    if (!x || !y || !z) return fail(ErrorCode::kMalformedFile, "has a cell beyond 2^31", "cells");
    if (cells_.size() == max_cells_) {
      return fail(ErrorCode::kMalformedFile,
                  "are of more cells than max_cells = " + std::to_string(max_cells_),
                  "votes");
    }
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t votes, take_votes());
    cells_.push_back({.cell = {*x, *y, *z}, .votes = votes});
    return {};
  }

  static std::optional<std::int32_t> coordinate(std::int32_t origin, std::uint32_t offset) {
    const std::int64_t sum = std::int64_t{origin} + std::int64_t{offset};
    if (sum > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
    return static_cast<std::int32_t>(sum);
  }

  Result<std::uint32_t> take_mask() {
    const std::uint32_t high = value_at(masks_, 0, kHexValues);
    const std::uint32_t low = value_at(masks_, 1, kHexValues);
    if (high == kNoDigit || low == kNoDigit || high + low == 0)
      return fail(ErrorCode::kMalformedFile,
                  "ends, or has no mask of children, where one is expected",
                  "cells");
    masks_.remove_prefix(2);
    return high << 4U | low;
  }

  Result<std::uint32_t> take_votes() {
    std::uint64_t votes = 0;
    for (unsigned shift = 0; shift < 32; shift += kBitsOfVoteDigit) {
      const std::uint32_t digit = value_at(votes_, 0, kVoteValues);
      if (digit == kNoDigit) break;
      votes_.remove_prefix(1);
      votes |= std::uint64_t{digit % kMoreDigits} << shift;
      if (digit >= kMoreDigits) continue;
      if (votes > std::numeric_limits<std::uint32_t>::max()) break;
      return static_cast<std::uint32_t>(votes);
    }
    return fail(ErrorCode::kMalformedFile,
                "ends, or has no number of 32 bits, where votes of a cell are expected",
                "votes");
  }

  const VotedCellsText& text_;
  std::uint32_t max_cells_;
  std::string_view masks_;
  std::string_view votes_;
  std::vector<PointVote> cells_;
};

}  // namespace

Result<std::vector<PointVote>> voted_cells(const VotedCellsText& text, std::uint32_t max_cells) {
  return CellReader(text, max_cells).read();
}

}  // namespace hypermap
