// SPDX-License-Identifier: BSD-3-Clause
// Positive observations of preset smap against the text, step by step.
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "hypermap/core/places/object_vertices.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "support/camera_pose.hpp"
#include "support/object_builders.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;

/// [smap] pseudocode 3.4.
struct PrintedVertex {
  Eigen::Vector3d position;
  bool is_support = false;
  std::set<std::size_t> joined = {};
  std::vector<Object> objects = {};
};

/// How often each end of the flowchart was reached.
struct PrintedCounts {
  int created = 0;
  int updated = 0;
  int combined = 0;
  int moved = 0;
  int beyond_layers = 0;  ///< Candidates, but for step 1.
};

/// [smap] figure 3.22 over lists of vertices and their objects. What one update or one combination
/// does to an object is no part of the figure: that is `update_object` and `merged`.
class PrintedMap {
 public:
  /// 3.5.1 is tested elsewhere: vertices and edges are those of the topological map.
  void take_vertices(const TopologicalMap& map) {
    for (std::size_t i = vertices_.size(); i < map.vertices().size(); ++i)
      vertices_.push_back({.position = map.vertices()[i].position_in_map,
                           .is_support = map.vertices()[i].kind == VertexKind::kSupport});
    for (const auto& [from, to] : map.edges()) {
      vertices_[from.value].joined.insert(to.value);
      vertices_[to.value].joined.insert(from.value);
    }
    move_objects();
  }

  void observe(const Observation& seen, const RgbdFrame& frame) {
    const Eigen::Vector3d robot = frame.map_from_camera.origin().xyz;
    const std::set<std::size_t> near = layers_around(closest_vertex(robot), 3);  // 1
    const auto best = candidate(seen.segment.centroid_in_map, label(seen), near, frame, 0);
    if (!best) {  // C.0.1, 3
      Object made = make_object(seen, options_);
      made.id = ObjectId{++last_id_};
      vertices_[closest_vertex(made.centroid_in_map)].objects.push_back(std::move(made));
      ++counts.created;
      return;
    }
    Object& updated = find(*best);
    update_object(updated, seen, options_);  // 4
    ++counts.updated;
    const auto label_now = label(updated);
    if (const auto other =
            candidate(updated.centroid_in_map, label_now, near, frame, updated.id.value)) {  // 5
      const ObjectId older = std::min(updated.id, *other);
      const ObjectId younger = std::max(updated.id, *other);
      find(older) = merged(find(older), find(younger), options_.max_existence);
      for (PrintedVertex& vertex : vertices_) {
        std::erase_if(vertex.objects,
                      [younger](const Object& object) { return object.id == younger; });
      }
      ++counts.combined;
    }
    move_objects();  // 6
  }

  [[nodiscard]] std::vector<Object> all_objects() const {
    std::vector<Object> all;
    for (const PrintedVertex& vertex : vertices_)
      all.insert(all.end(), vertex.objects.begin(), vertex.objects.end());
    std::ranges::sort(all, {}, &Object::id);
    return all;
  }

  PrintedCounts counts;

 private:
  static ClassId label(const Observation& seen) {
    return std::ranges::max_element(seen.class_scores, {}, &ClassEvidence::probability)->id;
  }
  static ClassId label(const Object& object) {
    ClassId best{0};
    for (std::uint32_t id = 1; id < testing_support::kNumClasses; ++id) {
      if (object.belief.log_odds({id}) > object.belief.log_odds(best)) best = {id};
    }
    return best;
  }

  /// Steps 1, 3.1 and 6. 3.5.1 makes support vertices for what is farther than 2 V_d from any
  /// vertex; the map has more of them, which do not count.
  [[nodiscard]] std::size_t closest_vertex(const Eigen::Vector3d& position) const {
    std::size_t closest = 0;
    double closest_m = 1e9;
    for (const bool also_support : {false, true}) {
      for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const double away_m = (vertices_[i].position - position).norm();
        if ((vertices_[i].is_support && !also_support) || away_m >= closest_m) continue;
        closest = i;
        closest_m = away_m;
      }
      if (closest_m < 2.0) break;  // V_d = 1 m
    }
    return closest;
  }

  /// Step 1: the vertex and, one layer after the other, all that are joined to those so far.
  [[nodiscard]] std::set<std::size_t> layers_around(std::size_t vertex, int num_layers) const {
    std::set<std::size_t> found{vertex};
    for (int layer = 0; layer < num_layers; ++layer) {
      const std::set<std::size_t> before = found;
      for (const std::size_t i : before)
        found.insert(vertices_[i].joined.begin(), vertices_[i].joined.end());
    }
    return found;
  }

  /// C.2.2 with R_min and R_max of table D.1, a cone through the corners of the image.
  static bool is_in_cone(const Eigen::Vector3d& position, const RgbdFrame& frame) {
    const Eigen::Vector4d seen =
        frame.map_from_camera.isometry().matrix().inverse() * position.homogeneous();
    const double tangent = std::hypot(frame.camera.cx_px / frame.camera.fx_px,
                                      frame.camera.cy_px / frame.camera.fy_px);
    return seen.z() >= 0.2 && seen.z() <= 1.7 &&
           std::hypot(seen.x(), seen.y()) <= tangent * seen.z();
  }

  /// Step 2, and the closest of what it leaves.
  std::optional<ObjectId> candidate(const Eigen::Vector3d& position,
                                    ClassId label_sought,
                                    const std::set<std::size_t>& near,
                                    const RgbdFrame& frame,
                                    std::uint32_t except) {
    std::optional<ObjectId> closest;
    double closest_m = 0.2 * 0.5;  // o_e, o_t of table D.2
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      for (const Object& object : vertices_[i].objects) {
        if (object.id.value == except) continue;
        if (label(object) != label_sought) continue;               // C.2.1
        if (!is_in_cone(object.centroid_in_map, frame)) continue;  // C.2.2
        const double away_m = (object.centroid_in_map - position).norm();
        if (!(away_m < closest_m)) continue;  // C.2.3
        if (!near.contains(i)) {
          ++counts.beyond_layers;
          continue;
        }
        closest = object.id;
        closest_m = away_m;
      }
    }
    return closest;
  }

  Object& find(ObjectId id) {
    for (PrintedVertex& vertex : vertices_) {
      for (Object& object : vertex.objects) {
        if (object.id == id) return object;
      }
    }
    ADD_FAILURE() << "no object " << id.value;
    std::abort();
  }

  /// Step 6. Deviation: to the closest vertex, not only where condition 2 is broken.
  void move_objects() {
    std::vector<Object> all = all_objects();
    for (PrintedVertex& vertex : vertices_) {
      for (const Object& object : vertex.objects)
        counts.moved += &vertex != &vertices_[closest_vertex(object.centroid_in_map)] ? 1 : 0;
      vertex.objects.clear();
    }
    for (Object& object : all)
      vertices_[closest_vertex(object.centroid_in_map)].objects.push_back(std::move(object));
  }

  std::vector<PrintedVertex> vertices_;
  std::uint32_t last_id_ = 0;
  AssociationOptions options_ = preset(PresetName::kSmap).association;
};

