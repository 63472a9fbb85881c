// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/geopackage/geopackage.hpp"

#include "feature_geometry.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "memory_database.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// Names of the two columns that each table has.
constexpr std::array<std::string_view, 2> kOwnColumns{"fid", "geom"};
constexpr std::array<std::string_view, 3> kReservedBeginnings{"gpkg_", "sqlite_", "rtree_"};
/// Nothing depends on the clock.
constexpr const char* kLastChange = "1970-01-01T00:00:00.000Z";

/// 'GPKG' and version 1.3 in the file's head, and the tables that each GeoPackage has.
constexpr const char* kCoreTables = R"sql(
PRAGMA page_size = 4096;
PRAGMA encoding = 'UTF-8';
PRAGMA application_id = 1196444487;
PRAGMA user_version = 10300;
BEGIN;
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL,
  srs_id INTEGER PRIMARY KEY NOT NULL,
  organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL,
  definition TEXT NOT NULL,
  description TEXT
);
CREATE TABLE gpkg_contents (
  table_name TEXT PRIMARY KEY NOT NULL,
  data_type TEXT NOT NULL,
  identifier TEXT UNIQUE,
  description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  min_x DOUBLE,
  min_y DOUBLE,
  max_x DOUBLE,
  max_y DOUBLE,
  srs_id INTEGER REFERENCES gpkg_spatial_ref_sys (srs_id)
);
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL UNIQUE REFERENCES gpkg_contents (table_name),
  column_name TEXT NOT NULL,
  geometry_type_name TEXT NOT NULL,
  srs_id INTEGER NOT NULL REFERENCES gpkg_spatial_ref_sys (srs_id),
  z TINYINT NOT NULL,
  m TINYINT NOT NULL,
  PRIMARY KEY (table_name, column_name)
);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('undefined Cartesian', -1, 'NONE', -1, 'undefined', 'a plane in metres'),
  ('undefined geographic', 0, 'NONE', 0, 'undefined', 'longitude and latitude of any datum'),
  ('WGS 84', 4326, 'EPSG', 4326,
   'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)sql"
                                    R"sql(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]',
   'longitude and latitude');
)sql";

std::string lower_case(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), lower_ascii);
  return lower;
}

bool is_reserved(const std::string& lower) {
  return std::ranges::any_of(kReservedBeginnings,
                             [&](std::string_view begin) { return lower.starts_with(begin); });
}

/// A name in SQL that nothing has yet, in any case. Errors: kInvalidArgument.
Result<void> check_name(std::string_view name, const std::set<std::string>& taken) {
  const auto refused = [&](const std::string& rule) {
    return fail(ErrorCode::kInvalidArgument, rule + ", is \"" + printable(name) + "\"", "name");
  };
  if (name.empty() || first_bad_utf8(name) != name.size()) return refused("must be text in UTF-8");
  if (name.find('\0') != std::string_view::npos) return refused("must be without NUL");
  const std::string lower = lower_case(name);
  if (is_reserved(lower)) return refused("must not begin as names of the standard do");
  if (taken.contains(lower)) return refused("must be another one than those before");
  return {};
}

Result<void> check_columns(const GeoPackageTable& table) {
  std::set<std::string> taken(kOwnColumns.begin(), kOwnColumns.end());
  for (const GeoPackageColumn& column : table.columns) {
    HYPERMAP_TRY(check_name(column.name, taken));
    taken.insert(lower_case(column.name));
  }
  return {};
}

Result<void> check_tables(std::span<const GeoPackageTable> tables) {
  std::set<std::string> taken;
  for (const GeoPackageTable& table : tables) {
    HYPERMAP_TRY(check_name(table.name, taken));
    taken.insert(lower_case(table.name));
    HYPERMAP_TRY(check_columns(table));
  }
  return {};
}

