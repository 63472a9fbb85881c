// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/cloud_evaluation.hpp"

#include "hypermap/core/base/job_progress.hpp"
#include "point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hypermap {
namespace {

constexpr double kMaxTrueCoordinateM = 1e6;
constexpr double kCloudCellM = 0.05;
constexpr std::size_t kPointsBetweenStops = 4096;

/// The edge of the finest leaves may be a rounded number: as in evaluate_voxels.
constexpr double kCloudReachSlack = 1e-6;

/// Points as triangles without an area.
void add_point(TrueSurface& surface, const Eigen::Vector3f& point) {
  const auto vertex = static_cast<std::uint32_t>(surface.vertices.size());
  surface.vertices.push_back(point);
  surface.triangles.push_back({vertex, vertex, vertex});
  surface.seen_cells.push_back(cell_of(point.cast<double>(), kCloudCellM));
}

void settle_cells(std::vector<SurfaceCell>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// A surface for each class, behind them one of the points without a class, last one without
/// points whose cells are those of all.
TrueSurfaces surfaces_of(const TrueCloud& cloud) {
  TrueSurfaces surfaces{.seen_cell_m = kCloudCellM};
  const std::size_t num_classes = cloud.class_names.size();
  surfaces.objects.resize(num_classes + 2);
  for (std::size_t i = 0; i < surfaces.objects.size(); ++i) {
    TrueSurface& surface = surfaces.objects[i];
    surface.id = ObjectId{static_cast<std::uint32_t>(i + 1)};
    surface.is_nameable = i < num_classes;
    if (surface.is_nameable) surface.class_name = cloud.class_names[i];
  }
  std::vector<SurfaceCell>& all = surfaces.objects.back().seen_cells;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t of =
        cloud.class_of_point[i] == TrueCloud::kNoTrueClass ? num_classes : cloud.class_of_point[i];
    add_point(surfaces.objects[of], cloud.points[i]);
    all.push_back(surfaces.objects[of].seen_cells.back());
  }
  for (TrueSurface& surface : surfaces.objects) settle_cells(surface.seen_cells);
  return surfaces;
}

/// Cubes of occupied space.
struct OccupiedCubes {
  std::vector<Eigen::Vector3d> centres;
  std::vector<double> half_edges_m;
  std::vector<bool> is_labelled;
  double max_half_edge_m = 0.0;
};

OccupiedCubes occupied_cubes(const LeafSource& leaves) {
  OccupiedCubes cubes;
  leaves([&](const LeafSample& leaf) {
    if (!leaf.occupied) return;
    cubes.centres.push_back(leaf.centre_in_map);
    cubes.half_edges_m.push_back(0.5 * leaf.edge_m);
    cubes.is_labelled.push_back(leaf.best_class.has_value());
    cubes.max_half_edge_m = std::max(cubes.max_half_edge_m, 0.5 * leaf.edge_m);
  });
  return cubes;
}

double distance_to_cube(const Eigen::Vector3d& point, const OccupiedCubes& cubes, std::size_t i) {
  const Eigen::Array3d beyond = (point - cubes.centres[i]).array().abs() - cubes.half_edges_m[i];
  return beyond.max(0.0).matrix().norm();
}

PointDistances summary_of(std::vector<double> distances) {
  std::sort(distances.begin(), distances.end());
  const std::size_t n = distances.size();
  const auto rank = [&](double share) {
    return distances[static_cast<std::size_t>(std::ceil(share * static_cast<double>(n))) - 1];
  };
  return {
      .n = n,
      .mean_m = std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(n),
      .median_m = rank(0.5),
      .upper_m = rank(0.95),
      .max_m = distances.back()};
}

Result<std::optional<PointDistances>> distances_of(const TrueCloud& cloud,
                                                   const OccupiedCubes& cubes,
                                                   const StopCheck& stop) {
  if (cloud.points.empty() || cubes.centres.empty()) return std::optional<PointDistances>();
  const PointTree tree(cubes.centres);
  const double slack_m = std::sqrt(3.0) * cubes.max_half_edge_m;
  std::vector<double> distances;
  distances.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (i % kPointsBetweenStops == 0 && stop && stop()) return interrupted();
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    distances.push_back(tree.least_distance(
        point, slack_m, [&](std::size_t cube) { return distance_to_cube(point, cubes, cube); }));
  }
  return std::optional(summary_of(std::move(distances)));
}

