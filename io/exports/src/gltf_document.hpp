// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Scenes of meshes as glTF 2.0, in its binary form (GLB).
///
/// Source: Khronos Group, "glTF 2.0 Specification" (2021), sections 3 and 4.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// Triangles of one material. Numbers are those that the document gave.
struct GltfPrimitive {
  std::size_t positions = 0;
  std::size_t indices = 0;
  std::size_t material = 0;
};

/// A place in the scene: children and mesh are first turned, then moved. Unit: metre.
struct GltfNode {
  std::string name = {};
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::optional<std::array<double, 4>> rotation = {};  ///< Unit quaternion x, y, z, w.
  std::optional<std::size_t> mesh = {};
  std::vector<std::size_t> children = {};
  std::string extras = {};  ///< What an application keeps there, as JSON; empty: nothing.
};

/// Collects materials, data, meshes and nodes, each called by the number that its adding returned.
/// Meshes have positions alone: readers then take flat normals (section 3.7.2.1).
class GltfDocument {
 public:
  /// A dull material of that colour; less opaque than 1 it is blended.
  std::size_t add_material(const std::string& name, Rgb8 color, double opacity);
  /// Requires: one or more, finite.
  std::size_t add_positions(std::span<const Eigen::Vector3f> positions);
  /// Numbers within the positions of a primitive, three a triangle; of 16 bits where all are below
  /// 65,535. Requires: three or more.
  std::size_t add_indices(std::span<const std::uint32_t> indices);
  /// Requires: one primitive or more, of numbers that were given.
  std::size_t add_mesh(const std::string& name, std::span<const GltfPrimitive> primitives);
  /// Requires: children and mesh were added, each child to one node alone.
  std::size_t add_node(const GltfNode& node);

  /// The file of a scene whose only root is that node. Requires: a node, a mesh.
  /// Errors: kLimit where it would take 2^32 bytes or more.
  [[nodiscard]] Result<std::string> glb(std::size_t root) const;

 private:
  [[nodiscard]] std::string json(std::size_t root) const;

  std::vector<std::string> materials_;  ///< As JSON, and so are the next three.
  std::vector<std::string> accessors_;
  std::vector<std::string> meshes_;
  std::vector<std::string> nodes_;
  std::string positions_;  ///< 12 bytes each.
  std::string indices_;    ///< Each accessor's begin at a multiple of 4 bytes.
};

}  // namespace hypermap
