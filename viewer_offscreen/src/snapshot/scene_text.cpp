// SPDX-License-Identifier: BSD-3-Clause
#include "grid_texture.hpp"
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"
#include "scene_content.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace hypermap {
namespace {

constexpr std::size_t kMaxLabels = 200;
constexpr std::size_t kMaxTextBytes = 80;
constexpr std::string_view kSeparator = "  ·  ";
constexpr Rgb8 kUnlabelledColor{205, 208, 214};

/// "12,345"
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

std::string counted(std::size_t number, std::string_view noun) {
  return grouped(number) + " " + std::string(noun) + (number == 1 ? "" : "s");
}

struct ClassCount {
  std::size_t objects = 0;
  std::size_t voxels = 0;
};

/// Per class what is shown of it; without a class under none.
std::map<std::optional<ClassId>, ClassCount> count_classes(const SnapshotScene& scene,
                                                           const SnapshotLayers& layers,
                                                           const VisibleVoxels& voxels,
                                                           const ClassRegistry& registry) {
  std::map<std::optional<ClassId>, ClassCount> counts;
  if (layers.voxels) {
    for (const OccupiedVoxel& voxel : voxels.voxels) ++counts[voxel.class_id].voxels;
  }
  if (layers.objects) {
    for (const SnapshotObject& object : scene.objects) ++counts[object.class_id].objects;
  } else if (layers.semantic) {
    for (const SemanticObject& object : scene.semantic)
      ++counts[registry.find(object.name)].objects;
  }
  return counts;
}

std::string class_name(const std::optional<ClassId>& id, const ClassRegistry& registry) {
  if (!id) return "no class";
  return registry.contains(*id) ? printable(registry.name(*id), kMaxTextBytes)
                                : "class " + std::to_string(id->value);
}

Legend legend_of(const SnapshotScene& scene,
                 const SnapshotLayers& layers,
                 const VisibleVoxels& voxels,
                 const ClassRegistry& registry,
                 const ClassColors& colors) {
  struct Entry {
    std::optional<ClassId> id;
    ClassCount count;
  };
  std::vector<Entry> entries;
  for (const auto& [id, count] : count_classes(scene, layers, voxels, registry)) {
    entries.push_back({id, count});
  }
  // Many objects first, then many voxels; what has no class comes last; ids break ties.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tuple(!a.id.has_value(), b.count.objects, b.count.voxels) <
           std::tuple(!b.id.has_value(), a.count.objects, a.count.voxels);
  });
  const bool with_objects = layers.objects || layers.semantic;
  Legend legend;
  if (with_objects && !entries.empty()) legend.columns.emplace_back("objects");
  if (layers.voxels && !entries.empty()) legend.columns.emplace_back("voxels");
  const auto number = [](std::size_t count) { return count == 0 ? "–" : grouped(count); };
  for (const auto& [id, count] : entries) {
    LegendRow row{
        id || !layers.voxels ? colors.of(id) : kUnlabelledColor, class_name(id, registry), {}};
    if (with_objects) row.numbers.push_back(number(count.objects));
    if (layers.voxels) row.numbers.push_back(number(count.voxels));
    legend.rows.push_back(std::move(row));
  }
  if (layers.occupancy && scene.occupancy) {
    legend.rows.push_back({occupancy_color(kOccupiedCell), "occupied", {}});
    legend.rows.push_back({occupancy_color(kFreeCell), "free", {}});
    legend.rows.push_back({occupancy_color(kUnknownCell), "unknown", {}});
  }
  return legend;
}

std::string_view view_name(const SnapshotView& view) {
  constexpr std::array<std::string_view, 3> kNames{"iso view", "top view", "camera view"};
  return kNames[view.index()];
}

std::string subtitle_of(const SnapshotScene& scene,
                        const SnapshotOptions& options,
                        const SnapshotLayers& layers,
                        const VisibleVoxels& voxels) {
  std::string text = "frame " + printable(scene.frame_id, kMaxTextBytes) + std::string(kSeparator);
  text += view_name(options.view);
  if (layers.voxels && voxels.num_occupied > 0) {
    text += std::string(kSeparator);
    if (voxels.voxels.size() < voxels.num_occupied) text += grouped(voxels.voxels.size()) + " of ";
    text += counted(voxels.num_occupied, "occupied voxel") + " of " +
            length_text(static_cast<double>(finest_edge_m(voxels.voxels)));
  }
  if (layers.occupancy && scene.occupancy) {
    text += std::string(kSeparator) + "cells of " +
            length_text(scene.occupancy->geometry().resolution_m);
  }
  if (layers.objects) text += std::string(kSeparator) + counted(scene.objects.size(), "object");
  if (layers.semantic && !layers.objects)
    text += std::string(kSeparator) + counted(scene.semantic.size(), "object");
  return text;
}

