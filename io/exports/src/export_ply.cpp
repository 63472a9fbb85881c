// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/io/codec/atomic_file.hpp"

#include <cstring>

namespace hypermap {
namespace {

constexpr std::uint16_t kNoClass = 0xFFFF;
constexpr std::size_t kMaxPlyCommentBytes = 1024;  // a class name of 256 bytes, each escaped

/// One vertex, packed as the header declares it.
class PlyBody {
 public:
  void add(const Eigen::Vector3f& point,
           Rgb8 color,
           std::uint16_t label,
           std::int32_t instance,
           float confidence) {
    for (const float coordinate : point) append(coordinate);
    append(color.r);
    append(color.g);
    append(color.b);
    append(label);
    append(instance);
    append(confidence);
    ++num_vertices_;
  }
  [[nodiscard]] std::size_t num_vertices() const noexcept { return num_vertices_; }
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  template <class T>
  void append(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
  }

  std::string bytes_;
  std::size_t num_vertices_ = 0;
};

void add_leaf(const StoredLeaf& leaf,
              const SemanticOctree& octree,
              std::span<const Rgb8> colors,
              const std::optional<std::set<ClassId>>& wanted,
              PlyBody& body) {
  if (leaf.log_odds < octree.sensor_model().occupied_from) return;
  const auto best = leaf.label ? leaf.label->best_class() : std::nullopt;
  if (wanted && (!best || !wanted->contains(*best))) return;
  const Eigen::Vector3f centre = octree.grid().centre(leaf.key).xyz.cast<float>();
  const Rgb8 color =
      best && best->value < colors.size() ? colors[best->value] : Rgb8{200, 200, 200};
  const auto label = best ? static_cast<std::uint16_t>(best->value) : kNoClass;
  const double confidence =
      best ? from_milli(leaf.label->classes[0].log_odds).probability().value() : 0.0;
  body.add(centre,
           color,
           label,
           static_cast<std::int32_t>(leaf.label ? leaf.label->object.value : kNoObject.value),
           static_cast<float>(confidence));
}

/// Open3D reads uint16 and int, but neither ushort nor uint; CloudCompare takes scalar_... as a
/// scalar field.
std::string header(const MapArchive& archive, std::size_t num_vertices) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += "comment centres of occupied voxels, metres, frame map, +z up\n";
  text += "comment label 65535: no class; instance 0: no object; confidence of the label\n";
  for (std::size_t i = 0; i < archive.classes.size(); ++i) {
    text += "comment label " + std::to_string(i) + " " +
            printable(archive.classes.names()[i], kMaxPlyCommentBytes) + "\n";
  }
  text += "element vertex " + std::to_string(num_vertices) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += std::string("property float ") + axis + "\n";
  for (const char* part : {"red", "green", "blue"}) {
    text += std::string("property uchar ") + part + "\n";
  }
  return text +
         "property uint16 scalar_label\nproperty int scalar_instance\n"
         "property float scalar_confidence\nend_header\n";
}

}  // namespace

Result<WrittenFiles> export_ply(const MapArchive& archive, const ExportRequest& request) {
  if (!archive.octree) return fail(ErrorCode::kNotFound, "the map has no semantic octree");
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  const std::vector<Rgb8> colors = class_colors(archive.classes, request.palette);
  PlyBody body;
  archive.octree->for_each_stored_leaf(
      [&](const StoredLeaf& leaf) { add_leaf(leaf, *archive.octree, colors, wanted, body); });
  if (body.num_vertices() == 0) return WrittenFiles{};
  HYPERMAP_TRY(
      write_file_atomically(request.output, header(archive, body.num_vertices()) + body.bytes()));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
