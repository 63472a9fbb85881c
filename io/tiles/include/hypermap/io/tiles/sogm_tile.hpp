// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tiles as the public implementation of [sogm] stores them: cells without a header, row-major from
/// the smallest y, little-endian; everything else stands in the file's name.
///
/// Source: [sogm] III-E, as that implementation writes it.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"
#include "hypermap/projection/tiles/geographic_datum.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {

/// Numbers of cells. `INT8` and `8S` are one.
enum class SogmFormat : std::uint8_t { kS8, kU8, kS16, kU16, kS32, kU32, kF32, kF64 };

enum class SogmUnit : std::uint8_t {
  kLogOdds,      ///< Whole numbers are 16 ln(odds), real ones ln(odds).
  kProbability,  ///< Unsigned numbers are shares of the largest one, real ones lie in [0, 1].
};

/// What the name of a file says.
struct SogmTileName {
  std::string layer = {};  ///< "/amiro6/ism/cam", in the name "-amiro6-ism-cam".
  SogmFormat format = SogmFormat::kS8;
  SogmUnit unit = SogmUnit::kLogOdds;
  Stamp stamp = {};
  GridGeometry geometry = {};
  double z_m = 0.0;
  std::optional<GeographicDatum> datum = {};  ///< None where there was no fix: NaN.
  friend bool operator==(const SogmTileName&, const SogmTileName&) = default;
};

/// `What_OGM_T_<sec.nsec>s.ns_Format_INT8_Unit_logodds_Layer_-a-b_Res_10mm_X_<x>m_Y_<y>m_Z_<z>m_
/// yaw_<rad>_rows_600_cols_600_lat_.._lon_.._alt_.._.bin`, in any order; yaw, Z, Unit, What and
/// lat, lon, alt may be missing. The older form has `Timestamp_<us>us`, `LayerIdx_<n>` (layer
/// "/layer<n>") and `GridRes_<mm>mm`.
///
/// Errors: kMalformedFile naming the field: missing, told twice, no number of its unit; a layer
/// with empty parts; a geometry or datum that its `validate` refuses (also kLimit). kUnsupported
/// for another What, format or unit, or log-odds in unsigned numbers.
[[nodiscard]] Result<SogmTileName> parse_sogm_tile_name(std::string_view file_name);

/// The cells. NaN is unknown; log-odds beyond what a cell can say become that.
/// Errors: kMalformedFile when the size is not that of the name, or a cell is out of its range
/// (-128 of INT8, a probability outside [0, 1]); kIo; kOutOfMemory.
[[nodiscard]] Result<LogOddsGrid> read_sogm_cells(const ByteSource& source,
                                                  const SogmTileName& name);

struct SogmTile {
  SogmTileName name;
  LogOddsGrid grid;
};

/// Errors: those of both, with the file; kIo.
[[nodiscard]] Result<SogmTile> read_sogm_tile(const std::filesystem::path& path);

}  // namespace hypermap
