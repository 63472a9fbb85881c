// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_info.hpp"

#include "hypermap/io/archive/map_layers.hpp"

#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The entry by which an extension of `format` is saved, as far as it is not that of a new archive.
LayerSummary named(const MapArchive& archive, std::string_view format, std::string name) {
  LayerSummary summary{
      .name = std::move(name), .class_name = std::string(format), .frame_id = "map"};
  const auto kept = archive.extension_entries.find(format);
  if (kept != archive.extension_entries.end()) {
    summary.name = kept->second.name;
    summary.frame_id = kept->second.frame_id;
  }
  return summary;
}

Eigen::AlignedBox3d flat_box(const Rect& rect) {
  return {Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0),
          Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0)};
}

void describe_grid(LayerSummary& summary, const OccupancyGrid& grid) {
  summary.cells = grid.counts();
  if (grid.geometry().num_cells() > 0) summary.bounds = flat_box(bounds(grid.geometry()));
}

void describe_shapes(LayerSummary& summary, const SemanticLayer& layer) {
  summary.num_objects = layer.objects().size();
  Eigen::AlignedBox3d box;
  for (const SemanticObject& object : layer.objects()) box.extend(flat_box(bounds_of(object)));
  if (!box.isEmpty()) summary.bounds = box;
}

void describe_leaves(LayerSummary& summary, const LeafSource& source) {
  summary.flat = false;
  LeafCount count;
  Eigen::AlignedBox3d box;
  source([&](const LeafSample& leaf) {
    ++(leaf.occupied ? count.occupied : count.free);
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * leaf.edge_m);
    box.extend(leaf.centre_in_map - half);
    box.extend(leaf.centre_in_map + half);
  });
  summary.leaves = count;
  if (!box.isEmpty()) summary.bounds = box;
}

LayerSummary describe_objects(const MapArchive& archive) {
  LayerSummary summary = named(archive, kObjectsFormat, "objects");
  summary.flat = false;
  const std::vector<const Object*> shown = shown_objects(archive);
  summary.num_objects = shown.size();
  summary.num_tentative = archive.objects.size() - shown.size();
  Eigen::AlignedBox3d box;
  for (const Object* object : shown)
    box.extend(Eigen::AlignedBox3d(object->box.min_in_map, object->box.max_in_map));
  if (!box.isEmpty()) summary.bounds = box;
  return summary;
}

LayerSummary describe_layer(const Layer& layer) {
  LayerSummary summary{.name = layer.info.name,
                       .class_name = std::string(class_of(layer)),
                       .frame_id = layer.info.frame_id};
  if (const auto* occupancy = std::get_if<OccupancyLayer>(&layer.content))
    describe_grid(summary, occupancy->grid);
  if (const auto* semantic = std::get_if<SemanticLayer>(&layer.content))
    describe_shapes(summary, *semantic);
  return summary;
}

void describe_extensions(ArchiveInfo& info, const MapArchive& archive) {
  if (archive.octree) {
    info.layers.push_back(named(archive, kOctomapFormat, "octree"));
    describe_leaves(info.layers.back(), leaf_source(*archive.octree));
  }
  for (const OctomapExtension& octomap : archive.octomaps) {
    info.layers.push_back({.name = octomap.entry.name,
                           .class_name = octomap.entry.format,
                           .frame_id = octomap.entry.frame_id});
    describe_leaves(info.layers.back(), leaf_source(octomap.tree));
  }
  if (!archive.objects.empty()) info.layers.push_back(describe_objects(archive));
  for (const ClassGrid& grid : archive.class_grids) {
    info.layers.push_back({.name = grid.class_name,
                           .class_name = std::string(kClassGridFormat),
                           .frame_id = grid.frame_id});
    describe_grid(info.layers.back(), grid.grid);
  }
}

}  // namespace

ArchiveInfo describe(const MapArchive& archive) {
  ArchiveInfo info;
  for (const Layer& layer : archive.hypermap.layers()) info.layers.push_back(describe_layer(layer));
  describe_extensions(info, archive);
  const bool extended = info.layers.size() > archive.hypermap.layers().size() ||
                        archive.classes.size() > 0 || archive.provenance ||
                        !archive.foreign_extensions.empty();
  info.format_version = extended ? kArchiveFormatVersion : 0;
  info.classes.assign(archive.classes.names().begin(), archive.classes.names().end());
  const auto transforms = archive.hypermap.frames().transforms();
  info.transforms.assign(transforms.begin(), transforms.end());
  info.provenance = archive.provenance;
  return info;
}

}  // namespace hypermap
