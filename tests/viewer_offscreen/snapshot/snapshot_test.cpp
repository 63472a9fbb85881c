// SPDX-License-Identifier: BSD-3-Clause
// Long because: the parts of an image share one fixture and its scenes.
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kTolerance = 3;  // of 255; drivers round differently

class Snapshot : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto context = EglContext::create(); !context)
      GTEST_SKIP() << to_string(context.error());
  }
};

bool near(Rgb8 a, Rgb8 b, int tolerance = kTolerance) {
  return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance &&
         std::abs(a.b - b.b) <= tolerance;
}

MATCHER_P(ColorNear, expected, "") {
  *result_listener << int{arg.r} << " " << int{arg.g} << " " << int{arg.b} << " instead of "
                   << int{expected.r} << " " << int{expected.g} << " " << int{expected.b};
  return near(arg, expected);
}

LeafSample cube(const Eigen::Vector3d& centre, double edge_m, std::optional<ClassId> class_id) {
  LeafSample leaf;
  leaf.centre_in_map = centre;
  leaf.edge_m = edge_m;
  leaf.occupied = true;
  leaf.best_class = class_id;
  return leaf;
}

LeafSource source_of(std::vector<LeafSample> leaves) {
  return [leaves = std::move(leaves)](const LeafVisitor& visit) {
    for (const LeafSample& leaf : leaves) visit(leaf);
  };
}

/// One cube of 1 m around the origin, of class 0.
SnapshotScene one_cube() {
  SnapshotScene scene;
  const ClassId id = scene.classes.add("thing").value();
  scene.leaves = source_of({cube({0, 0, 0}, 1.0, id)});
  return scene;
}

SnapshotOptions bare_top() {
  return {.view = TopView{}, .width_px = 300, .height_px = 200, .annotations = false};
}

int count_near(const ColorImage& image, Rgb8 color, int first_u, int last_u) {
  int count = 0;
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = first_u; u < last_u; ++u) count += near(image.at(u, v), color) ? 1 : 0;
  }
  return count;
}

// Unannotated the cube of 1 m fills the height: 200 px, from u = 50 to 250. Its upper face has the
// full colour of its class: shade 1.00 upwards, nothing around it.
TEST_F(Snapshot, ACubeFromAboveHasItsClassColorAndSize) {
  const auto image = render_snapshot(one_cube(), bare_top());
  ASSERT_TRUE(image);
  const Rgb8 color = class_color("thing");
  EXPECT_THAT(image->at(150, 100), ColorNear(color));
  EXPECT_THAT(image->at(60, 10), ColorNear(color));
  int width_px = 0;
  for (int u = 0; u < 300; ++u) width_px += near(image->at(u, 80), color) ? 1 : 0;
  EXPECT_NEAR(width_px, 200, 2);  // the outermost pixel is the seam
  EXPECT_FALSE(near(image->at(20, 100), color, 40));
}

// From the south the face seen has shade 0.92.
TEST_F(Snapshot, SidesAreDarkerThanTheTop) {
  SnapshotOptions options = bare_top();
  options.view = IsoView{.azimuth_deg = -90.0, .elevation_deg = 45.0};
  const auto image = render_snapshot(one_cube(), options);
  ASSERT_TRUE(image);
  const Rgb8 color = class_color("thing");
  const auto shade = [](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(0.92 * c));
  };
  EXPECT_THAT(image->at(150, 50), ColorNear(color));
  EXPECT_THAT(image->at(150, 150), ColorNear(Rgb8{shade(color.r), shade(color.g), shade(color.b)}));
}

TEST_F(Snapshot, TheSameSceneGivesTheSameImage) {
  const auto a = render_snapshot(one_cube());
  const auto b = render_snapshot(one_cube());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a, *b);
}

TEST_F(Snapshot, ImagesHaveTheSizeAskedForAtAnySupersampling) {
  for (const int supersampling : {1, 2, 3}) {
    SnapshotOptions options = bare_top();
    options.supersampling = supersampling;
    const auto image = render_snapshot(one_cube(), options);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width_px(), 300);
    EXPECT_EQ(image->height_px(), 200);
    EXPECT_THAT(image->at(150, 100), ColorNear(class_color("thing")));
  }
}

// The cube is as high as the content area; the bar's length in pixels over the cube's width in
// pixels must be the round number of metres that is written beside it.
TEST_F(Snapshot, TheScaleBarIsTrueToScale) {
  SnapshotOptions options{.view = TopView{}};
  const auto image = render_snapshot(one_cube(), options);
  ASSERT_TRUE(image);
  const Rgb8 color = class_color("thing");
  int cube_px = 0;
  for (int u = 0; u < 1280; ++u) cube_px += near(image->at(u, 300), color) ? 1 : 0;
  ASSERT_GT(cube_px, 100);
  int longest_px = 0;
  for (int v = 640; v < 720; ++v) {
    int run_px = 0;
    for (int u = 0; u < 400; ++u) {
      run_px = near(image->at(u, v), {33, 38, 45}, 12) ? run_px + 1 : 0;
      longest_px = std::max(longest_px, run_px);
    }
  }
  const double length_m = round_length_m(180.0 / cube_px);
  EXPECT_NEAR(longest_px, length_m * cube_px, 4.0);
}

