// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/repair_job.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kOccupancy = "occupancy";

/// As far as the map tells by which options it was made. Options that this version does not know
/// keep their defaults.
MapOptions options_of(const MapArchive& map) {
  MapOptions options;
  if (map.provenance.empty()) return options;
  for (const auto& [name, value] : map.provenance.back().options.entries) {
    if (auto changed = with_option(options, name, value.text)) options = std::move(*changed);
  }
  return options;
}

/// Parts that every map of ours has, where a configuration that was guessed cannot tell.
std::vector<LostPart> usual_parts(const MapArchive& map) {
  std::vector<LostPart> parts;
  const std::pair<std::string_view, std::string_view> layers[] = {
      {kOccupancy, "OccupancyGridLayer"}, {kSemanticLayer, "SemanticLayer"}};
  for (const auto& [name, class_name] : layers) {
    if (map.hypermap.find(name) == nullptr)
      parts.push_back({.name = std::string(name), .class_name = std::string(class_name)});
  }
  return parts;
}

/// Puts parts of a map with all derived layers into the repaired one.
class Rebuilder {
 public:
  Rebuilder(RepairedArchive& repaired, const MapArchive& derived)
      : repaired_(repaired), derived_(derived) {}

  /// Whether the part is there now.
  bool take(const LostPart& part) {
    return part.class_name == kClassGridFormat ? take_grid(part.name) : take_layer(part);
  }

  void take_all_grids() {
    for (const ClassGrid& grid : derived_.class_grids) take_grid(grid.class_name);
  }

 private:
  bool take_layer(const LostPart& part) {
    const Layer* layer = derived_.hypermap.find(part.name);
    const bool is_derived = part.name == kOccupancy || part.name == kSemanticLayer;
    if (layer == nullptr || !is_derived || class_of(*layer) != part.class_name) return false;
    if (!repaired_.map.hypermap.put_layer(*layer)) return false;
    tell("layer " + part.name);
    return true;
  }

  bool take_grid(const std::string& class_name) {
    const auto found = std::ranges::find(derived_.class_grids, class_name, &ClassGrid::class_name);
    if (found == derived_.class_grids.end()) return false;
    repaired_.map.class_grids.push_back(*found);
    tell("class grid " + printable(class_name));
    return true;
  }

  void tell(std::string subject) {
    repaired_.notes.push_back(
        {std::move(subject), RepairOutcome::kRebuilt, "from octree and objects"});
  }

  RepairedArchive& repaired_;
  const MapArchive& derived_;
};

/// Parts that came back stand where they stood.
void restore_order(RepairedArchive& repaired) {
  const auto place_of = [&](const std::string& name) {
    return std::ranges::find(repaired.order, name) - repaired.order.begin();
  };
  std::ranges::stable_sort(repaired.map.class_grids, {}, [&](const ClassGrid& grid) {
    return place_of(grid.class_name);
  });
  // Names that count them are chosen anew when they are saved.
  for (ClassGrid& grid : repaired.map.class_grids) {
    for (std::string* name : {&grid.name, &grid.file})
      if (name->starts_with("class_grid_")) name->clear();
  }
  const auto layers = repaired.map.hypermap.layers();
  std::vector<Layer> ordered(layers.begin(), layers.end());
  std::ranges::stable_sort(
      ordered, {}, [&](const Layer& layer) { return place_of(layer.info.name); });
  // Their names were unique before.
  for (const Layer& layer : ordered) {
    repaired.map.hypermap.remove_layer(layer.info.name);
    if (!repaired.map.hypermap.add_layer(layer)) return;
  }
}

/// Makes anew what follows from the rest.
void rebuild_lost(RepairedArchive& repaired) {
  if (!repaired.map.octree) return;
  std::vector<LostPart> wanted = repaired.lost;
  if (repaired.is_config_guessed) {
    const auto usual = usual_parts(repaired.map);
    wanted.insert(wanted.end(), usual.begin(), usual.end());
  }
  if (wanted.empty() && !repaired.is_config_guessed) return;
  MapOptions options = options_of(repaired.map);
  options.layers.floor_m.reset();  // it moves with the map, its options do not
  MapArchive derived = repaired.map;
  if (!derive_layers(derived, options.mapper.objects, options.layers)) return;
  repaired.map.floor = derived.floor;
  const bool has_objects = !repaired.map.objects.empty();
  Rebuilder rebuilder(repaired, derived);
  std::vector<LostPart> lost;
  for (LostPart& part : wanted) {
    const bool needs_objects = part.name != kOccupancy;
    if ((needs_objects && !has_objects) || !rebuilder.take(part)) lost.push_back(std::move(part));
  }
  if (repaired.is_config_guessed && has_objects && repaired.map.class_grids.empty())
    rebuilder.take_all_grids();
  repaired.lost = std::move(lost);
  restore_order(repaired);
}

}  // namespace

Result<RepairedArchive> run_repair(const RepairJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(auto repaired,
                            repair_archive(job.input, job.limits, archive_layer_types(), job.stop));
  rebuild_lost(repaired);
  return repaired;
}

}  // namespace hypermap