/// Labelled cubes without a point within an edge.
Result<std::size_t> labelled_off(const TrueCloud& cloud,
                                 const OccupiedCubes& cubes,
                                 const StopCheck& stop) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(cloud.points.size());
  for (const Eigen::Vector3f& point : cloud.points) points.push_back(point.cast<double>());
  const PointTree tree(points);
  std::size_t num_off = 0;
  for (std::size_t i = 0; i < cubes.centres.size(); ++i) {
    if (i % kPointsBetweenStops == 0 && stop && stop()) return interrupted();
    if (!cubes.is_labelled[i]) continue;
    const Eigen::Vector3d& centre = cubes.centres[i];
    const double reach_m = 2.0 * cubes.half_edges_m[i] * (1.0 + kCloudReachSlack);
    bool is_near = false;
    tree.for_each_near(
        {centre, centre, centre}, reach_m, [&](std::size_t, double) { is_near = true; });
    num_off += is_near ? 0U : 1U;
  }
  return num_off;
}

}  // namespace

Result<void> validate(const TrueCloud& cloud) {
  const auto refused = [](std::string what, std::string field) {
    return fail(ErrorCode::kInvalidArgument, std::move(what), std::move(field));
  };
  if (cloud.class_of_point.size() != cloud.points.size())
    return refused("must have one a point", "class_of_point");
  for (const std::string& name : cloud.class_names)
    if (canonical_class_name(name).empty()) return refused("must not be empty", "class_names");
  for (const std::uint32_t of : cloud.class_of_point) {
    if (of != TrueCloud::kNoTrueClass && of >= cloud.class_names.size())
      return refused("is of no class that is there", "class_of_point");
  }
  for (const Eigen::Vector3f& point : cloud.points) {
    if (!point.allFinite() ||
        static_cast<double>(point.cwiseAbs().maxCoeff()) > kMaxTrueCoordinateM)
      return refused("must be finite and within 1e6 m", "points");
  }
  return {};
}

std::optional<double> CloudEvaluation::precision_at_cloud() const {
  const std::size_t n = all.labelled - labelled_off_cloud;
  if (n == 0) return std::nullopt;
  return static_cast<double>(all.right) / static_cast<double>(n);
}

Result<CloudEvaluation> evaluate_cloud(const LeafSource& leaves,
                                       const ClassRegistry& classes,
                                       const TrueCloud& cloud,
                                       const StopCheck& stop) {
  const TrueSurfaces surfaces = surfaces_of(cloud);
  HYPERMAP_ASSIGN_OR_RETURN(VoxelEvaluation labels,
                            evaluate_voxels(leaves, classes, surfaces, stop));
  const OccupiedCubes cubes = occupied_cubes(leaves);
  CloudEvaluation evaluation;
  evaluation.all = labels.all;
  evaluation.classes = std::move(labels.classes);
  evaluation.coverage = labels.coverage.back();
  for (std::size_t i = 0; i < cloud.class_names.size(); ++i) {
    SurfaceCoverage& of_class =
        evaluation.coverage_of_class[canonical_class_name(cloud.class_names[i])];
    of_class.seen_cells += labels.coverage[i].seen_cells;
    of_class.covered_cells += labels.coverage[i].covered_cells;
  }
  evaluation.num_points = cloud.points.size();
  evaluation.num_without_class = static_cast<std::size_t>(std::count(
      cloud.class_of_point.begin(), cloud.class_of_point.end(), TrueCloud::kNoTrueClass));
  HYPERMAP_ASSIGN_OR_RETURN(evaluation.labelled_off_cloud, labelled_off(cloud, cubes, stop));
  HYPERMAP_ASSIGN_OR_RETURN(evaluation.distances, distances_of(cloud, cubes, stop));
  return evaluation;
}

}  // namespace hypermap
