// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/octree_layer.hpp"

#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

namespace hypermap {
namespace {

std::string string_of(const LeafSample& leaf, const ClassRegistry& classes) {
  if (!leaf.occupied) return "Free";
  const bool named = leaf.best_class && classes.contains(*leaf.best_class);
  return named ? classes.name(*leaf.best_class) : "Occupied";
}

LayerAnswer answer_of(const LeafSample& leaf, std::uint64_t id, const ClassRegistry& classes) {
  const double probability = leaf.occupancy.probability().value();
  return {.id = id,
          .name = string_of(leaf, classes),
          .value = std::lround(100.0 * probability),
          .position = leaf.centre_in_map.head<2>(),
          .z_m = leaf.centre_in_map.z(),
          .size_m = Eigen::Vector3d::Constant(leaf.edge_m)};
}

/// Counted in leaves of this size as keys are, so that neighbours never share a point nor leave one
/// out.
bool is_same_step(double point_m, double centre_m, double edge_m) {
  const double per_m = 1.0 / edge_m;
  return std::floor(point_m * per_m) == std::floor(centre_m * per_m);
}

bool holds(const LeafSample& leaf, const PlanPoint& point) {
  const Eigen::Vector3d& centre = leaf.centre_in_map;
  return is_same_step(point.xy.x(), centre.x(), leaf.edge_m) &&
         is_same_step(point.xy.y(), centre.y(), leaf.edge_m) &&
         (!point.z || is_same_step(*point.z, centre.z(), leaf.edge_m));
}

/// Which leaves share area with a polygon; each column is tested once.
class AreaTest {
 public:
  explicit AreaTest(const Polygon& area) : area_(area), bounds_(bounds(area)) {}

  bool operator()(const LeafSample& leaf) {
    const Eigen::Vector2d low = leaf.centre_in_map.head<2>().array() - 0.5 * leaf.edge_m;
    const bool near = (low.array() <= bounds_.max.array()).all() &&
                      (low.array() + leaf.edge_m >= bounds_.min.array()).all();
    if (!near) return false;
    const auto [known, is_new] = columns_.try_emplace({low.x(), low.y(), leaf.edge_m}, false);
    if (is_new) {
      const GridGeometry square{.resolution_m = leaf.edge_m, .origin = low, .cols = 1, .rows = 1};
      for_each_covered_cell(
          square, area_, [&found = known->second](Cell, double) { found = true; });
    }
    return known->second;
  }

 private:
  const Polygon& area_;
  Rect bounds_;
  std::map<std::tuple<double, double, double>, bool> columns_;
};

}  // namespace

std::string_view OctreeLayer::class_name() const {
  return kOctomapFormat;
}

LayerStatistics OctreeLayer::statistics() const {
  LeafCount count;
  LeafCount voxels;
  Eigen::AlignedBox3d box;
  sources_.leaves([&](const LeafSample& leaf) {
    ++(leaf.occupied ? count.occupied : count.free);
    const auto edge = static_cast<std::size_t>(std::lround(leaf.edge_m / sources_.resolution_m));
    (leaf.occupied ? voxels.occupied : voxels.free) += edge * edge * edge;
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * leaf.edge_m);
    box.extend(leaf.centre_in_map - half);
    box.extend(leaf.centre_in_map + half);
  });
  LayerStatistics statistics{.leaves = count, .voxels = voxels};
  if (!box.isEmpty()) statistics.bounds = box;
  return statistics;
}

Result<std::vector<LayerAnswer>> OctreeLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  std::optional<AreaTest> in_area;
  if (query.area) in_area.emplace(*query.area);
  std::uint64_t id = 0;
  sources_.leaves([&](const LeafSample& leaf) {
    const std::uint64_t leaf_id = id++;
    if (query.at && !holds(leaf, *query.at)) return;
    if (in_area && !(*in_area)(leaf)) return;
    LayerAnswer answer = answer_of(leaf, leaf_id, sources_.classes);
    if (has_representation(answer, query)) answers.push_back(std::move(answer));
  });
  return answers;
}

std::vector<LayerPrimitive> OctreeLayer::draw() const {
  return {DrawnVoxels{sources_.leaves}};
}

Result<void> OctreeLayer::save(LayerWriter& writer) const {
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, sources_.file());
  return writer.bytes("", std::move(bytes));
}

bool OctreeLayer::equals(const MapLayer& other) const {
  const auto* octree = dynamic_cast<const OctreeLayer*>(&other);
  if (octree == nullptr) return false;
  const auto here = sources_.file();
  const auto there = octree->sources_.file();
  return here && there && *here == *there;
}

}  // namespace hypermap
