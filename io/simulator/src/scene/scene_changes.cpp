// SPDX-License-Identifier: BSD-3-Clause
#include "scene_changes.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kChangeStream = 0x6368616e6765;  // which numbers: "change"
constexpr std::uint64_t kPlaceStream = 0x706c616365;     // "place"
constexpr double kLeastMoveM = 0.6;
constexpr double kFarthestFromWayM = 3.0;  // beyond it the camera may never see it
constexpr double kClearanceM = 0.1;
constexpr double kWayClearanceM = 0.3;
constexpr int kMaxTries = 2000;

enum class Fate : std::uint8_t { kStays, kMoved, kRemoved, kAdded };

/// Finds what can change, and free places.
class Chooser {
 public:
  Chooser(const Scene& scene,
          const FurnishedScene& furnished,
          std::span<const Eigen::Vector3d> camera_way,
          std::uint64_t seed)
      : scene_(scene), furnished_(furnished), camera_way_(camera_way), seed_(seed) {
    for (const PlacedObject& object : furnished.objects) taken_.push_back(object.box);
    for (const SceneFixture& fixture : scene.fixtures) taken_.push_back(fixture.box);
  }

  /// Positions of the things that may change, in an order that the seed says.
  [[nodiscard]] std::vector<std::size_t> candidates(
      const std::function<bool(std::string_view)>& can_change) const {
    std::vector<std::pair<double, std::size_t>> drawn;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const SceneObject& object = scene_.objects[i];
      if (!object.movable || !can_change(object.class_name) || bears_others(object)) continue;
      drawn.emplace_back(CounterRng(seed_, kChangeStream, i).uniform(), i);
    }
    std::ranges::sort(drawn);
    std::vector<std::size_t> order;
    order.reserve(drawn.size());
    for (const auto& [number, position] : drawn) order.push_back(position);
    return order;
  }

  /// The thing somewhere else; none when it does not stand on the floor or no place was found.
  [[nodiscard]] std::optional<PlacedObject> moved(std::size_t index) {
    const SceneObject& object = scene_.objects[index];
    if (!object.on.empty() || !object.beside.empty() || object.height_m != 0.0) return std::nullopt;
    const PlacedObject& old = furnished_.objects[index];
    const Rect rect = bounds(scene_.floor);
    CounterRng random(seed_, kPlaceStream, index);
    for (int i = 0; i < kMaxTries; ++i) {
      const double x = random.uniform(rect.min.x(), rect.max.x());
      const double y = random.uniform(rect.min.y(), rect.max.y());
      const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
      auto placed = put(old, {x, y}, turn);
      if (!placed || !is_free(*placed, old)) continue;
      taken_.push_back(placed->box);
      return placed;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool bears_others(const SceneObject& object) const {
    return std::ranges::any_of(scene_.objects, [&](const SceneObject& other) {
      return other.on == object.name || other.beside == object.name;
    });
  }

  /// The thing with its middle at `place`, turned by `turn_rad` from how it stood.
  static std::optional<PlacedObject> put(const PlacedObject& old,
                                         const Vector2d& place,
                                         double turn_rad) {
    Eigen::Isometry3d there = old.map_from_object;
    there.linear() = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) * there.linear();
    there.translation().head<2>() = place;
    PlacedObject placed = old;
    placed.mesh = transformed(old.mesh, there * old.map_from_object.inverse());
    placed.map_from_object = there;
    placed.box = bounds(placed.mesh);
    auto outline = footprint(placed.mesh);
    if (!outline) return std::nullopt;
    placed.footprint = *std::move(outline);
    placed.centroid_in_map << centroid(placed.footprint), placed.box.centre().z();
    return placed;
  }

  [[nodiscard]] double distance_to_way_m(const Box& box) const {
    double nearest = kUnreachable;
    for (const Eigen::Vector3d& eye : camera_way_) {
      const Vector2d at = eye.head<2>();
      const Vector2d on_box =
          at.cwiseMax(box.min_in_map.head<2>()).cwiseMin(box.max_in_map.head<2>());
      nearest = std::min(nearest, (at - on_box).norm());
    }
    return nearest;
  }

  [[nodiscard]] bool is_free(const PlacedObject& placed, const PlacedObject& old) const {
    if ((placed.map_from_object.translation() - old.map_from_object.translation()).norm() <
        kLeastMoveM)
      return false;
    const double way_m = distance_to_way_m(placed.box);
    if (way_m < kWayClearanceM || way_m > kFarthestFromWayM) return false;
    const Box around = grown(placed.box, kClearanceM);
    for (const double x : {around.min_in_map.x(), around.max_in_map.x()}) {
      for (const double y : {around.min_in_map.y(), around.max_in_map.y()}) {
        if (!contains(scene_.floor, {x, y})) return false;
      }
    }
    const auto holds_corner = [&](const Vector2d& point) {
      return around.contains({point.x(), point.y(), around.centre().z()});
    };
    if (std::ranges::any_of(scene_.floor.outer, holds_corner)) return false;
    for (const Ring& hole : scene_.floor.holes) {
      if (std::ranges::any_of(hole, holds_corner)) return false;
    }
    return std::ranges::none_of(taken_, [&](const Box& box) { return box.intersects(around); });
  }

  static constexpr double kUnreachable = 1e9;
  const Scene& scene_;
  const FurnishedScene& furnished_;
  std::span<const Eigen::Vector3d> camera_way_;
  std::uint64_t seed_;
  std::vector<Box> taken_;  ///< Of before and after.
};

