// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/supercell_export.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace hypermap {
namespace {

using testing::ElementsAre;

/// Two cells of a chair below, one of nothing known above the left, one that is no chair.
struct SmallWorld {
  GridStack stack;
  Supercells supercells;
  TopometricGraph graph;
};

SmallWorld small_world(const std::string& layer = "/ism/chair") {
  const GridGeometry geometry{.resolution_m = 0.5, .cols = 2, .rows = 2};
  GridStack stack = GridStack::create(geometry).value();
  const auto grid = LogOddsGrid::create(geometry, {1000, 2000, 0, -500}).value();
  (void)stack.fuse({.layer = layer, .grid = grid}, Eigen::Matrix3d(Eigen::Matrix3d::Identity()))
      .value();
  const Supercells supercells{.geometry = geometry, .labels = {0, 0, 1, 2}, .count = 3};
  return {stack, supercells, topometric_graph(stack, supercells).value()};
}

TEST(TopometricDot, AHandWorkedGraph) {
  // Centroids (0.5, 0.25), (0.25, 0.75), (0.75, 0.75); lengths sqrt(0.3125) and 0.5, on average
  // 0.539: 54 points in the mean are 100.1 a metre.
  EXPECT_EQ(topometric_dot(small_world().graph),
            "graph topometric {\n"
            "  inputscale=72;\n"
            "  points_per_m=100;\n"
            "  node [shape=box, style=filled, fillcolor=white, fontsize=8, width=0, height=0, "
            "margin=\"0.03,0.02\"];\n"
            "  0 [label=\"0 chair\", pos=\"50,25!\", centroid_m=\"0.5,0.25\"];\n"
            "  1 [label=\"1\", pos=\"25,75!\", centroid_m=\"0.25,0.75\"];\n"
            "  2 [label=\"2\", pos=\"75,75!\", centroid_m=\"0.75,0.75\"];\n"
            "  0 -- 1 [length_m=0.5590169943749475];\n"
            "  0 -- 2 [length_m=0.5590169943749475];\n"
            "  1 -- 2 [length_m=0.5];\n"
            "}\n");
}

TEST(TopometricDot, NamesStayWithinTheirQuotes) {
  const std::string text = topometric_dot(small_world("/ism/a\"]; b\\\n").graph);
  EXPECT_THAT(text, testing::HasSubstr(R"(label="0 a\"]; b)"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("b\\\n")));
}

TEST(TopometricGeojson, HasPointsThenLines) {
  const auto document = nlohmann::json::parse(topometric_geojson(small_world().graph));
  EXPECT_EQ(document["type"], "FeatureCollection");
  EXPECT_EQ(document["frame_id"], "map");
  const auto& features = document["features"];
  ASSERT_EQ(features.size(), 6U);
  EXPECT_EQ(features[0]["geometry"]["type"], "Point");
  EXPECT_EQ(features[0]["geometry"]["coordinates"], nlohmann::json({0.5, 0.25}));
  const auto& properties = features[0]["properties"];
  EXPECT_EQ(properties["cells"], 2);
  EXPECT_EQ(properties["best_layer"], "/ism/chair");
  EXPECT_EQ(properties["neighbours"], nlohmann::json({1, 2}));
  // [sogm] Eq. (11): 1 + 2, the mean 1.5, its probability 0.817 57.
  EXPECT_EQ(properties["layers"]["/ism/chair"]["log_odds"], 3.0);
  EXPECT_EQ(properties["layers"]["/ism/chair"]["mean"], 1.5);
  EXPECT_NEAR(properties["layers"]["/ism/chair"]["probability"], 0.81757, 1e-5);
  EXPECT_TRUE(features[2]["properties"]["best_layer"].is_null());
  EXPECT_EQ(features[5]["geometry"]["type"], "LineString");
  EXPECT_EQ(features[5]["properties"]["length_m"], 0.5);
}

TEST(SupercellImage, ShowsClassesOutlinesAndWhatIsNotKnown) {
  const SmallWorld world = small_world();
  ClassPalette palette;
  ASSERT_TRUE(palette.set("chair", {250, 100, 50}));
  const ColorImage image = supercell_image(world.supercells, world.graph, palette);
  ASSERT_EQ(image.width_px(), 512);  // 256 pixels a cell
  ASSERT_EQ(image.height_px(), 512);
  EXPECT_EQ(image.at(100, 400), (Rgb8{250, 100, 50}));  // row 0 is below
  EXPECT_EQ(image.at(300, 400), (Rgb8{250, 100, 50}));
  EXPECT_EQ(image.at(256, 400), (Rgb8{250, 100, 50}));  // no outline within a supercell
  EXPECT_EQ(image.at(100, 100), (Rgb8{150, 150, 150}));
  EXPECT_EQ(image.at(300, 100), (Rgb8{235, 235, 235}));
  EXPECT_EQ(image.at(256, 100), (Rgb8{141, 141, 141}));  // 3/5 of it
  EXPECT_EQ(image.at(100, 256), (Rgb8{150, 60, 30}));
}

TEST(WriteSupercells, LeavesThreeFiles) {
  const test::TempDir dir;
  const SmallWorld world = small_world();
  const auto written = write_supercells(world.supercells, world.graph, dir / "cells").value();
  EXPECT_THAT(written,
              ElementsAre(dir / "cells" / "supercells.png",
                          dir / "cells" / "topometric.dot",
                          dir / "cells" / "topometric.local.geojson"));
  const std::string png = read_file(written[0], 1U << 24U).value();
  EXPECT_EQ(png, encode_png(supercell_image(world.supercells, world.graph)).value());
  EXPECT_EQ(read_file(written[1], 1U << 20U).value(), topometric_dot(world.graph));
  EXPECT_EQ(read_file(written[2], 1U << 20U).value(), topometric_geojson(world.graph));
  const auto failed = write_supercells(world.supercells, world.graph, written[1]);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
