// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_mesh.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace hypermap {
namespace {

constexpr unsigned kKeyBits = 21;  // of a coordinate in a key

/// Voxels by their keys, whose neighbours along an axis differ by one number: ascending.
struct KeyedVoxel {
  std::uint64_t key = 0;
  std::uint32_t color = 0;
};

/// One more than the way from `corner`, so that neighbours below have a key too.
std::uint64_t key_of(const LatticePoint& at, const LatticePoint& corner) {
  std::uint64_t key = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const std::int64_t way = std::int64_t{at[axis]} - corner[axis] + 1;
    key = (key << kKeyBits) | static_cast<std::uint64_t>(way);
  }
  return key;
}

LatticePoint point_of(std::uint64_t key, const LatticePoint& corner) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kKeyBits) - 1;
  LatticePoint at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = static_cast<std::int32_t>((key >> (kKeyBits * axis)) & kMask) + corner[axis] - 1;
  }
  return at;
}

LatticePoint lower_corner(std::span<const ColoredVoxel> voxels) {
  LatticePoint corner = voxels.front().low;
  for (const ColoredVoxel& voxel : voxels) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corner[axis] = std::min(corner[axis], voxel.low[axis]);
    }
  }
  return corner;
}

std::vector<KeyedVoxel> by_key(std::span<const ColoredVoxel> voxels, const LatticePoint& corner) {
  std::vector<KeyedVoxel> keyed;
  keyed.reserve(voxels.size());
  for (const ColoredVoxel& voxel : voxels) {
    keyed.push_back({key_of(voxel.low, corner), voxel.color});
  }
  std::ranges::sort(keyed, {}, &KeyedVoxel::key);
  return keyed;
}

/// Which way the faces in hand look, and the axes in their plane: u x v = the axis.
struct Side {
  std::size_t axis = 0;
  bool faces_high = false;
  [[nodiscard]] std::size_t u() const { return (axis + 1) % 3; }
  [[nodiscard]] std::size_t v() const { return (axis + 2) % 3; }
};

/// A face, or a row of faces along u up to `u_end`.
struct FaceRow {
  std::uint32_t color = 0;
  std::int32_t plane = 0;
  std::int32_t v = 0;
  std::int32_t u = 0;
  std::int32_t u_end = 0;
};

/// The faces on one side without a voxel beyond them, by colour, plane, v and u.
std::vector<FaceRow> exposed_rows(const std::vector<KeyedVoxel>& voxels,
                                  const LatticePoint& corner,
                                  const Side& side) {
  const std::uint64_t step = std::uint64_t{1} << (kKeyBits * side.axis);
  std::vector<FaceRow> faces;
  auto beyond = voxels.begin();
  for (const KeyedVoxel& voxel : voxels) {
    const std::uint64_t wanted = side.faces_high ? voxel.key + step : voxel.key - step;
    while (beyond != voxels.end() && beyond->key < wanted) ++beyond;
    if (beyond != voxels.end() && beyond->key == wanted) continue;
    const LatticePoint at = point_of(voxel.key, corner);
    faces.push_back({.color = voxel.color,
                     .plane = at[side.axis] + (side.faces_high ? 1 : 0),
                     .v = at[side.v()],
                     .u = at[side.u()],
                     .u_end = at[side.u()] + 1});
  }
  std::ranges::sort(faces, {}, [](const FaceRow& face) {
    return std::tuple(face.color, face.plane, face.v, face.u);
  });
  std::vector<FaceRow> rows;
  for (const FaceRow& face : faces) {
    const bool goes_on = !rows.empty() && rows.back().color == face.color &&
                         rows.back().plane == face.plane && rows.back().v == face.v &&
                         rows.back().u_end == face.u;
    if (goes_on) {
      rows.back().u_end = face.u_end;
    } else {
      rows.push_back(face);
    }
  }
  return rows;
}

FaceRectangle rectangle_of(const FaceRow& row, const Side& side) {
  FaceRectangle rectangle{
      .color = row.color, .axis = static_cast<int>(side.axis), .faces_high = side.faces_high};
  rectangle.low[side.axis] = row.plane;
  rectangle.high[side.axis] = row.plane;
  rectangle.low[side.u()] = row.u;
  rectangle.high[side.u()] = row.u_end;
  rectangle.low[side.v()] = row.v;
  rectangle.high[side.v()] = row.v + 1;
  return rectangle;
}

/// Equal rows that follow each other along v as one rectangle.
void append_merged(const std::vector<FaceRow>& rows,
                   const Side& side,
                   std::vector<FaceRectangle>& rectangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> last_of;  // by u and u_end
  for (const FaceRow& row : rows) {
    const auto [last, is_new] = last_of.try_emplace({row.u, row.u_end}, rectangles.size());
    if (!is_new) {
      FaceRectangle& before = rectangles[last->second];
      const bool goes_on = before.color == row.color && before.low[side.axis] == row.plane &&
                           before.high[side.v()] == row.v;
      if (goes_on) {
        before.high[side.v()] = row.v + 1;
        continue;
      }
      last->second = rectangles.size();
    }
    rectangles.push_back(rectangle_of(row, side));
  }
}

}  // namespace

std::vector<FaceRectangle> merged_faces(std::span<const ColoredVoxel> voxels) {
  std::vector<FaceRectangle> rectangles;
  if (voxels.empty()) return rectangles;
  const LatticePoint corner = lower_corner(voxels);
  const std::vector<KeyedVoxel> keyed = by_key(voxels, corner);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool faces_high : {false, true}) {
      const Side side{axis, faces_high};
      append_merged(exposed_rows(keyed, corner, side), side, rectangles);
    }
  }
  return rectangles;
}

LatticeMesh mesh_of(std::span<const FaceRectangle> rectangles) {
  LatticeMesh mesh;
  if (rectangles.empty()) return mesh;
  LatticePoint corner = rectangles.front().low;
  for (const FaceRectangle& rectangle : rectangles) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corner[axis] = std::min(corner[axis], rectangle.low[axis]);
    }
  }
  std::unordered_map<std::uint64_t, std::uint32_t> number_of;
  const auto number = [&](const LatticePoint& point) {
    const auto [found, is_new] =
        number_of.try_emplace(key_of(point, corner), static_cast<std::uint32_t>(number_of.size()));
    if (is_new) mesh.points.push_back(point);
    return found->second;
  };
  mesh.triangles.reserve(6 * rectangles.size());
  for (const FaceRectangle& rectangle : rectangles) {
    const Side side{static_cast<std::size_t>(rectangle.axis), rectangle.faces_high};
    LatticePoint at_u = rectangle.low;
    at_u[side.u()] = rectangle.high[side.u()];
    LatticePoint at_v = rectangle.low;
    at_v[side.v()] = rectangle.high[side.v()];
    std::array<std::uint32_t, 4> around{
        number(rectangle.low), number(at_u), number(rectangle.high), number(at_v)};
    if (!rectangle.faces_high) std::swap(around[1], around[3]);
    for (const std::size_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.triangles.push_back(around.at(k));
  }
  return mesh;
}

}  // namespace hypermap