Unexpected too_few(std::string_view name, int wanted, int found) {
  return fail(ErrorCode::kInvalidArgument,
              "must be at most " + std::to_string(found) +
                  ", what this scene can give at this seed, is " + std::to_string(wanted),
              "changes." + std::string(name));
}

/// Fate of each thing, and where the moved ones go.
struct Plan {
  std::vector<Fate> fates;
  std::vector<std::optional<PlacedObject>> moved;
};

/// Gives `count` of the candidates, from the front, a fate, and takes them off the list.
Result<void> assign(
    Plan& plan, std::vector<std::size_t>& candidates, Fate fate, int count, std::string_view name) {
  const int found = static_cast<int>(candidates.size());
  if (count > found) return too_few(name, count, found);
  for (int i = 0; i < count; ++i) plan.fates[candidates[static_cast<std::size_t>(i)]] = fate;
  candidates.erase(candidates.begin(), candidates.begin() + count);
  return {};
}

Result<Plan> make_plan(Chooser& chooser,
                       std::size_t num_objects,
                       std::vector<std::size_t> candidates,
                       const SceneChangeOptions& options) {
  Plan plan{std::vector<Fate>(num_objects, Fate::kStays),
            std::vector<std::optional<PlacedObject>>(num_objects)};
  int num_moved = 0;
  for (const std::size_t index : candidates) {
    if (num_moved == options.num_moved) break;
    plan.moved[index] = chooser.moved(index);
    if (!plan.moved[index]) continue;
    plan.fates[index] = Fate::kMoved;
    ++num_moved;
  }
  if (num_moved < options.num_moved) return too_few("num_moved", options.num_moved, num_moved);
  std::erase_if(candidates, [&](std::size_t i) { return plan.fates[i] != Fate::kStays; });
  HYPERMAP_TRY(assign(plan, candidates, Fate::kRemoved, options.num_removed, "num_removed"));
  HYPERMAP_TRY(assign(plan, candidates, Fate::kAdded, options.num_added, "num_added"));
  return plan;
}

PlacedObject without_surface(PlacedObject object) {
  object.mesh = {};
  return object;
}

ObjectId id_after(const std::vector<PlacedObject>& objects) {
  return ObjectId{static_cast<std::uint32_t>(objects.size() + 1)};
}

}  // namespace

Result<ChangedScene> change_scene(const Scene& scene,
                                  FurnishedScene furnished,
                                  std::span<const Eigen::Vector3d> camera_way_in_map,
                                  const SceneChangeOptions& options,
                                  std::uint64_t seed,
                                  const std::function<bool(std::string_view)>& can_change) {
  if (options.total() == 0) return ChangedScene{furnished, furnished, furnished, {}};
  Chooser chooser(scene, furnished, camera_way_in_map, seed);
  HYPERMAP_ASSIGN_OR_RETURN(
      Plan plan,
      make_plan(chooser, furnished.objects.size(), chooser.candidates(can_change), options));
  ChangedScene result;
  result.at_end.room = furnished.room;
  result.at_end.lights_in_map = furnished.lights_in_map;
  std::vector<PlacedObject> before;
  for (std::size_t i = 0; i < furnished.objects.size(); ++i) {
    PlacedObject& old = furnished.objects[i];
    const Fate fate = plan.fates[i];
    if (fate == Fate::kRemoved) {
      result.changes.push_back({SceneChange::Kind::kRemoved, std::move(old), kNoObject});
      continue;
    }
    PlacedObject now = fate == Fate::kMoved ? *std::move(plan.moved[i]) : old;
    now.id = id_after(before);
    before.push_back(fate == Fate::kStays ? now : without_surface(now));
    if (fate == Fate::kMoved)
      result.changes.push_back({SceneChange::Kind::kMoved, std::move(old), now.id});
    if (fate == Fate::kAdded) result.changes.push_back({SceneChange::Kind::kAdded, now, now.id});
    result.at_end.objects.push_back(std::move(now));
  }
  result.first_passes = result.at_end;
  result.first_passes.objects = std::move(before);
  result.last_pass = result.at_end;
  for (SceneChange& change : result.changes) {
    if (change.kind == SceneChange::Kind::kAdded) continue;
    change.object.id = id_after(result.first_passes.objects);
    result.first_passes.objects.push_back(change.object);
    result.last_pass.objects.push_back(without_surface(change.object));
  }
  return result;
}

}  // namespace hypermap
