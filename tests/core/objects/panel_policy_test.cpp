// SPDX-License-Identifier: BSD-3-Clause
// Negative observations of preset smap against the text, step by step.
// Long because: the flowchart is transcribed in one piece, as the text has it.
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "support/box_scene.hpp"
#include "support/object_builders.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;

constexpr int kColumns = 24;  // [smap] table D.2
constexpr int kRows = 16;

/// A panel as [smap] 3.4 has it: the two extreme points of a region of the cloud.
struct PrintedPanel {
  bool is_valid = false;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-1e9);
  [[nodiscard]] Eigen::Vector3d middle() const { return (low + high) / 2.0; }
};
using PrintedPanels = std::array<std::array<PrintedPanel, kColumns>, kRows>;

PrintedPanels printed_panels(const RgbdFrame& frame) {
  PrintedPanels panels;
  for (int v = 0; v < frame.camera.height_px; ++v) {
    for (int u = 0; u < frame.camera.width_px; ++u) {
      const auto depth = static_cast<double>(frame.depth_m.at(u, v));
      if (!(depth >= 0.2 && depth <= 5.0)) continue;
      const Eigen::Vector3d point =
          (frame.map_from_camera * frame.camera.unproject(u, v, depth)).xyz;
      PrintedPanel& panel = panels[static_cast<std::size_t>(v * kRows / frame.camera.height_px)]
                                  [static_cast<std::size_t>(u * kColumns / frame.camera.width_px)];
      panel.is_valid = true;
      panel.low = panel.low.cwiseMin(point);
      panel.high = panel.high.cwiseMax(point);
    }
  }
  return panels;
}

/// [smap] Eq. (3.22), in the interval that atan2 has.
double printed_g(double difference) {
  return std::atan2(std::sin(difference), std::cos(difference));
}

/// What [smap] figure 3.23 comes to for one object, and the numbers of C.2.
struct PrintedResult {
  bool is_evaluated = false;
  int before = 0;
  int inside = 0;
  int after = 0;
  Visibility state = Visibility::kOutOfView;
};

