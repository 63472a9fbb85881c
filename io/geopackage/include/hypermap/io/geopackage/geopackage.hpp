// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tables of shapes as a GeoPackage, the SQLite file that geographic information systems read.
///
/// Source: OGC 12-128r18, GeoPackage Encoding Standard 1.3.1, clauses 1 and 2.1 (features).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace hypermap {

enum class GeoPackageType : std::uint8_t { kInteger, kReal, kText };

struct GeoPackageColumn {
  std::string name;  ///< Not `fid` nor `geom`.
  GeoPackageType type = GeoPackageType::kText;
};

/// std::monostate: unknown (NULL).
using GeoPackageValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct GeoPackageFeature {
  std::vector<Polygon> parts;           ///< One geometry; none: unknown (NULL).
  std::vector<GeoPackageValue> values;  ///< One for each column, of its type or unknown.
};

/// A table of features. Unit: metre. Frame: that which `description` names.
struct GeoPackageTable {
  std::string name = {};  ///< In SQL, and for people (the standard's identifier).
  std::string description = {};
  std::vector<GeoPackageColumn> columns = {};
  std::vector<GeoPackageFeature> features = {};
};

/// The bytes of a GeoPackage with these tables: of each `fid` (1, 2, ...), `geom` (MULTIPOLYGON)
/// and its columns, in the undefined Cartesian reference system (-1).
///
/// The same tables give the same bytes, with one version of SQLite: what the standard would have as
/// the time of the last change is 1970.
/// Scope: no index of places, no coordinates on Earth.
/// Errors: kInvalidArgument for a name of a table or column that is empty, not UTF-8, holds NUL, is
/// reserved (`gpkg_`, `sqlite_`, `rtree_`, `fid`, `geom`) or is there already, whatever its case;
/// kLimit when SQLite finds it too large; kOutOfMemory.
/// Requires: as many values as columns. Cost: linear; the file is made in memory.
[[nodiscard]] Result<std::string> write_geopackage(std::span<const GeoPackageTable> tables);

}  // namespace hypermap
