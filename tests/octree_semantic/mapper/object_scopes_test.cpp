// SPDX-License-Identifier: BSD-3-Clause
// Which objects of the map the policies of [smap] compare a frame with.
#include "mapper/object_scopes.hpp"

#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// A camera at the origin, 1 m high, that looks along x.
RgbdFrame frame_at_start() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 101, .height_px = 61, .fx_px = 50, .fy_px = 30, .cx_px = 50, .cy_px = 30};
  frame.map_from_camera = test::camera_at({0, 0, 1}, 0.0, 0.0);
  frame.depth_m = DepthImage(101, 61, 1.0F);
  return frame;
}

/// Preset smap, but for a camera that reaches over all vertices.
ObjectPipelineOptions far_sighted_smap() {
  ObjectPipelineOptions options = preset(PresetName::kSmap);
  options.segmentation.max_range_m = 20.0;
  return options;
}

/// 7 m straight on: a vertex each 0.95 m from the origin on, 0 to 7.
TopologicalMap corridor() {
  TopologicalMap places;
  for (int i = 0; i <= 70; ++i) places.observe({0.1 * i, 0, 1});
  return places;
}

// [smap] 3.5.4 and 3.5.5, step 1 of figures 3.22 and 3.23.
TEST(ScopesOfSmap, AreThreeAndFiveEdgesAroundTheSensorsVertex) {
  const TopologicalMap places = corridor();
  ASSERT_EQ(places.vertices().size(), 8U);
  const ObjectPipelineOptions options = far_sighted_smap();
  const ObjectScope candidates = scope_of_candidates(frame_at_start(), places, options);
  const ObjectScope absences = scope_of_absences(frame_at_start(), places, options);
  for (int i = 1; i < 8; ++i) {
    const Eigen::Vector3d at_vertex(0.95 * i, 0.2, 1);
    EXPECT_EQ(candidates.contains(at_vertex), i <= 3) << i;
    EXPECT_EQ(absences.contains(at_vertex), i <= 5) << i;
  }
  // Vertices 3 and 4 are at 2.85 and 3.8 m: between them the middle decides, not the distance.
  EXPECT_TRUE(candidates.contains({3.32, 0, 1}));
  EXPECT_FALSE(candidates.contains({3.33, 0, 1}));
  EXPECT_FALSE(candidates.contains({-0.5, 0, 1})) << "behind the camera";
}

TEST(ScopesOfSmap, CountFromTheVertexThatIsNearestToTheSensor) {
  // The sensor came to vertex 7 last; the frame is of a camera that is back at vertex 0.
  const TopologicalMap places = corridor();
  ASSERT_EQ(places.walk()->at, VertexId{7});
  const ObjectScope scope = scope_of_candidates(frame_at_start(), places, far_sighted_smap());
  EXPECT_TRUE(scope.contains({0.95, 0, 1}));
  EXPECT_FALSE(scope.contains({0.95 * 5, 0, 1}));
}

TEST(ScopesOfSmap, EdgesCountAndNotTheWayThroughAWall) {
  // Along one side of a wall and back along the other: what stands 1.5 m ahead is 7 edges away.
  TopologicalMap places;
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0, 0, 1),
                                    Eigen::Vector3d(0, 3, 1),
                                    Eigen::Vector3d(1.5, 3, 1),
                                    Eigen::Vector3d(1.5, 0, 1)}) {
    places.observe(at);
  }
  const ObjectPipelineOptions options = far_sighted_smap();
  const Eigen::Vector3d ahead(1.5, 0, 1);
  EXPECT_FALSE(scope_of_candidates(frame_at_start(), places, options).contains(ahead));
  EXPECT_FALSE(scope_of_absences(frame_at_start(), places, options).contains(ahead));
}

TEST(ScopesOfSmap, AreLimitedByTheConeAloneWithoutLayersOrVertices) {
  ObjectPipelineOptions options = far_sighted_smap();
  const TopologicalMap nowhere;
  const Eigen::Vector3d far(19, 0, 1);
  const Eigen::Vector3d behind(-1, 0, 1);
  EXPECT_TRUE(scope_of_candidates(frame_at_start(), nowhere, options).contains(far));
  EXPECT_FALSE(scope_of_candidates(frame_at_start(), nowhere, options).contains(behind));
  const TopologicalMap places = corridor();
  options.association.graph_layers.reset();
  options.absence.graph_layers.reset();
  EXPECT_TRUE(scope_of_candidates(frame_at_start(), places, options).contains(far));
  EXPECT_TRUE(scope_of_absences(frame_at_start(), places, options).contains(far));
  EXPECT_FALSE(scope_of_absences(frame_at_start(), places, options).contains(behind));
}

TEST(ScopesOfOtherPolicies, AreTheWholeMap) {
  const TopologicalMap places = corridor();
  const ObjectPipelineOptions options;
  EXPECT_TRUE(scope_of_candidates(frame_at_start(), places, options).contains({-50, 0, 1}));
  EXPECT_TRUE(scope_of_absences(frame_at_start(), places, options).contains({-50, 0, 1}));
}

/// Objects that a second look from the same place makes anew, on a topological map so fine that
/// objects are at vertices of their own.
std::size_t num_made_anew_with(std::optional<int> layers) {
  SemanticMapperOptions options{.objects = preset(PresetName::kSmap),
                                .places = {.vertex_distance_m = 0.2}};
  options.objects.association.graph_layers = layers;
  SemanticMapper mapper = SemanticMapper::create(options).value();
  std::size_t num_made_anew = 0;
  for (const RgbdFrame& frame : test::detected_room_frames(12, 160)) {
    EXPECT_TRUE(mapper.integrate(frame));
    const auto again = mapper.integrate(frame);
    EXPECT_TRUE(again);
    if (again) num_made_anew += again->num_created;
  }
  return num_made_anew;
}

TEST(ScopesOfSmap, AreWhatTheMapperAsks) {
  EXPECT_EQ(num_made_anew_with(std::nullopt), 0U);
  EXPECT_EQ(num_made_anew_with(1000000), 0U);
  EXPECT_GT(num_made_anew_with(0), 0U) << "no object is at the sensor's vertex";
}

}  // namespace
}  // namespace hypermap
