// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_layers.hpp"

#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr ClassId kChair{0};
constexpr ClassId kGiraffe{1};

Object chair_at(double x) {
  Object object;
  object.belief.observe(std::array{ClassEvidence{kChair, Probability(0.9)}}, Probability(0.5));
  object.box = {{x, 0.0, 0.0}, {x + 0.4, 0.4, 0.8}};
  return object;
}

StoredLeaf voxel(const SemanticOctree& octree, double x, ObjectId object, ClassId seen_as) {
  VoxelLabel label;
  label.classes[0] = {static_cast<std::uint16_t>(seen_as.value), 2000};
  label.object = object;
  label.object_votes = 1;
  const auto key = octree.grid().key(PointInMap{{x, 0.2, 0.5}});
  return {.key = key.value(), .log_odds = 1000, .label = label};
}

/// A chair whose one voxel was once called a giraffe, and a false alarm on the wall beside it.
MapArchive archive_with_a_false_alarm() {
  MapArchive archive;
  (void)archive.classes.add("chair").value();
  (void)archive.classes.add("giraffe").value();
  const ObjectId chair = archive.objects.add(chair_at(0.0));
  const ObjectId alarm = archive.objects.add(chair_at(2.0));
  archive.octree = SemanticOctree::create({}).value();
  EXPECT_TRUE(archive.octree->set_leaf(voxel(*archive.octree, 0.2, chair, kGiraffe)));
  EXPECT_TRUE(archive.octree->set_leaf(voxel(*archive.octree, 2.2, alarm, kGiraffe)));
  return archive;
}

TEST(ConfirmedLeaves, BearTheClassOfTheObjectThatTheMapStandsFor) {
  const MapArchive archive = archive_with_a_false_alarm();
  const std::array confirmed{ObjectId{1}};
  std::vector<LeafSample> seen;
  confirmed_leaves(archive, confirmed)([&](const LeafSample& leaf) { seen.push_back(leaf); });
  ASSERT_EQ(seen.size(), 2U);
  for (const LeafSample& leaf : seen) {
    const bool of_chair = leaf.centre_in_map.x() < 1.0;
    EXPECT_TRUE(leaf.occupied);
    EXPECT_EQ(leaf.best_class, of_chair ? std::optional(kChair) : std::nullopt);
    EXPECT_EQ(leaf.object, of_chair ? ObjectId{1} : kNoObject);
  }
}

TEST(ConfirmedLeaves, AVoxelBeyondTheObjectIsNotOfIt) {
  // A frame's segment took the floor in; the object, of which all frames tell, ends at x = 0.4.
  MapArchive archive = archive_with_a_false_alarm();
  const std::array confirmed{ObjectId{1}};
  const auto class_at = [&](double x) {
    EXPECT_TRUE(archive.octree->set_leaf(voxel(*archive.octree, x, ObjectId{1}, kChair)));
    std::optional<ClassId> found;
    confirmed_leaves(archive, confirmed)([&](const LeafSample& leaf) {
      if (std::abs(leaf.centre_in_map.x() - x) < 0.5 * leaf.edge_m) found = leaf.best_class;
    });
    return found;
  };
  EXPECT_EQ(class_at(0.44), kChair) << "its middle is at 0.425, and may be at 0.46";
  EXPECT_EQ(class_at(0.49), std::nullopt) << "at 0.475";
  EXPECT_EQ(class_at(1.1), std::nullopt);
}

TEST(ConfirmedLeaves, WithoutObjectsNothingBearsAClass) {
  const MapArchive archive = archive_with_a_false_alarm();
  confirmed_leaves(archive,
                   {})([](const LeafSample& leaf) { EXPECT_EQ(leaf.best_class, std::nullopt); });
}

