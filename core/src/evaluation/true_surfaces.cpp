// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/true_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hypermap {
namespace {

constexpr double kMinEdgeM = 0.001;
constexpr double kMaxEdgeM = 10.0;
constexpr float kMaxCoordinateM = 1e6F;

std::string field_of(const TrueSurface& surface, const char* field) {
  return "object " + std::to_string(surface.id.value) + " " + field;
}

bool is_within_reach(const Eigen::Vector3f& vertex) {
  return vertex.allFinite() && vertex.cwiseAbs().maxCoeff() <= kMaxCoordinateM;
}

bool is_within_reach(const SurfaceCell& cell, double edge_m) {
  return centre_of(cell, edge_m).cwiseAbs().maxCoeff() <= static_cast<double>(kMaxCoordinateM);
}

Result<void> check_surface(const TrueSurface& surface, double seen_cell_m) {
  const auto refuse = [&surface](const char* field, const char* rule) {
    return fail(ErrorCode::kInvalidArgument, rule, field_of(surface, field));
  };
  if (surface.class_name.empty()) return refuse("class", "must not be empty");
  if (!std::ranges::all_of(surface.vertices,
                           [](const auto& vertex) { return is_within_reach(vertex); }))
    return refuse("vertices", "must be finite and within 1e6 m");
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= surface.vertices.size())
        return refuse("triangles", "must name vertices that are there");
    }
  }
  const auto& cells = surface.seen_cells;
  if (std::adjacent_find(cells.begin(), cells.end(), std::greater_equal<>()) != cells.end())
    return refuse("seen_cells", "must be in ascending order, each once");
  if (!std::ranges::all_of(
          cells, [=](const SurfaceCell& cell) { return is_within_reach(cell, seen_cell_m); }))
    return refuse("seen_cells", "must lie within 1e6 m");
  return {};
}

}  // namespace

Triangle triangle_at(const TrueSurface& surface, std::size_t index) {
  const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
    return surface.vertices[surface.triangles[index][i]].cast<double>();
  };
  return {corner(0), corner(1), corner(2)};
}

Eigen::Vector3d centre_of(const SurfaceCell& cell, double edge_m) {
  return edge_m * (Eigen::Vector3d(cell.x, cell.y, cell.z).array() + 0.5);
}

SurfaceCell cell_of(const Eigen::Vector3d& point, double edge_m) {
  const Eigen::Vector3d lower = (point / edge_m).array().floor();
  return {static_cast<std::int32_t>(lower.x()),
          static_cast<std::int32_t>(lower.y()),
          static_cast<std::int32_t>(lower.z())};
}

TrueSurfaces transformed(TrueSurfaces surfaces, const Eigen::Isometry3d& motion) {
  for (TrueSurface& surface : surfaces.objects) {
    for (Eigen::Vector3f& vertex : surface.vertices)
      vertex = (motion * vertex.cast<double>()).cast<float>();
    std::vector<SurfaceCell>& cells = surface.seen_cells;
    for (SurfaceCell& cell : cells)
      cell = cell_of(motion * centre_of(cell, surfaces.seen_cell_m), surfaces.seen_cell_m);
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }
  return surfaces;
}

Result<void> validate(const TrueSurfaces& surfaces) {
  if (!(surfaces.seen_cell_m >= kMinEdgeM && surfaces.seen_cell_m <= kMaxEdgeM))
    return fail(ErrorCode::kInvalidArgument, "must be within 0.001 .. 10", "seen_cell_m");
  ObjectId previous = kNoObject;
  for (const TrueSurface& surface : surfaces.objects) {
    if (surface.id <= previous)
      return fail(ErrorCode::kInvalidArgument, "must ascend from 1 on", field_of(surface, "id"));
    HYPERMAP_TRY(check_surface(surface, surfaces.seen_cell_m));
    previous = surface.id;
  }
  return {};
}

}  // namespace hypermap
