// SPDX-License-Identifier: BSD-3-Clause
// tests/apps/geopackage_test.py reads whole files by another SQLite.
#include "hypermap/io/geopackage/geopackage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

GeoPackageTable table_named(const std::string& name) {
  GeoPackageTable table{.name = name, .columns = {{"class", GeoPackageType::kText}}};
  table.features.push_back(
      {.parts = {make_polygon({{0, 0}, {1, 0}, {0, 1}}).value()}, .values = {std::string("cup")}});
  return table;
}

std::uint32_t big_endian_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    number = number << 8U | static_cast<std::uint8_t>(bytes[i]);
  }
  return number;
}

TEST(GeoPackage, TheHeadSaysWhatTheFileIs) {
  const std::vector<GeoPackageTable> tables{table_named("semantic")};
  const auto bytes = write_geopackage(tables);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  EXPECT_THAT(*bytes, StartsWith("SQLite format 3"));
  EXPECT_EQ(bytes->size() % 4096, 0U);
  EXPECT_EQ(bytes->substr(68, 4), "GPKG");  // application_id
  EXPECT_EQ(big_endian_at(*bytes, 60), 10300U) << "user_version";
  EXPECT_EQ(big_endian_at(*bytes, 56), 1U) << "UTF-8";
}

TEST(GeoPackage, TheSameTablesGiveTheSameBytes) {
  std::vector<GeoPackageTable> tables{table_named("a"), table_named("b")};
  for (int i = 0; i < 500; ++i) tables[1].features.push_back(tables[1].features.front());
  const auto bytes = write_geopackage(tables);
  EXPECT_EQ(bytes.value(), write_geopackage(tables).value());
  tables[1].features.back().values = {std::string("mug")};
  EXPECT_NE(bytes.value(), write_geopackage(tables).value());
}

TEST(GeoPackage, ItMayHaveNoTables) {
  EXPECT_TRUE(write_geopackage({}));
}

TEST(GeoPackage, NamesThatSqlWouldTakeForOthersAreRefused) {
  const auto refused = [](const std::vector<GeoPackageTable>& tables) {
    const auto bytes = write_geopackage(tables);
    return bytes ? std::string("written") : to_string(bytes.error());
  };
  EXPECT_THAT(refused({table_named("gpkg_contents")}), HasSubstr("as names of the standard do"));
  EXPECT_THAT(refused({table_named("SQLITE_master")}), HasSubstr("as names of the standard do"));
  EXPECT_THAT(refused({table_named("")}), HasSubstr("must be text in UTF-8"));
  EXPECT_THAT(refused({table_named("\xFF")}), HasSubstr("must be text in UTF-8"));
  EXPECT_THAT(refused({table_named(std::string("a\0b", 3))}), HasSubstr("must be without NUL"));
  EXPECT_THAT(refused({table_named("Lab"), table_named("lab")}),
              HasSubstr("must be another one than those before, is \"lab\""));
  GeoPackageTable table = table_named("a");
  table.columns.front().name = "GEOM";
  EXPECT_THAT(refused({table}), HasSubstr("must be another one"));
  EXPECT_EQ(refused({table_named("drop table \"x\"; --"),
                     table_named("k\xC3\xBC"
                                 "che\n")}),
            "written");
}

}  // namespace
}  // namespace hypermap