TEST(ShownLeaves, AreThoseOfTheOctreeElseOfAnotherProgramsElseNone) {
  EXPECT_FALSE(shown_leaves(MapArchive{}));
  MapArchive foreign;
  foreign.octomaps.emplace_back();
  EXPECT_TRUE(shown_leaves(foreign));
  // No layer says otherwise: both objects are shown, and lend their class.
  const MapArchive ours = archive_with_a_false_alarm();
  std::size_t num_chairs = 0;
  shown_leaves(ours)(
      [&](const LeafSample& leaf) { num_chairs += leaf.best_class == kChair ? 1U : 0U; });
  EXPECT_EQ(num_chairs, 2U);
}

// Scans with classes of points alone make no objects.
TEST(ShownLeaves, OfAMapWithoutObjectsBearTheirOwnClasses) {
  MapArchive archive = archive_with_a_false_alarm();
  archive.objects = {};
  std::size_t num_giraffes = 0;
  shown_leaves(archive)(
      [&](const LeafSample& leaf) { num_giraffes += leaf.best_class == kGiraffe ? 1U : 0U; });
  EXPECT_EQ(num_giraffes, 2U);
}

TEST(ShownFrame, IsThatOfWhatIsSolidElseOfTheFirstLayer) {
  MapArchive archive;
  EXPECT_EQ(shown_frame_id(archive), "map");
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "grid", .frame_id = "lab"}, OccupancyLayer()}));
  EXPECT_EQ(shown_frame_id(archive), "lab");
  archive.octomaps.emplace_back().entry.frame_id = "odom";
  EXPECT_EQ(shown_frame_id(archive), "odom");
  archive.octree = SemanticOctree::create({}).value();
  EXPECT_EQ(shown_frame_id(archive), "map");
}

/// Occupied voxels at these places, half a metre above the floor.
MapArchive archive_of(const std::vector<Eigen::Vector2d>& places) {
  MapArchive archive;
  archive.octree = SemanticOctree::create({}).value();
  for (const Eigen::Vector2d& place : places) {
    const auto key = archive.octree->grid().key(PointInMap{{place.x(), place.y(), 0.52}});
    EXPECT_TRUE(archive.octree->set_leaf({.key = key.value(), .log_odds = 1000}));
  }
  return archive;
}

TEST(DerivedLayers, CoverTheLargestRegionAndNameTheOthers) {
  const MapArchive near = archive_of({{0.02, 0.02}, {3.02, 1.02}});
  MapArchive far = archive_of({{0.02, 0.02}, {3.02, 1.02}, {1000.02, 1000.02}});
  const SemanticOctree octree = *far.octree;
  const auto derived = derive_layers(far, {}, {});
  ASSERT_TRUE(derived) << to_string(derived.error());
  EXPECT_TRUE(derived->left_out.empty());
  EXPECT_EQ(derived->main.num_leaves(), 2U);
  ASSERT_EQ(derived->outlying.size(), 1U);
  EXPECT_EQ(derived->outlying[0].leaves, (LeafCount{.occupied = 1, .free = 0}));
  EXPECT_NEAR(derived->outlying[0].bounds_in_map.centre().x(), 1000.0, 0.1);
  EXPECT_EQ(*far.octree, octree);
  MapArchive alone = near;
  ASSERT_TRUE(derive_layers(alone, {}, {}));
  EXPECT_EQ(far.hypermap, alone.hypermap) << "the layers are those without the far voxel";
}

TEST(DerivedLayers, LeaveOutAGridOfTooManyCellsAndSayIt) {
  std::vector<Eigen::Vector2d> chain;
  for (int i = -30; i <= 30; ++i) chain.emplace_back(30.0 * i, 30.0 * i);  // 36,001 cells a side
  MapArchive archive = archive_of(chain);
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy"}, .content = OccupancyLayer(OccupancyGrid())}));
  const auto derived = derive_layers(archive, {}, {});
  ASSERT_TRUE(derived) << to_string(derived.error());
  EXPECT_TRUE(derived->outlying.empty());
  ASSERT_EQ(derived->left_out.size(), 2U);
  EXPECT_EQ(derived->left_out[0].error.entry, "occupancy");
  EXPECT_EQ(derived->left_out[0].error.code, ErrorCode::kLimit);
  EXPECT_NE(to_string(derived->left_out[0].error).find("36001 x 36001 cells"), std::string::npos);
  EXPECT_EQ(derived->left_out[1].error.entry, "class grids");
  EXPECT_EQ(archive.hypermap.find("occupancy"), nullptr) << "it would be that of an older map";
  EXPECT_NE(archive.hypermap.find("semantic"), nullptr);
  EXPECT_EQ(archive.octree->num_leaves().occupied, 61U);
}

