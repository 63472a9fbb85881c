// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

static_assert(std::endian::native == std::endian::little, "cells are read as they lie");

constexpr double kStepsOfWholeLogOdds = 16.0;  // INT8 = 16 ln(odds)
constexpr std::size_t kCellsAtOnce = std::size_t{1} << 16U;

std::size_t bytes_of(SogmFormat format) {
  switch (format) {
    case SogmFormat::kS8:
    case SogmFormat::kU8:
      return 1;
    case SogmFormat::kS16:
    case SogmFormat::kU16:
      return 2;
    case SogmFormat::kS32:
    case SogmFormat::kU32:
    case SogmFormat::kF32:
      return 4;
    case SogmFormat::kF64:
      break;
  }
  return 8;
}

/// None when the cell is out of its range.
template <class Number>
std::optional<LogOddsSteps> steps_of(Number number, SogmUnit unit) {
  const double value = static_cast<double>(number);
  if (std::isnan(value)) return LogOddsSteps{0};
  if (unit == SogmUnit::kLogOdds) {
    if constexpr (std::is_floating_point_v<Number>) return to_steps(LogOdds(value));
    const bool is_symmetric = number != std::numeric_limits<Number>::min();
    if (!is_symmetric) return std::nullopt;
    return to_steps(LogOdds(value / kStepsOfWholeLogOdds));
  }
  double p = value;
  if constexpr (std::is_integral_v<Number>) {
    p /= static_cast<double>(std::numeric_limits<Number>::max());
  }
  if (p < 0.0 || p > 1.0) return std::nullopt;
  return to_steps(LogOdds::of(Probability(p)));
}

template <class Number>
Result<LogOddsGrid> cells_of_type(const ByteSource& source, const SogmTileName& name) {
  const std::size_t num_cells = name.geometry.num_cells();
  std::vector<LogOddsSteps> cells;
  cells.reserve(num_cells);
  while (cells.size() < num_cells) {
    const std::size_t count = std::min(kCellsAtOnce, num_cells - cells.size());
    HYPERMAP_ASSIGN_OR_RETURN(
        const std::string bytes,
        source.read_at(cells.size() * sizeof(Number), count * sizeof(Number)));
    for (std::size_t i = 0; i < count; ++i) {
      Number number{};
      std::memcpy(&number, bytes.data() + i * sizeof(Number), sizeof(Number));
      const auto steps = steps_of(number, name.unit);
      if (!steps) {
        return fail(ErrorCode::kMalformedFile,
                    "is " + number_text(static_cast<double>(number)) + ", out of its range",
                    "cell " + std::to_string(cells.size()));
      }
      cells.push_back(*steps);
    }
  }
  return LogOddsGrid::create(name.geometry, std::move(cells));
}

}  // namespace

Result<LogOddsGrid> read_sogm_cells(const ByteSource& source, const SogmTileName& name) {
  const std::uint64_t expected = std::uint64_t{name.geometry.num_cells()} * bytes_of(name.format);
  if (source.size() != expected) {
    return fail(ErrorCode::kMalformedFile,
                "has " + std::to_string(source.size()) + " bytes, expected " +
                    std::to_string(name.geometry.rows) + " x " +
                    std::to_string(name.geometry.cols) + " x " +
                    std::to_string(bytes_of(name.format)) + " = " + std::to_string(expected),
                "cells");
  }
  return guarded(ErrorCode::kMalformedFile, "the cells", [&]() -> Result<LogOddsGrid> {
    switch (name.format) {
      case SogmFormat::kS8:
        return cells_of_type<std::int8_t>(source, name);
      case SogmFormat::kU8:
        return cells_of_type<std::uint8_t>(source, name);
      case SogmFormat::kS16:
        return cells_of_type<std::int16_t>(source, name);
      case SogmFormat::kU16:
        return cells_of_type<std::uint16_t>(source, name);
      case SogmFormat::kS32:
        return cells_of_type<std::int32_t>(source, name);
      case SogmFormat::kU32:
        return cells_of_type<std::uint32_t>(source, name);
      case SogmFormat::kF32:
        return cells_of_type<float>(source, name);
      case SogmFormat::kF64:
        break;
    }
    return cells_of_type<double>(source, name);
  });
}

Result<SogmTile> read_sogm_tile(const std::filesystem::path& path) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 31U;  // 2^28 cells of 8 bytes
  const SourceName source{path.string()};
  auto name = parse_sogm_tile_name(path.filename().string());
  if (!name) return Unexpected(with_source(std::move(name).error(), source));
  HYPERMAP_ASSIGN_OR_RETURN(const auto bytes, open_file(path, kMaxBytes));
  auto grid = read_sogm_cells(*bytes, *name);
  if (!grid) return Unexpected(with_source(std::move(grid).error(), source));
  return SogmTile{std::move(*name), std::move(*grid)};
}

}  // namespace hypermap
