// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "exported_objects.hpp"
#include "gltf_document.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "voxel_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kBoxOpacity = 0.35;  // what stands in a box shows through
constexpr double kMaxBoxCoordinateM = 1e6;
constexpr std::uint64_t kMaxMeshVoxels = std::uint64_t{1} << 26U;  // 2.5 GiB while they are merged
constexpr Rgb8 kNoClassColor{200, 200, 200};

/// Turns +z up to glTF's +y up: (x, y, z) becomes (x, z, -y), a quarter turn about -x.
const std::array<double, 4> kYUpFromZUp{-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};

/// Which colour something of a class has, by number: the class's, or one more than all.
std::uint32_t color_number(std::optional<ClassId> class_id, const ClassRegistry& classes) {
  const bool is_known = class_id && classes.contains(*class_id);
  return is_known ? class_id->value : static_cast<std::uint32_t>(classes.size());
}

/// Occupied voxels by the node that they belong to: an object's, or kNoObject for the surface.
using NodeVoxels = std::map<ObjectId, std::vector<ColoredVoxel>>;

/// The voxels of a leaf, which may be larger than one.
void append_voxels(const LeafSample& leaf,
                   double resolution_m,
                   std::uint32_t color,
                   std::vector<ColoredVoxel>& voxels) {
  const auto edge = static_cast<std::int32_t>(std::lround(leaf.edge_m / resolution_m));
  LatticePoint low{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low_m = leaf.centre_in_map[static_cast<Eigen::Index>(axis)] - 0.5 * leaf.edge_m;
    low[axis] = static_cast<std::int32_t>(std::lround(low_m / resolution_m));
  }
  for (std::int32_t z = 0; z < edge; ++z) {
    for (std::int32_t y = 0; y < edge; ++y) {
      for (std::int32_t x = 0; x < edge; ++x) {
        voxels.push_back({.low = {low[0] + x, low[1] + y, low[2] + z}, .color = color});
      }
    }
  }
}

/// Of the classes asked for. Voxels of `objects` are theirs with --with-voxels, else the surface's.
Result<NodeVoxels> voxels_by_node(const MapArchive& archive,
                                  const ExportRequest& request,
                                  const std::vector<ExportedObject>& objects,
                                  double resolution_m) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  std::set<ObjectId> owners;
  if (request.with_voxels) {
    for (const ExportedObject& exported : objects) owners.insert(exported.object->id);
  }
  NodeVoxels voxels;
  std::uint64_t num_voxels = 0;
  shown_leaves(archive)([&](const LeafSample& leaf) {
    const auto& best = leaf.best_class;
    if (!leaf.occupied || (wanted && (!best || !wanted->contains(*best)))) return;
    const auto edge = static_cast<std::uint64_t>(std::lround(leaf.edge_m / resolution_m));
    num_voxels += edge * edge * edge;
    if (num_voxels > kMaxMeshVoxels) return;
    const ObjectId node = owners.contains(leaf.object) ? leaf.object : kNoObject;
    append_voxels(leaf, resolution_m, color_number(best, archive.classes), voxels[node]);
  });
  if (num_voxels <= kMaxMeshVoxels) return voxels;
  return fail(ErrorCode::kLimit,
              "the map has " + std::to_string(num_voxels) +
                  " occupied voxels, a mesh is made of at most " + std::to_string(kMaxMeshVoxels) +
                  " (--class takes some of them)",
              "--format");
}

/// The scene that grows node by node.
class MapScene {
 public:
  MapScene(const MapArchive& archive, const ClassPalette& palette, double resolution_m)
      : classes_(archive.classes),
        colors_(class_colors(archive.classes, palette)),
        resolution_m_(resolution_m) {
    colors_.push_back(kNoClassColor);
  }

  /// The box of an object, and within it its voxels where it has any.
  Result<std::size_t> add_object(const ExportedObject& exported,
                                 const std::vector<ColoredVoxel>& voxels) {
    const Object& object = *exported.object;
    const double reach_m = std::max(object.box.min_in_map.cwiseAbs().maxCoeff(),
                                    object.box.max_in_map.cwiseAbs().maxCoeff());
    if (!(reach_m <= kMaxBoxCoordinateM)) {
      return fail(ErrorCode::kLimit,
                  "the box of object " + std::to_string(object.id.value) + " reaches to " +
                      number_text(reach_m) + " m, may to 1e6 m");
    }
    const Eigen::Vector3d centre = object.box.centre();
    GltfNode node{.name = exported.class_name + " " + std::to_string(object.id.value),
                  .translation = centre,
                  .extras = extras_of(exported)};
    node.mesh = add_box(node.name, object.box, color_number(exported.class_id, classes_));
    if (!voxels.empty()) {
      node.children.push_back(add_voxels(node.name + " voxels", voxels, centre));
    }
    return document_.add_node(node);
  }

  /// A node with a mesh of the exposed faces, in a node whose origin is at `origin`.
  std::size_t add_voxels(const std::string& name,
                         const std::vector<ColoredVoxel>& voxels,
                         const Eigen::Vector3d& origin) {
    const std::vector<FaceRectangle> faces = faces_by_color(voxels);
    const LatticePoint corner = faces.front().low;
    std::vector<GltfPrimitive> primitives;
    for (auto begin = faces.begin(); begin != faces.end();) {
      const auto end = std::find_if(begin, faces.end(), [&](const FaceRectangle& face) {
        return face.color != begin->color;
      });
      primitives.push_back(add_faces({begin, end}, corner));
      begin = end;
    }
    return document_.add_node({.name = name,
                               .translation = in_metres(corner) - origin,
                               .mesh = document_.add_mesh(name, primitives)});
  }