TEST(DerivedLayers, OfAnEmptyMapAreEmpty) {
  MapArchive archive = archive_of({});
  const auto derived = derive_layers(archive, {}, {});
  ASSERT_TRUE(derived);
  EXPECT_EQ(derived->main, MapRegion{});
  EXPECT_TRUE(derived->outlying.empty());
}

TEST(DerivedLayers, WithoutAVoxelInTheBandThereIsNoGridAndTheMapCanBeSaved) {
  MapArchive archive = archive_of({{0.02, 0.02}, {3.02, 1.02}});  // 0.52 m high
  const auto derived = derive_layers(archive, {}, {.min_height_m = 50.0, .max_height_m = 60.0});
  ASSERT_TRUE(derived) << to_string(derived.error());
  ASSERT_EQ(derived->left_out.size(), 1U);
  EXPECT_EQ(derived->left_out[0].error.entry, "occupancy");
  EXPECT_NE(to_string(derived->left_out[0].error).find("no voxel lies between"), std::string::npos);
  EXPECT_EQ(archive.hypermap.find("occupancy"), nullptr);
  const auto bytes = write_archive(archive);
  EXPECT_TRUE(bytes) << to_string(bytes.error());
}

// [hypermap] 3.3.5: enable_update.
TEST(DerivedLayers, OneThatTakesNoUpdatesStaysAsItWas) {
  MapArchive archive = archive_of({{0.02, 0.02}, {3.02, 1.02}});
  const OccupancyGrid plan =
      OccupancyGrid::create({.resolution_m = 1, .cols = 2, .rows = 1}, kOccupiedCell).value();
  const auto plan_layer = [&](bool enable_update) {
    return Layer{{.name = "occupancy", .enable_update = enable_update}, OccupancyLayer(plan)};
  };
  MapArchive open = archive;
  ASSERT_TRUE(archive.hypermap.add_layer(plan_layer(false)));
  ASSERT_TRUE(open.hypermap.add_layer(plan_layer(true)));
  const auto derived = derive_layers(archive, {}, {});
  ASSERT_TRUE(derived) << to_string(derived.error());
  EXPECT_EQ(archive.hypermap.find_as<OccupancyLayer>("occupancy")->grid, plan);
  ASSERT_EQ(derived->left_out.size(), 1U);
  EXPECT_EQ(derived->left_out[0].error.entry, "occupancy");
  EXPECT_NE(to_string(derived->left_out[0].error).find("enable_update is false"),
            std::string::npos);
  ASSERT_TRUE(derive_layers(open, {}, {}));
  EXPECT_NE(open.hypermap.find_as<OccupancyLayer>("occupancy")->grid, plan);
  EXPECT_EQ(open.hypermap.find("occupancy")->info.enable_update, true) << "flags stay";
}

TEST(DerivedLayers, AreMarkedAsFedByAMapperAndOlderOnesKeepTheirFlags) {
  MapArchive archive = archive_of({{0.02, 0.02}});
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, SemanticLayer()}));
  ASSERT_TRUE(derive_layers(archive, {}, {.class_stack = true}));
  const auto loaded = parse_archive(write_archive(archive).value(), {.file = "a.hmap"}).value();
  const Hypermap& map = loaded.value.hypermap;
  EXPECT_EQ(map.at("occupancy").value()->info.subscribe_mode, true);
  EXPECT_EQ(map.at("stack").value()->info.subscribe_mode, true);
  EXPECT_EQ(map.at("semantic").value()->info.subscribe_mode, std::nullopt);
}