/// As the flowchart has it, in one piece. NOLINTNEXTLINE(readability-function-cognitive-complexity)
PrintedResult printed_result(const RgbdFrame& frame, const Object& object) {
  PrintedResult result;
  const Eigen::Matrix4d pose = frame.map_from_camera.isometry().matrix();
  const double x_camera = pose(0, 3);
  const double y_camera = pose(1, 3);
  const double z_camera = pose(2, 3);
  const double theta_camera = std::atan2(pose(1, 2), pose(0, 2));
  const PrintedPanels panels = printed_panels(frame);

  // C.1: inside the active cone, R_min = 0.2, R_max = 1.7 of table D.1.
  const Eigen::Vector4d seen = pose.inverse() * object.centroid_in_map.homogeneous();
  const double tangent =
      std::hypot(frame.camera.cx_px / frame.camera.fx_px, frame.camera.cy_px / frame.camera.fy_px);
  if (seen.z() < 0.2 || seen.z() > 1.7) return result;
  if (std::hypot(seen.x(), seen.y()) / seen.z() > tangent) return result;

  // Steps 3 and 5: eight corners, and for each the panel of the closest angular position.
  int first_column = kColumns;
  int last_column = -1;
  int first_row = kRows;
  int last_row = -1;
  double nearest_corner_m = 1e9;
  double farthest_corner_m = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) != 0 ? object.box.max_in_map.x() : object.box.min_in_map.x();
    const double y = (i & 2) != 0 ? object.box.max_in_map.y() : object.box.min_in_map.y();
    const double z = (i & 4) != 0 ? object.box.max_in_map.z() : object.box.min_in_map.z();
    const double phi_cc = printed_g(std::atan2(y_camera - y, x_camera - x) - theta_camera);  // 3.25
    const double up_cc = std::atan2(z_camera - z, std::hypot(x_camera - x, y_camera - y));
    double best = 1e9;
    int match_column = -1;
    int match_row = -1;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const PrintedPanel& panel =
            panels[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        if (!panel.is_valid) continue;
        const Eigen::Vector3d p = panel.middle();
        const double phi_cp =
            printed_g(std::atan2(y_camera - p.y(), x_camera - p.x()) - theta_camera);  // 3.24
        const double up_cp =
            std::atan2(z_camera - p.z(), std::hypot(x_camera - p.x(), y_camera - p.y()));
        const double phi_diff = printed_g(phi_cc - phi_cp);  // 3.23
        const double apart = std::hypot(phi_diff, up_cc - up_cp);
        if (apart < best) {
          best = apart;
          match_column = column;
          match_row = row;
        }
      }
    }
    if (match_column < 0) return result;
    first_column = std::min(first_column, match_column);
    last_column = std::max(last_column, match_column);
    first_row = std::min(first_row, match_row);
    last_row = std::max(last_row, match_row);
    farthest_corner_m =
        std::max(farthest_corner_m, std::hypot(x - x_camera, y - y_camera, z - z_camera));
  }
  const auto gap = [](double low, double high, double at) {
    return at < low ? low - at : (at > high ? at - high : 0.0);
  };
  nearest_corner_m =
      std::hypot(gap(object.box.min_in_map.x(), object.box.max_in_map.x(), x_camera),
                 gap(object.box.min_in_map.y(), object.box.max_in_map.y(), y_camera),
                 gap(object.box.min_in_map.z(), object.box.max_in_map.z(), z_camera));

  // Step 6: p_be, p_in, p_af, with the tolerance of figure 3.24.
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const PrintedPanel& panel =
          panels[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      if (!panel.is_valid) continue;
      const Eigen::Vector3d p = panel.middle();
      const double away = std::hypot(p.x() - x_camera, p.y() - y_camera, p.z() - z_camera);
      if (away < nearest_corner_m - 0.1) {
        ++result.before;
      } else if (away <= farthest_corner_m + 0.1) {
        ++result.inside;
      } else {
        ++result.after;
      }
    }
  }

  // C.2, with the shares of ours.
  const double all = result.before + result.inside + result.after;
  result.is_evaluated = true;
  if (result.after > 0.5 * all) {
    result.state = Visibility::kAbsent;
  } else if (result.before > 0.5 * all) {
    result.state = Visibility::kOccluded;
  } else {
    result.state = result.before > 0 ? Visibility::kPartlyOccluded : Visibility::kVisible;
  }
  return result;
}

/// A room with a back wall and a few boxes in it, seen by a robot's camera from anywhere.
RgbdFrame random_view(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  test::BoxScene scene(
      {.width_px = 96, .height_px = 64, .fx_px = 80, .fy_px = 80, .cx_px = 47.5, .cy_px = 31.5});
  const double wall_m = between(1.5, 6.0);
  scene.add(1, {-7, wall_m, -1}, {7, wall_m + 0.1, 3})
      .add(1, {-7, -wall_m - 0.1, -1}, {7, -wall_m, 3});
  scene.add(1, {wall_m, -7, -1}, {wall_m + 0.1, 7, 3})
      .add(1, {-wall_m - 0.1, -7, -1}, {-wall_m, 7, 3});
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d low(between(-1.5, 1.5), between(-1.5, 1.5), between(0, 1));
    scene.add(2, low, low + Eigen::Vector3d(between(0.1, 0.6), between(0.1, 0.6), between(0.1, 1)));
  }
  const auto pose = test::camera_at({between(-0.5, 0.5), between(-0.5, 0.5), between(0.3, 1.2)},
                                    between(-3.1, 3.1),
                                    between(-0.5, 0.3));
  return scene.view(pose).frame;
}