  std::size_t add_group(const std::string& name, std::vector<std::size_t> children) {
    return document_.add_node({.name = name, .children = std::move(children)});
  }

  [[nodiscard]] Result<std::string> glb(std::vector<std::size_t> children,
                                        const std::string& frame_id) {
    const std::string extras =
        json_object({{"frame_id", json_quoted(frame_id)}, {"unit", "\"metre\""}, {"up", "\"z\""}});
    return document_.glb(document_.add_node({.name = "map",
                                             .rotation = kYUpFromZUp,
                                             .children = std::move(children),
                                             .extras = extras}));
  }

 private:
  static std::string extras_of(const ExportedObject& exported) {
    const Box& box = exported.object->box;
    std::vector<double> corners(box.min_in_map.begin(), box.min_in_map.end());
    corners.insert(corners.end(), box.max_in_map.begin(), box.max_in_map.end());
    return json_object({{"id", std::to_string(exported.object->id.value)},
                        {"class", json_quoted(exported.class_name)},
                        {"confidence", json_number(exported.confidence)},
                        {"box", json_array(corners, json_number)}});
  }

  static std::vector<FaceRectangle> faces_by_color(const std::vector<ColoredVoxel>& voxels) {
    std::vector<FaceRectangle> faces = merged_faces(voxels);
    std::ranges::stable_sort(faces, {}, &FaceRectangle::color);
    return faces;
  }

  [[nodiscard]] Eigen::Vector3d in_metres(const LatticePoint& point) const {
    return resolution_m_ * Eigen::Vector3d(point[0], point[1], point[2]);
  }

  GltfPrimitive add_faces(std::span<const FaceRectangle> faces, const LatticePoint& corner) {
    const LatticeMesh mesh = mesh_of(faces);
    std::vector<Eigen::Vector3f> positions;
    positions.reserve(mesh.points.size());
    for (const LatticePoint& point : mesh.points) {
      positions.push_back((in_metres(point) - in_metres(corner)).cast<float>());
    }
    return {.positions = document_.add_positions(positions),
            .indices = document_.add_indices(mesh.triangles),
            .material = material(faces.front().color, 1.0)};
  }

  /// The box about its own centre. Its triangles, those of one voxel, are the same for all boxes.
  std::size_t add_box(const std::string& name, const Box& box, std::uint32_t color) {
    const ColoredVoxel voxel{};
    const LatticeMesh cube = mesh_of(merged_faces({&voxel, 1}));
    if (!box_indices_) box_indices_ = document_.add_indices(cube.triangles);
    std::vector<Eigen::Vector3f> positions;
    positions.reserve(cube.points.size());
    for (const LatticePoint& point : cube.points) {
      const Eigen::Array3d part = Eigen::Array3d(point[0], point[1], point[2]) - 0.5;
      positions.push_back((part * box.extent().array()).matrix().cast<float>());
    }
    const std::array<GltfPrimitive, 1> primitives{
        GltfPrimitive{.positions = document_.add_positions(positions),
                      .indices = *box_indices_,
                      .material = material(color, kBoxOpacity)}};
    return document_.add_mesh(name, primitives);
  }

  std::size_t material(std::uint32_t color, double opacity) {
    const auto [found, is_new] = materials_.try_emplace({color, opacity}, 0);
    if (is_new) {
      const std::string name = color < classes_.size() ? classes_.name(ClassId{color}) : "no class";
      found->second = document_.add_material(name, colors_[color], opacity);
    }
    return found->second;
  }

  const ClassRegistry& classes_;
  std::vector<Rgb8> colors_;
  double resolution_m_;
  GltfDocument document_;
  std::map<std::pair<std::uint32_t, double>, std::size_t> materials_;
  std::optional<std::size_t> box_indices_;
};

/// The group of all objects.
Result<std::size_t> add_objects(const std::vector<ExportedObject>& objects,
                                NodeVoxels& voxels,
                                MapScene& scene) {
  std::vector<std::size_t> nodes;
  nodes.reserve(objects.size());
  for (const ExportedObject& exported : objects) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::size_t node,
                              scene.add_object(exported, voxels[exported.object->id]));
    nodes.push_back(node);
  }
  return scene.add_group("objects", std::move(nodes));
}

}  // namespace

Result<WrittenFiles> export_glb(const MapArchive& archive, const ExportRequest& request) {
  const bool has_voxels = archive.octree || !archive.octomaps.empty();
  if (!has_voxels && archive.objects.empty()) {
    return fail(ErrorCode::kNotFound, "the map has neither objects nor an octree");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto objects, exported_objects(archive, request));
  double resolution_m = 1.0;  // of no voxels
  NodeVoxels voxels;
  if (has_voxels) {
    HYPERMAP_ASSIGN_OR_RETURN(resolution_m, octree_resolution_m(archive));
    HYPERMAP_ASSIGN_OR_RETURN(voxels, voxels_by_node(archive, request, objects, resolution_m));
  }
  MapScene scene(archive, request.palette, resolution_m);
  std::vector<std::size_t> children;
  if (!objects.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::size_t group, add_objects(objects, voxels, scene));
    children.push_back(group);
  }
  const std::vector<ColoredVoxel>& surface = voxels[kNoObject];
  if (!surface.empty()) {
    children.push_back(scene.add_voxels("surface", surface, Eigen::Vector3d::Zero()));
  }
  if (children.empty()) return WrittenFiles{};
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            scene.glb(std::move(children), shown_frame_id(archive)));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