// Between the margins of 22 px there are 676 px; a square of that fits between scale bar and
// legend.
TEST_F(Snapshot, TheMapFillsTheImageBesideWhatIsWritten) {
  const auto image = render_snapshot(one_cube(), {.view = TopView{}});
  ASSERT_TRUE(image);
  const Rgb8 color = class_color("thing");
  int height_px = 0;
  for (int v = 0; v < 720; ++v) height_px += near(image->at(600, v), color) ? 1 : 0;
  EXPECT_GT(height_px, 640);
}

TEST_F(Snapshot, AUsersPaletteHoldsForVoxelsBoxesAndLegend) {
  SnapshotScene scene = one_cube();
  ASSERT_TRUE(scene.palette.set("Thing", {250, 0, 250}));
  EXPECT_THAT(render_snapshot(scene, bare_top())->at(150, 100), ColorNear(Rgb8{250, 0, 250}));
  EXPECT_GT(count_near(*render_snapshot(scene), {250, 0, 250}, 1000, 1280), 60);
}

// The same class has another id here.
TEST_F(Snapshot, AColorFollowsTheNameOfTheClassNotItsId) {
  SnapshotScene scene;
  ASSERT_TRUE(scene.classes.add("other"));
  const ClassId id = scene.classes.add("thing").value();
  scene.leaves = source_of({cube({0, 0, 0}, 1.0, id)});
  EXPECT_EQ(*render_snapshot(scene, bare_top()), *render_snapshot(one_cube(), bare_top()));
}

TEST_F(Snapshot, TentativeObjectsAreSaid) {
  SnapshotScene scene = one_cube();
  const auto without = render_snapshot(scene);
  scene.num_tentative = 3;
  const auto with = render_snapshot(scene);
  ASSERT_TRUE(with && without);
  EXPECT_FALSE(*with == *without);
}

TEST_F(Snapshot, TheLegendShowsTheColorOfTheClass) {
  SnapshotScene scene = one_cube();
  const auto image = render_snapshot(scene);
  ASSERT_TRUE(image);
  EXPECT_GT(count_near(*image, class_color("thing"), 1000, 1280), 60);
}

TEST_F(Snapshot, UnlabelledVoxelsAreNeitherColoredNorInvisible) {
  SnapshotScene scene;
  scene.leaves = source_of({cube({0, 0, 0}, 1.0, std::nullopt)});
  const auto image = render_snapshot(scene, bare_top());
  ASSERT_TRUE(image);
  const Rgb8 pixel = image->at(150, 100);
  const auto [low, high] = std::minmax({pixel.r, pixel.g, pixel.b});
  EXPECT_LT(high - low, 40);
  EXPECT_LT(pixel.b, 230);
}

TEST_F(Snapshot, FreeVoxelsAreNotDrawn) {
  SnapshotScene scene = one_cube();
  LeafSample free = cube({1, 0, 0}, 1.0, ClassId{0});
  free.occupied = false;
  scene.leaves = source_of({cube({0, 0, 0}, 1.0, ClassId{0}), free});
  EXPECT_EQ(*render_snapshot(scene, bare_top()), *render_snapshot(one_cube(), bare_top()));
}

TEST_F(Snapshot, TheCeilingIsCutFromAboveUnlessAskedFor) {
  SnapshotScene scene;
  const ClassId floor = scene.classes.add("floor").value();
  const ClassId ceiling = scene.classes.add("ceiling").value();
  std::vector<LeafSample> leaves;
  for (int y = -4; y < 4; ++y) {
    for (int x = -6; x < 6; ++x) {
      leaves.push_back(cube({x + 0.5, y + 0.5, 0.5}, 1.0, floor));
      leaves.push_back(cube({x + 0.5, y + 0.5, 3.5}, 1.0, ceiling));
    }
  }
  scene.leaves = source_of(leaves);
  SnapshotOptions options = bare_top();
  EXPECT_THAT(render_snapshot(scene, options)->at(137, 112), ColorNear(class_color("floor")));
  options.cut_above_m = std::numeric_limits<double>::infinity();
  EXPECT_THAT(render_snapshot(scene, options)->at(137, 112), ColorNear(class_color("ceiling")));
}

// The camera stands 2 m before the cube's face and looks along +x of the map.
TEST_F(Snapshot, APoseSeesWhatIsBeforeIt) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = -Eigen::Vector3d::UnitY();
  pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
  pose.linear().col(2) = Eigen::Vector3d::UnitX();
  pose.translation() = Eigen::Vector3d(-2.5, 0, 0);
  SnapshotOptions options = bare_top();
  options.view = PoseView{.map_from_camera = MapFromCamera(pose)};
  const auto seen = render_snapshot(one_cube(), options);
  ASSERT_TRUE(seen);
  const Rgb8 middle = seen->at(150, 100);
  EXPECT_GT(middle.b, middle.r + 40);  // 0 165 195 is more blue than red
  pose.translation() = Eigen::Vector3d(2.5, 0, 0);
  options.view = PoseView{.map_from_camera = MapFromCamera(pose)};
  const auto behind = render_snapshot(one_cube(), options);
  ASSERT_TRUE(behind);
  EXPECT_LT(behind->at(150, 100).b - behind->at(150, 100).r, 20);
}