/// What of the map stays out of the image; empty when all is there.
std::string not_drawn_text(const SnapshotScene& scene,
                           const SnapshotLayers& layers,
                           const VisibleVoxels& voxels) {
  std::vector<std::string> parts;
  if (voxels.num_too_high > 0)
    parts.push_back("what is higher than " + length_text(voxels.cut_m) + " over the floor");
  if (voxels.num_near_walls > 0) parts.emplace_back("walls before the room");
  if ((layers.objects || layers.semantic) && scene.num_tentative > 0)
    parts.push_back(counted(scene.num_tentative, "tentative object"));
  std::string text;
  for (const std::string& part : parts)
    text.append(text.empty() ? "not drawn: " : ", ").append(part);
  return text;
}

std::vector<MapLabel> object_labels(const SnapshotScene& scene,
                                    const SnapshotView& view,
                                    const ClassColors& colors) {
  std::vector<const SnapshotObject*> order;
  for (const SnapshotObject& object : scene.objects) {
    if (!object.label.empty()) order.push_back(&object);
  }
  // Large objects first: they are looked for first, and their labels have the best places.
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return a->box.volume_m3() > b->box.volume_m3();
  });
  if (order.size() > kMaxLabels) order.resize(kMaxLabels);
  std::vector<MapLabel> labels;
  for (const SnapshotObject* object : order) {
    Eigen::Vector3d middle = object->box.centre();
    middle.z() = object->box.max_in_map.z();
    Eigen::Vector3d upper = middle;
    if (std::holds_alternative<TopView>(view)) upper.y() = object->box.max_in_map.y();
    labels.push_back({middle,
                      upper,
                      printable(object->label, kMaxTextBytes),
                      colors.of(object->class_id),
                      object->box});
  }
  return labels;
}

std::vector<MapLabel> semantic_labels(const SnapshotScene& scene, double height_m) {
  std::vector<MapLabel> labels;
  for (const SemanticObject& object : scene.semantic) {
    if (labels.size() == kMaxLabels) break;
    const Eigen::Vector2d place = position_of(object);
    const Rect around = bounds_of(object);
    labels.push_back({{place.x(), place.y(), height_m},
                      {place.x(), around.max.y(), height_m},
                      printable(object.name, kMaxTextBytes) + " " + std::to_string(object.id),
                      scene.palette.color_of(object.name),
                      Box{{around.min.x(), around.min.y(), height_m},
                          {around.max.x(), around.max.y(), height_m}}});
  }
  return labels;
}

void add_overlay_labels(std::vector<MapLabel>& labels,
                        const SnapshotOverlay& overlay,
                        double height_m) {
  for (const DrawnText& text : overlay.texts) {
    if (labels.size() == kMaxLabels) return;
    const Eigen::Vector3d place(text.position.x(), text.position.y(), height_m);
    labels.push_back(
        {place, place, printable(text.text, kMaxTextBytes), text.color, Box{place, place}});
  }
}

}  // namespace

Annotations annotations_of(const SnapshotScene& scene,
                           const SnapshotOptions& options,
                           const SnapshotLayers& layers,
                           const VisibleVoxels& voxels,
                           const ClassRegistry& registry,
                           const ClassColors& colors) {
  Annotations annotations;
  annotations.title = printable(scene.title, 2 * kMaxTextBytes);
  annotations.subtitle = subtitle_of(scene, options, layers, voxels);
  annotations.legend = legend_of(scene, layers, voxels, registry, colors);
  const std::string not_drawn = not_drawn_text(scene, layers, voxels);
  if (!not_drawn.empty()) annotations.notes.push_back(not_drawn);
  if (annotations.legend.rows.empty() && !(layers.overlay && !scene.overlay.empty()))
    annotations.subtitle += std::string(kSeparator) + "nothing to show";
  if (layers.objects) {
    annotations.labels = object_labels(scene, options.view, colors);
  } else if (layers.semantic) {
    annotations.labels = semantic_labels(scene, voxels.floor_m);
  }
  if (layers.overlay) add_overlay_labels(annotations.labels, scene.overlay, voxels.floor_m);
  return annotations;
}

}  // namespace hypermap
