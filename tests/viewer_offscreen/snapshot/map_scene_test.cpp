// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

OccupancyLayer grid_of(int cols) {
  GridGeometry geometry;
  geometry.cols = cols;
  geometry.rows = 1;
  const std::vector<std::int8_t> cells(static_cast<std::size_t>(cols), 0);
  return OccupancyLayer(OccupancyGrid::create(geometry, cells).value());
}

SemanticLayer shape_of(const std::string& name) {
  const Polygon square = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).value();
  return SemanticLayer::create({{.id = 1, .name = name, .parts = {square}}}).value();
}

TEST(MapScene, TheFirstLayerOfEachKindIsDrawn) {
  Hypermap hypermap;
  for (Layer layer : {Layer{{.name = "empty"}, SemanticLayer()},
                      Layer{{.name = "shapes"}, shape_of("sink")},
                      Layer{{.name = "more shapes"}, shape_of("cup")},
                      Layer{{.name = "grid"}, grid_of(2)},
                      Layer{{.name = "other grid", .frame_id = "lab"}, grid_of(3)}}) {
    ASSERT_TRUE(hypermap.add_layer(std::move(layer)));
  }
  const SnapshotScene scene = map_scene(hypermap, {}, {}, {});
  ASSERT_EQ(scene.semantic.size(), 1U);
  EXPECT_EQ(scene.semantic.front().name, "sink");
  ASSERT_TRUE(scene.occupancy);
  EXPECT_EQ(scene.occupancy->geometry().cols, 2);
  EXPECT_EQ(scene.frame_id, "map");
  EXPECT_EQ(scene.left_out.size(), 1U) << "nothing connects lab and map";
  EXPECT_TRUE(scene.objects.empty());
  EXPECT_FALSE(scene.leaves);
}

TEST(MapScene, LayersAreShownInTheFrameThatIsGiven) {
  Hypermap hypermap;
  ASSERT_TRUE(hypermap.add_layer({{.name = "grid", .frame_id = "lab"}, grid_of(3)}));
  const SnapshotScene scene = map_scene(hypermap, {}, {}, {}, "lab");
  EXPECT_EQ(scene.frame_id, "lab");
  EXPECT_TRUE(scene.occupancy);
  EXPECT_TRUE(scene.left_out.empty());
}

TEST(MapScene, ObjectsBearTheNameOfTheirBestClassAndTheirId) {
  ClassRegistry classes;
  const ClassId sofa = classes.add("couch").value();
  Object known;
  known.belief.observe(std::array{ClassEvidence{sofa, Probability(0.9)}}, Probability(0.5));
  known.id = ObjectId{12};
  known.box.max_in_map = {2, 1, 1};
  const Object unknown;
  const std::array<const Object*, 2> objects{&known, &unknown};
  const SnapshotScene scene = map_scene({}, classes, objects, {});
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].label, "couch 12");
  EXPECT_EQ(scene.objects[0].class_id, sofa);
  EXPECT_EQ(scene.objects[0].box, known.box);
  EXPECT_EQ(scene.objects[1].label, "unknown 0");
  EXPECT_EQ(scene.objects[1].class_id, std::nullopt);
  EXPECT_EQ(scene.classes, classes);
}

TEST(MapScene, LeavesAreHandedOn) {
  const LeafSource one = [](const LeafVisitor& visit) { visit(LeafSample{}); };
  const SnapshotScene scene = map_scene({}, {}, {}, one);
  std::size_t num_leaves = 0;
  scene.leaves([&](const LeafSample&) { ++num_leaves; });
  EXPECT_EQ(num_leaves, 1U);
}

}  // namespace
}  // namespace hypermap
