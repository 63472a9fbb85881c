// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/true_surfaces_json.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/transformed_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

const SourceName kSurfacesSource{.file = "a.hmap", .entry = "true_surfaces.jsonl"};

TrueSurfaces two_surfaces() {
  return {.seen_cell_m = 0.025,
          .objects = {{.id = ObjectId{2},
                       .class_name = "a \"chair\"",
                       .vertices = {{0.1F, -0.0F, 1e-20F}, {1, 0, 1.0F / 3.0F}, {0, 1, 0}},
                       .triangles = {{0, 1, 2}, {2, 1, 0}},
                       .seen_cells = {{-3, 0, 7}, {-3, 1, 0}}},
                      {.id = ObjectId{9}, .class_name = "bin", .is_nameable = false}}};
}

std::string surfaces_refusal(const std::string& text) {
  const auto parsed = parse_true_surfaces(text, kSurfacesSource);
  return parsed ? "none" : to_string(parsed.error());
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = write_true_surfaces(two_surfaces()).value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(TrueSurfacesJson, WhatIsReadEqualsWhatWasWritten) {
  const std::string text = write_true_surfaces(two_surfaces()).value();
  const auto parsed = parse_true_surfaces(text, kSurfacesSource);
  ASSERT_TRUE(parsed) << to_string(parsed.error());
  EXPECT_EQ(*parsed, two_surfaces());
  EXPECT_EQ(write_true_surfaces(*parsed).value(), text);
  const std::string none = write_true_surfaces({}).value();
  EXPECT_EQ(parse_true_surfaces(none, kSurfacesSource).value(), TrueSurfaces{});
}

TEST(TrueSurfacesJson, EveryCutIsRefused) {
  const std::string text = write_true_surfaces(two_surfaces()).value();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(parse_true_surfaces(text.substr(0, size), kSurfacesSource)) << size;
  EXPECT_THAT(surfaces_refusal(text + "{}\n"), HasSubstr("says 2 objects, there are more"));
}

TEST(TrueSurfacesJson, WhatASurfaceCannotHaveIsRefusedWithItsLine) {
  EXPECT_THAT(surfaces_refusal(with("\"version\":1", "\"version\":2")),
              HasSubstr("newer version 2"));
  EXPECT_THAT(surfaces_refusal(with("true-surfaces", "objects")),
              HasSubstr("expected hypermap-true"));
  EXPECT_THAT(surfaces_refusal(with("\"seen_cell_m\":0.025", "\"seen_cell_m\":0")),
              HasSubstr("seen_cell_m"));
  EXPECT_THAT(surfaces_refusal(with("\"num_objects\":2", "\"num_objects\":1000001")),
              HasSubstr("limit"));
  EXPECT_THAT(surfaces_refusal(with("\"id\":9", "\"id\":2")), HasSubstr("object 2 id"));
  EXPECT_THAT(surfaces_refusal(with("\"bin\"", "\"\"")), HasSubstr("object 9 class"));
  EXPECT_THAT(surfaces_refusal(with("[0,1,2,2", "[0,1,3,2")), HasSubstr("object 2 triangles"));
  EXPECT_THAT(surfaces_refusal(with("[0,1,2,2", "[0,1,-1,2")), HasSubstr("triangles"));
  EXPECT_THAT(surfaces_refusal(with("[-3,0,7,", "[-3,0,7,7,")), HasSubstr("multiple of three"));
  EXPECT_THAT(surfaces_refusal(with("[-3,0,7,", "[-3,1,0,")), HasSubstr("object 2 seen_cells"));
  EXPECT_THAT(surfaces_refusal(with("[-3,0,7,", "[-3,0,3000000000,")), HasSubstr("seen_cells"));
  EXPECT_THAT(surfaces_refusal(with("\"nameable\":false", "\"nameable\":0")),
              HasSubstr("nameable"));
  EXPECT_THAT(surfaces_refusal(with("\"nameable\":false", "\"nam\":false")), HasSubstr("nam"));
  EXPECT_THAT(surfaces_refusal(with("[0.1,", "[1e39,")), HasSubstr("vertices"));
  EXPECT_THAT(surfaces_refusal(with("[0.1,", "[2000000,")), HasSubstr("object 2 vertices"));
  EXPECT_THAT(surfaces_refusal(with("\"a \\\"chair\\\"\"", "7")), HasSubstr(":2:"));
}

TEST(TrueSurfacesJson, WhatWouldBeRefusedIsNotWritten) {
  TrueSurfaces surfaces = two_surfaces();
  surfaces.objects[1].id = ObjectId{1};
  EXPECT_EQ(write_true_surfaces(surfaces).error().field, "object 1 id");
}

TEST(TrueSurfacesJson, AnArchiveKeepsThem) {
  MapArchive archive;
  archive.true_surfaces = two_surfaces();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, {.file = "truth.hmap"});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->findings.empty());
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_FALSE(loaded->value == MapArchive{});
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
}

TEST(TrueSurfacesJson, TheyMoveWithTheMap) {
  MapArchive archive;
  archive.true_surfaces = two_surfaces();
  const Eigen::Isometry3d shift(Eigen::Translation3d(0.05, 0, 0.025));  // two cells, one cell
  const MapArchive moved = transformed(archive, MapFromOldMap(shift)).value();
  EXPECT_EQ(moved.true_surfaces->objects[0].seen_cells,
            (std::vector<SurfaceCell>{{-1, 0, 8}, {-1, 1, 1}}));
  EXPECT_NEAR(moved.true_surfaces->objects[0].vertices[0].x(), 0.15, 1e-6);
}

}  // namespace
}  // namespace hypermap