const char* sql_type(GeoPackageType type) {
  switch (type) {
    case GeoPackageType::kInteger:
      return "INTEGER";
    case GeoPackageType::kReal:
      return "DOUBLE";
    case GeoPackageType::kText:
      return "TEXT";
  }
  return "TEXT";
}

/// Around all features; none when none has a shape.
std::optional<Rect> extent_of(const GeoPackageTable& table) {
  std::optional<Rect> extent;
  for (const GeoPackageFeature& feature : table.features) {
    if (feature.parts.empty()) continue;
    const Rect one = bounds_of_parts(feature.parts);
    if (!extent) extent = one;
    extent->min = extent->min.cwiseMin(one.min);
    extent->max = extent->max.cwiseMax(one.max);
  }
  return extent;
}

/// The table is made and announced.
Result<void> announce(const GeoPackageTable& table, MemoryDatabase& database) {
  std::string columns = "fid INTEGER PRIMARY KEY NOT NULL, geom MULTIPOLYGON";
  for (const GeoPackageColumn& column : table.columns) {
    columns += ", " + sql_name(column.name) + " " + sql_type(column.type);
  }
  HYPERMAP_TRY(database.execute("CREATE TABLE " + sql_name(table.name) + " (" + columns + ")"));
  std::vector<SqlValue> content{
      table.name, std::string("features"), table.name, table.description, kLastChange};
  if (const auto extent = extent_of(table)) {
    content.insert(content.end(),
                   {extent->min.x(), extent->min.y(), extent->max.x(), extent->max.y()});
  } else {
    content.resize(content.size() + 4);
  }
  content.emplace_back(std::int64_t{kUndefinedCartesian});
  HYPERMAP_ASSIGN_OR_RETURN(
      SqlInsert contents,
      database.prepare("INSERT INTO gpkg_contents VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  HYPERMAP_TRY(contents.run(content));
  HYPERMAP_ASSIGN_OR_RETURN(SqlInsert geometries,
                            database.prepare("INSERT INTO gpkg_geometry_columns VALUES "
                                             "(?, 'geom', 'MULTIPOLYGON', ?, 0, 0)"));
  const std::vector<SqlValue> geometry{table.name, std::int64_t{kUndefinedCartesian}};
  return geometries.run(geometry);
}

SqlValue sql_value(const GeoPackageValue& value) {
  return std::visit([](const auto& one) { return SqlValue(one); }, value);
}

Result<void> insert_features(const GeoPackageTable& table, MemoryDatabase& database) {
  std::string marks = "NULL, ?";
  for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ", ?";
  HYPERMAP_ASSIGN_OR_RETURN(
      SqlInsert insert,
      database.prepare("INSERT INTO " + sql_name(table.name) + " VALUES (" + marks + ")"));
  for (const GeoPackageFeature& feature : table.features) {
    std::vector<SqlValue> values(1);
    values.reserve(feature.values.size() + 1);
    if (!feature.parts.empty()) values.front() = SqlBlob{feature_geometry(feature.parts)};
    for (const GeoPackageValue& value : feature.values) values.push_back(sql_value(value));
    HYPERMAP_TRY(insert.run(values));
  }
  return {};
}

Result<std::string> geopackage_of(std::span<const GeoPackageTable> tables) {
  HYPERMAP_TRY(check_tables(tables));
  HYPERMAP_ASSIGN_OR_RETURN(MemoryDatabase database, MemoryDatabase::create());
  HYPERMAP_TRY(database.execute(kCoreTables));
  for (const GeoPackageTable& table : tables) {
    HYPERMAP_TRY(announce(table, database));
    HYPERMAP_TRY(insert_features(table, database));
  }
  HYPERMAP_TRY(database.execute("COMMIT"));
  return database.bytes();
}

}  // namespace

Result<std::string> write_geopackage(std::span<const GeoPackageTable> tables) {
  return guarded(
      ErrorCode::kInvalidArgument, "the GeoPackage", [&] { return geopackage_of(tables); });
}

}  // namespace hypermap