/// What stands in the way of the robot, some of it beside each other.
struct SimulatedObject {
  Box box;
  ClassId label;
};

std::vector<SimulatedObject> true_objects(CounterRng& random) {
  std::vector<SimulatedObject> truth;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Eigen::Vector3d at(random.uniform(-1, 7), random.uniform(-2, 2), random.uniform(0, 1.6));
    const double size_m = random.uniform(0.1, 0.5);
    truth.push_back({box_at(at, Eigen::Vector3d::Constant(size_m)), {i % 3}});
  }
  return truth;
}

/// What a camera that turns round shows of things around it: each a few centimetres off, and now
/// and then of another class.
std::vector<Observation> seen_of(const std::vector<SimulatedObject>& truth,
                                 const RgbdFrame& frame,
                                 CounterRng& random) {
  const Eigen::Vector3d camera = frame.map_from_camera.origin().xyz;
  std::vector<Observation> all;
  for (const auto& [box, label] : truth) {
    if ((box.centre() - camera).norm() > 1.8 || random.chance(0.3)) continue;
    const Eigen::Vector3d off(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3f low = (box.min_in_map + 0.04 * off).cast<float>();
    const Eigen::Vector3f high = (box.max_in_map + 0.04 * off).cast<float>();
    const ClassId named = random.chance(0.1) ? ClassId{(label.value + 1) % 3} : label;
    all.push_back(observed({low, high}, scores(named, 0.8), frame.index, camera));
  }
  return all;
}

RgbdFrame frame_of_walk(std::uint64_t index, CounterRng& random) {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 96, .height_px = 64, .fx_px = 60, .fy_px = 60, .cx_px = 47.5, .cy_px = 31.5};
  // There, round the end of the things, and back on the other side.
  const double along_m = 0.15 * static_cast<double>(index % 80);
  const Eigen::Vector3d at(along_m < 6 ? along_m : 12 - along_m, along_m < 6 ? -1.5 : 1.5, 1.0);
  frame.map_from_camera = test::camera_at(at, random.uniform(-3.1, 3.1), random.uniform(-0.6, 0.3));
  frame.depth_m = DepthImage(96, 64, 1.0F);
  frame.index = index;
  return frame;
}

// [smap] figure 3.22, steps 1 to 6, with tables D.1 and D.2.
TEST(PositiveObservationsOfSmap, AreTheFlowchartOverRandomWalks) {
  PrintedCounts counts;
  const AssociationOptions options = preset(PresetName::kSmap).association;
  for (std::uint64_t trial = 0; trial < test::repetitions(8U); ++trial) {
    CounterRng random(322, trial);
    const std::vector<SimulatedObject> truth = true_objects(random);
    TopologicalMap places;
    PrintedMap printed;
    ObjectMap objects;
    for (std::uint64_t index = 0; index < 160; ++index) {
      const RgbdFrame frame = frame_of_walk(index, random);
      const Eigen::Vector3d robot = frame.map_from_camera.origin().xyz;
      places.observe(robot);
      printed.take_vertices(places);
      const std::vector<Observation> seen = seen_of(truth, frame, random);
      for (const Observation& one : seen) printed.observe(one, frame);
      const VertexNeighbourhood near(places, robot, *options.graph_layers);
      const ObjectScope scope{
          .is_near = [&](const Eigen::Vector3d& centroid) { return near.contains(centroid); },
          .cone = active_cone(frame, 0.2, 1.7)};
      (void)associate(objects, seen, options, scope);
      const std::vector<Object> expected = printed.all_objects();
      ASSERT_TRUE(std::ranges::equal(objects.objects(), expected)) << trial << ", frame " << index;
      // C.3.1, 3.2: support vertices, once the frame is in the map.
      for (const Object& object : expected) places.cover(object.centroid_in_map);
    }
    counts.created += printed.counts.created;
    counts.updated += printed.counts.updated;
    counts.combined += printed.counts.combined;
    counts.moved += printed.counts.moved;
    counts.beyond_layers += printed.counts.beyond_layers;
  }
  EXPECT_GT(counts.created, 0);
  EXPECT_GT(counts.updated, 0);
  EXPECT_GT(counts.combined, 0);
  EXPECT_GT(counts.moved, 0);
  EXPECT_GT(counts.beyond_layers, 0) << "candidates that only step 1 leaves out";
}

}  // namespace
}  // namespace hypermap