/// Objects all around, most of them near enough to be in some view.
ObjectMap random_objects(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  ObjectMap objects;
  for (int i = 0; i < 12; ++i) {
    const Box box = box_at({between(-1.8, 1.8), between(-1.8, 1.8), between(0.0, 1.5)},
                           {between(0.05, 0.8), between(0.05, 0.8), between(0.05, 0.8)});
    const Eigen::Vector3d from(between(-2, 2), between(-2, 2), 1.0);
    const ClassId id{static_cast<std::uint32_t>(i % 3)};
    const std::vector corners{Eigen::Vector3f(box.min_in_map.cast<float>()),
                              Eigen::Vector3f(box.max_in_map.cast<float>())};
    Object object = make_object(observed(corners, scores(id, between(0.2, 0.9)), 0, from),
                                preset(PresetName::kSmap).association);
    objects.add(std::move(object));
  }
  return objects;
}

std::vector<VisibilityResult> results_of(const ObjectMap& objects, const RgbdFrame& frame) {
  const ObjectPipelineOptions options = preset(PresetName::kSmap);
  const ObjectScope scope{
      .cone =
          active_cone(frame, options.segmentation.min_range_m, *options.segmentation.max_range_m)};
  return evaluate_visibility_by_panels(
      objects, BinnedDepthMap::create(frame, options.binned_depth), options.absence, scope);
}

// [smap] figure 3.23, steps 1 to C.2, Eq. (3.22), (3.23), (3.24), (3.25), figure 3.24.
TEST(PanelPolicyOfSmap, IsTheFlowchartOverRandomViews) {
  std::mt19937 random(2323);
  std::map<Visibility, int> seen_states;
  for (int trial = 0; trial < 120; ++trial) {
    const RgbdFrame frame = random_view(random);
    const ObjectMap objects = random_objects(random);
    const auto results = results_of(objects, frame);
    std::size_t num_evaluated = 0;
    for (const Object& object : objects.objects()) {
      const PrintedResult expected = printed_result(frame, object);
      const auto found = std::find_if(results.begin(), results.end(), [&](const auto& result) {
        return result.object == object.id;
      });
      ASSERT_EQ(found != results.end(), expected.is_evaluated)
          << trial << ", object " << object.id.value;
      if (!expected.is_evaluated) continue;
      ++num_evaluated;
      const double all = expected.before + expected.inside + expected.after;
      EXPECT_EQ(found->state, expected.state) << trial << ", object " << object.id.value;
      EXPECT_DOUBLE_EQ(found->visible_fraction, expected.inside / all);
      EXPECT_DOUBLE_EQ(found->absent_fraction, expected.after / all);
      ++seen_states[found->state];
    }
    EXPECT_EQ(results.size(), num_evaluated);
  }
  EXPECT_EQ(seen_states.size(), 4U) << "all of visible, partly occluded, occluded, absent";
}

/// Steps 8 and C.3 of [smap] figure 3.23 on the bare numbers of an object.
struct PrintedObject {
  std::map<ClassId, double> classes;
  std::array<double, 18> bins{};
  double box_confidence = 0.0;
  bool is_removed = false;

  explicit PrintedObject(const Object& object) : box_confidence(object.box_confidence.value()) {
    for (const auto& entry : object.belief.entries()) classes[entry.id] = entry.log_odds.value();
    for (std::size_t i = 0; i < bins.size(); ++i) bins[i] = object.histogram.bins()[i].value();
  }

