// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/io/archive/map_layers.hpp"
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

void add_leaf(const LeafSample& leaf,
              std::span<const Rgb8> colors,
              const std::optional<std::set<ClassId>>& wanted,
              PlyBody& body) {
  if (!leaf.occupied) return;
  const auto& best = leaf.best_class;
  if (wanted && (!best || !wanted->contains(*best))) return;
  const Rgb8 color =
      best && best->value < colors.size() ? colors[best->value] : Rgb8{200, 200, 200};
  body.add(leaf.centre_in_map.cast<float>(),
           color,
           best ? static_cast<std::uint16_t>(best->value) : kNoClass,
           static_cast<std::int32_t>(leaf.object.value),
           best ? static_cast<float>(leaf.class_log_odds.probability().value()) : 0.0F);
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
  shown_leaves(archive)([&](const LeafSample& leaf) { add_leaf(leaf, colors, wanted, body); });
  if (body.num_vertices() == 0) return WrittenFiles{};
  HYPERMAP_TRY(
      write_file_atomically(request.output, header(archive, body.num_vertices()) + body.bytes()));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