TEST(DerivedLayers, CarveFootprintsUnlessToldNotTo) {
  MapArchive archive;
  (void)archive.classes.add("chair").value();
  archive.octree = SemanticOctree::create({}).value();
  std::vector<Eigen::Vector3f> corner;  // Of a square of 1 m, two sides.
  for (int i = 0; i < 100; ++i) {
    const float along = 0.01F * static_cast<float>(i) + 0.005F;
    corner.emplace_back(along, 0.005F, 0.5F);
    corner.emplace_back(0.005F, along, 0.5F);
  }
  Object chair = chair_at(0.0);
  chair.points.observe(corner);
  chair.box = *chair.points.agreed_box();
  chair.existence = LogOdds(10.0);
  const ObjectId id = archive.objects.add(chair);
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (const double z : {0.475, 0.525}) {  // What is below was seen, too.
        const PointInMap middle{{0.05 * (i + 0.5), 0.05 * (j + 0.5), z}};
        const auto key = archive.octree->grid().key(middle).value();
        ASSERT_TRUE(archive.octree->set_leaf({.key = key, .log_odds = -1000, .label = {}}));
      }
    }
  }
  ObjectPipelineOptions all;
  all.confirmation.min_observations = 0;
  all.confirmation.min_real_probability = std::nullopt;
  const auto area = [&](const LayerOptions& options) {
    EXPECT_TRUE(derive_layers(archive, all, options));
    const auto* layer = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
    const SemanticObject* shape = layer == nullptr ? nullptr : layer->find(id.value);
    EXPECT_NE(shape, nullptr);
    return shape == nullptr ? 0.0 : area_m2(shape->parts.front());
  };
  EXPECT_LT(area({}), 0.1);
  EXPECT_NEAR(area({.carve_footprints = false}), 0.5, 0.02);
}

TEST(DerivedLayers, KeepAStackOfTheClassesWhereOneIsAskedForOrThere) {
  MapArchive archive;
  (void)archive.classes.add("chair").value();
  (void)archive.classes.add("giraffe").value();
  Object chair = chair_at(0.0);
  chair.existence = LogOdds(3.0);
  const ObjectId id = archive.objects.add(std::move(chair));
  archive.octree = SemanticOctree::create({}).value();
  ASSERT_TRUE(archive.octree->set_leaf(voxel(*archive.octree, 0.2, id, kGiraffe)));
  ObjectPipelineOptions all;
  all.confirmation.min_observations = 0;
  all.confirmation.min_real_probability = std::nullopt;
  const auto stack_after = [&](const LayerOptions& options) {
    EXPECT_TRUE(derive_layers(archive, all, options));
    return archive.hypermap.find_as<GridStackLayer>(kStackLayer);
  };
  EXPECT_EQ(stack_after({}), nullptr);
  const GridStackLayer* layer = stack_after({.class_stack = true});
  ASSERT_NE(layer, nullptr);
  // The voxel is the chair's by its owner; what it was named itself is not asked.
  const GridStack before = layer->stack().value();
  ASSERT_EQ(before.layers().size(), 1U);
  EXPECT_EQ(before.layers().begin()->first, "/ism/chair");
  EXPECT_GT(before.layers().begin()->second.num_known(), 0U);
  // A stack that is there is never that of another map.
  const auto voxel_of_chair = voxel(*archive.octree, 0.3, id, kChair);
  ASSERT_TRUE(archive.octree->set_leaf(voxel_of_chair));
  EXPECT_NE(stack_after({})->stack().value(), before);
}

TEST(LayerOptions, RefuseABandThatIsNone) {
  EXPECT_TRUE(validate(LayerOptions{}));
  EXPECT_FALSE(validate(LayerOptions{.min_height_m = 1.0, .max_height_m = 1.0}));
  EXPECT_FALSE(validate(LayerOptions{.min_free_share = 0.0}));
  EXPECT_FALSE(validate(LayerOptions{.min_height_m = std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace hypermap
