// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"

#include "cell_set.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

namespace hypermap {
namespace {

constexpr double kMaxCoordinateM = 1e6;
constexpr int kMaxCell = 1 << 22;
constexpr std::size_t kMaxFaces = std::size_t{1} << 25U;

bool is_drawable(const LeafSample& leaf) {
  return leaf.occupied && std::isfinite(leaf.edge_m) && leaf.edge_m > 0.0 &&
         leaf.centre_in_map.allFinite() &&
         leaf.centre_in_map.cwiseAbs().maxCoeff() <= kMaxCoordinateM;
}

/// The cell of the finest grid that a voxel of the finest edge fills; none for larger ones and for
/// those too far out to be counted.
class CellFinder {
 public:
  explicit CellFinder(float edge_m) : edge_m_(edge_m) {}

  [[nodiscard]] std::optional<Eigen::Vector3i> cell_of(const OccupiedVoxel& voxel) const {
    if (voxel.edge_m > 1.5F * edge_m_) return std::nullopt;
    const Eigen::Vector3d cells = voxel.centre_in_map.cast<double>() / static_cast<double>(edge_m_);
    if (cells.cwiseAbs().maxCoeff() >= kMaxCell - 2) return std::nullopt;
    return Eigen::Vector3i(cells.array().floor().cast<int>());
  }

 private:
  float edge_m_;
};

/// Corner k of a face: closed by the side neighbours and the diagonal one, on the face's side.
std::uint8_t corner_openness(const CellSet& cells,
                             const Eigen::Vector3i& before_face,
                             const Eigen::Vector3i& first,
                             const Eigen::Vector3i& second) {
  const int side_a = cells.contains(before_face + first) ? 1 : 0;
  const int side_b = cells.contains(before_face + second) ? 1 : 0;
  if (side_a + side_b == 2) return 0;
  const int diagonal = cells.contains(before_face + first + second) ? 1 : 0;
  return static_cast<std::uint8_t>(3 - side_a - side_b - diagonal);
}

std::array<std::uint8_t, 4> face_openness(const CellSet& cells,
                                          const Eigen::Vector3i& before_face,
                                          FaceDirection direction) {
  const FaceAxes axes = axes_of(direction);
  const Eigen::Vector3i first = axes.first.cast<int>();
  const Eigen::Vector3i second = axes.second.cast<int>();
  std::array<std::uint8_t, 4> openness{};
  for (std::size_t k = 0; k < openness.size(); ++k) {
    openness[k] = corner_openness(cells,
                                  before_face,
                                  (k & 1U) != 0 ? first : Eigen::Vector3i(-first),
                                  (k & 2U) != 0 ? second : Eigen::Vector3i(-second));
  }
  return openness;
}

CellSet cells_of(std::span<const OccupiedVoxel> voxels, const CellFinder& finder) {
  CellSet cells;
  for (const OccupiedVoxel& voxel : voxels) {
    if (const auto cell = finder.cell_of(voxel)) cells.insert(*cell);
  }
  return cells;
}

std::vector<VoxelFace> collect_faces(std::span<const OccupiedVoxel> voxels,
                                     std::span<const FaceDirection> directions) {
  const CellFinder finder(finest_edge_m(voxels));
  const CellSet cells = cells_of(voxels, finder);
  std::vector<VoxelFace> faces;
  for (std::size_t i = 0; i < voxels.size() && faces.size() <= kMaxFaces; ++i) {
    const auto cell = finder.cell_of(voxels[i]);
    for (const FaceDirection direction : directions) {
      VoxelFace face{static_cast<std::uint32_t>(i), direction, {3, 3, 3, 3}};
      if (cell) {
        const Eigen::Vector3i before_face = *cell + normal_of(direction).cast<int>();
        if (cells.contains(before_face)) continue;
        face.openness = face_openness(cells, before_face, direction);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace

std::vector<OccupiedVoxel> occupied_voxels(const LeafSource& leaves) {
  std::vector<OccupiedVoxel> voxels;
  if (!leaves) return voxels;
  leaves([&](const LeafSample& leaf) {
    if (!is_drawable(leaf)) return;
    voxels.push_back(
        {leaf.centre_in_map.cast<float>(), static_cast<float>(leaf.edge_m), leaf.best_class});
  });
  return voxels;
}

float finest_edge_m(std::span<const OccupiedVoxel> voxels) {
  float finest = voxels.empty() ? 0.0F : voxels.front().edge_m;
  for (const OccupiedVoxel& voxel : voxels) finest = std::min(finest, voxel.edge_m);
  return finest;
}

Eigen::Vector3f normal_of(FaceDirection direction) {
  switch (direction) {
    case FaceDirection::kEast:
      return {1, 0, 0};
    case FaceDirection::kWest:
      return {-1, 0, 0};
    case FaceDirection::kNorth:
      return {0, 1, 0};
    case FaceDirection::kSouth:
      return {0, -1, 0};
    case FaceDirection::kUp:
      return {0, 0, 1};
    case FaceDirection::kDown:
      return {0, 0, -1};
  }
  return {0, 0, 0};
}

FaceAxes axes_of(FaceDirection direction) {
  switch (direction) {
    case FaceDirection::kEast:
      return {{0, 1, 0}, {0, 0, 1}};
    case FaceDirection::kWest:
      return {{0, 0, 1}, {0, 1, 0}};
    case FaceDirection::kNorth:
      return {{0, 0, 1}, {1, 0, 0}};
    case FaceDirection::kSouth:
      return {{1, 0, 0}, {0, 0, 1}};
    case FaceDirection::kUp:
      return {{1, 0, 0}, {0, 1, 0}};
    case FaceDirection::kDown:
      return {{0, 1, 0}, {1, 0, 0}};
  }
  return {{0, 0, 0}, {0, 0, 0}};
}

Result<std::vector<VoxelFace>> exposed_faces(std::span<const OccupiedVoxel> voxels,
                                             std::span<const FaceDirection> directions) {
  try {
    std::vector<VoxelFace> faces = collect_faces(voxels, directions);
    if (faces.size() <= kMaxFaces) return faces;
    return fail(ErrorCode::kLimit,
                "more than " + std::to_string(kMaxFaces) + " voxel faces in one image");
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the faces of the voxels");
  }
}

}  // namespace hypermap