// A grid of 3 x 2 cells of 1 m fills 300 x 200 px: a cell is 100 px. Row 0 is in the south, below.
TEST_F(Snapshot, TheOccupancyGridLiesNorthUp) {
  SnapshotScene scene;
  GridGeometry geometry;
  geometry.resolution_m = 1.0;
  geometry.cols = 3;
  geometry.rows = 2;
  scene.occupancy = OccupancyGrid::create(geometry, {100, 0, -1, 0, 0, 100}).value();
  const auto image = render_snapshot(scene, bare_top());
  ASSERT_TRUE(image);
  const auto light = [&](int u, int v) { return int{image->at(u, v).g}; };
  EXPECT_LT(light(60, 140), 80);         // (0, 0) occupied
  EXPECT_GT(light(160, 140), 245);       // (1, 0) free
  EXPECT_NEAR(light(260, 140), 219, 8);  // (2, 0) unknown
  EXPECT_LT(light(260, 40), 80);         // (2, 1) occupied
}

// Cells are opaque; by default they are drawn where they hide no occupancy grid.
TEST_F(Snapshot, CellsHideTheOccupancyGridOnlyWhenAskedFor) {
  const GridGeometry geometry{.resolution_m = 1.0, .cols = 3, .rows = 2};
  const Rgb8 pink{230, 120, 180};
  SnapshotScene scene;
  scene.overlay.cells.push_back({.geometry = geometry, .colors = std::vector<Rgb8>(6, pink)});
  const auto is_pink_at_first_cell = [&](const SnapshotOptions& options) {
    const auto image = render_snapshot(scene, options);
    return image && near(image->at(60, 140), pink, 40);
  };
  EXPECT_TRUE(is_pink_at_first_cell(bare_top()));
  scene.occupancy = OccupancyGrid::create(geometry, {100, 0, -1, 0, 0, 100}).value();
  EXPECT_FALSE(is_pink_at_first_cell(bare_top()));
  SnapshotOptions with_overlay = bare_top();
  with_overlay.layers = SnapshotLayers{.occupancy = true, .overlay = true};
  EXPECT_TRUE(is_pink_at_first_cell(with_overlay));
}

// 2 x 2 m in 200 x 200 px around the middle of the image, with a hole of 1 x 1 m.
TEST_F(Snapshot, PolygonsAreFilledButForTheirHoles) {
  SnapshotScene scene;
  SemanticObject object{.id = 1, .name = "carpet", .parts = {}};
  object.parts.push_back(
      {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}}}});
  scene.semantic.push_back(object);
  const auto image = render_snapshot(scene, bare_top());
  ASSERT_TRUE(image);
  const Rgb8 ring = image->at(75, 80);
  EXPECT_GT(ring.g, ring.b + 60);                                 // 80 105 0 under light
  EXPECT_THAT(image->at(170, 83), ColorNear(image->at(20, 83)));  // the hole shows the ground
}

TEST_F(Snapshot, ObjectBoxesAreOutlined) {
  SnapshotScene scene;
  const ClassId id = scene.classes.add("crate").value();
  scene.objects.push_back({{{0, 0, 0}, {2, 2, 2}}, id, "Kiste ä"});
  const auto image = render_snapshot(scene, bare_top());
  ASSERT_TRUE(image);
  EXPECT_GT(count_near(*image, class_color("crate"), 45, 55), 100);  // the left side
  EXPECT_FALSE(near(image->at(160, 90), class_color("crate"), 40));  // the inside is free
}

TEST_F(Snapshot, EmptyAndUnusualScenesAreDrawn) {
  EXPECT_TRUE(render_snapshot({}));
  SnapshotScene odd = one_cube();
  odd.title = std::string("a\x01 \xff title ", 11) + std::string(500, 'x');
  odd.objects.push_back({{{1, 1, 1}, {1, 1, 1}}, ClassId{999}, "Tür – 门 ☃"});
  odd.trajectory_in_map = {{0, 0, 0}, {1, 1, 1}, {2, 0, 1}};
  for (const SnapshotView& view :
       {SnapshotView(IsoView{}), SnapshotView(TopView{}), SnapshotView(PoseView{})}) {
    EXPECT_TRUE(render_snapshot(odd, {.view = view}));
    EXPECT_TRUE(render_snapshot(odd, {.view = view, .width_px = 64, .height_px = 64}));
  }
}

TEST_F(Snapshot, AFontThatIsNoneIsNamed) {
  const auto image = render_snapshot({}, {.font_file = "/nonexistent/font.ttf"});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(image.error().what, testing::HasSubstr("/nonexistent/font.ttf"));
}

}  // namespace
}  // namespace hypermap