  void decay(Visibility state, bool was_seen_from_here, double bearing, double distance) {
    double share = state == Visibility::kAbsent           ? 1.0
                   : state == Visibility::kPartlyOccluded ? 0.5
                   : state == Visibility::kOccluded       ? 0.1
                                                          : 0.0;
    if (!was_seen_from_here) share /= 3.0;  // 3.5.2, figure 3.18
    if (share == 0.0) return;
    for (auto& [id, l] : classes) l = std::clamp(l - 0.5 * share, -10.0, 10.0);
    const double turn = 2.0 * std::numbers::pi;
    const int observed_bin = static_cast<int>(std::floor((bearing / turn + 1.0) * 18.0)) % 18;
    const std::array weights{0.5, 1.5, 6.0, 1.5, 0.5};
    for (int j = -2; j <= 2; ++j) {  // (3.12), (3.13)
      const int around = (observed_bin + j + 18) % 18;
      double& bin = bins[static_cast<std::size_t>(around)];
      const int place = j + 2;
      const double part = weights[static_cast<std::size_t>(place)] / 10.0;
      bin = std::clamp(bin - share * part * 2.0 / (1.0 + distance / 2.0), -10.0, 10.0);
    }
    is_removed = confidence() < 0.5;  // C.3, o_valid
  }

  /// (3.26), (3.27) with table D.2.
  [[nodiscard]] double confidence() const {
    const auto p = [](double l) { return 1.0 - 1.0 / (1.0 + std::exp(l)); };
    double best = -1e9;
    for (const auto& [id, l] : classes) best = std::max(best, l);
    double visible = 0.0;
    double counted = 0.0;
    for (const double bin : bins) {
      visible += p(bin) > 0.7 ? 1.0 : 0.0;
      counted += p(bin) > 0.7 || p(bin) < 0.4 ? 1.0 : 0.0;
    }
    return (4.0 * p(best) + p(box_confidence) + (counted > 0.0 ? visible / counted : 0.0)) / 6.0;
  }
};

void expect_as_printed(const Object& object, const PrintedObject& printed) {
  for (const auto& [id, l] : printed.classes)
    EXPECT_NEAR(object.belief.log_odds(id).value(), l, 1e-9);
  for (std::size_t i = 0; i < 18; ++i)
    EXPECT_NEAR(object.histogram.bins()[i].value(), printed.bins[i], 1e-9);
}

// [smap] figure 3.23, steps 8 and C.3, Eq. (3.26), (3.27), table D.2.
TEST(NegativeObservationsOfSmap, DecayAndRemoveAsTheTablesSay) {
  std::mt19937 random(2324);
  const ObjectPipelineOptions options = preset(PresetName::kSmap);
  std::size_t num_removed = 0;
  for (int trial = 0; trial < test::repetitions(12); ++trial) {
    ObjectMap objects = random_objects(random);
    std::map<ObjectId, PrintedObject> expected;
    std::map<ObjectId, std::set<int>> sides;
    for (const Object& object : objects.objects()) {
      expected.emplace(object.id, PrintedObject(object));
      const auto bearing =
          static_cast<double>(object.observation_log.state().newest.front().bearing_rad);
      const int bin = log_bearing_bin(bearing);
      sides[object.id] = {bin, (bin + 1) % 18, (bin + 17) % 18};
    }
    for (std::uint64_t frame_index = 1; frame_index < 60; ++frame_index) {
      const RgbdFrame frame = random_view(random);
      const Eigen::Vector3d camera = frame.map_from_camera.origin().xyz;
      std::vector<ObjectId> removed;
      for (const Object& object : objects.objects()) {
        const PrintedResult result = printed_result(frame, object);
        if (!result.is_evaluated) continue;
        const Eigen::Vector3d way = camera - object.centroid_in_map;
        const double bearing = std::atan2(way.y(), way.x());
        PrintedObject& printed = expected.at(object.id);
        printed.decay(result.state,
                      sides.at(object.id).contains(log_bearing_bin(bearing)),
                      bearing,
                      way.norm());
        if (printed.is_removed) removed.push_back(object.id);
      }
      const auto report =
          apply_absences(objects, results_of(objects, frame), options.absence, {}, frame_index);
      ASSERT_EQ(report.removed, removed) << trial << ", frame " << frame_index;
      num_removed += removed.size();
      for (const Object& object : objects.objects())
        expect_as_printed(object, expected.at(object.id));
    }
  }
  EXPECT_GT(num_removed, 0U);
}

}  // namespace
}  // namespace hypermap
