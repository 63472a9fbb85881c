// SPDX-License-Identifier: BSD-3-Clause
#include "merged_layers.hpp"

#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "merged_archives.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

Finding said(std::string what, std::string entry = {}) {
  return {Severity::kWarning,
          {.code = ErrorCode::kUnsupported, .what = std::move(what), .entry = std::move(entry)}};
}

const OctomapExtension* find_octomap(const MapArchive& map, std::string_view name) {
  const auto found = std::ranges::find(
      map.octomaps, name, [](const OctomapExtension& one) { return one.entry.name; });
  return found == map.octomaps.end() ? nullptr : &*found;
}

bool has_layer(const MapArchive& map, std::string_view name) {
  return map.hypermap.find(name) != nullptr || find_octomap(map, name) != nullptr;
}

/// The name that a layer gets. Errors: kInvalidArgument when that is taken, too.
Result<std::string> free_name(const MapArchive& map,
                              const std::string& layer,
                              const std::string& name) {
  if (!has_layer(map, layer)) return layer;
  std::string longer = name + "_" + layer;
  if (!has_layer(map, longer)) return longer;
  return Unexpected(
      Error{.code = ErrorCode::kInvalidArgument,
            .what = "another map has a layer of that name and one called " + printable(longer),
            .entry = layer});
}

Result<std::vector<Finding>> add_own_layers(MapArchive& map,
                                            const MapArchive& added,
                                            const std::string& name) {
  std::vector<Finding> findings;
  for (const Layer& layer : added.hypermap.layers()) {
    if (is_derived(layer)) continue;
    const Layer* known = map.hypermap.find(layer.info.name);
    if (known != nullptr && *known == layer) continue;
    Layer one = layer;
    HYPERMAP_ASSIGN_OR_RETURN(one.info.name, free_name(map, layer.info.name, name));
    one.info.file = std::nullopt;
    if (one.info.name != layer.info.name) {
      findings.push_back(said(
          "is called " + printable(one.info.name) + " now: another map has a layer of its name",
          layer.info.name));
    }
    HYPERMAP_TRY(map.hypermap.add_layer(std::move(one)));
  }
  return findings;
}

Result<std::vector<Finding>> add_octomaps(MapArchive& map,
                                          std::vector<OctomapExtension> octomaps,
                                          const std::string& name) {
  std::vector<Finding> findings;
  for (OctomapExtension& octomap : octomaps) {
    const OctomapExtension* known = find_octomap(map, octomap.entry.name);
    if (known != nullptr && known->bytes == octomap.bytes) continue;
    const std::string before = octomap.entry.name;
    HYPERMAP_ASSIGN_OR_RETURN(octomap.entry.name, free_name(map, before, name));
    if (octomap.entry.name != before) {
      octomap.entry.file = name + "_" + octomap.entry.file;
      findings.push_back(said("is called " + printable(octomap.entry.name) +
                                  " now: another map has a layer of its name",
                              before));
    }
    map.octomaps.push_back(std::move(octomap));
  }
  return findings;
}

Result<void> add_frames(Hypermap& hypermap, const FrameTree& frames) {
  for (const FrameTransform& transform : frames.transforms()) {
    if (std::ranges::find(hypermap.frames().transforms(), transform) !=
        hypermap.frames().transforms().end()) {
      continue;
    }
    HYPERMAP_TRY(hypermap.frames().add(transform));
  }
  return {};
}

void append_to(std::vector<Finding>& findings, std::vector<Finding> more) {
  findings.insert(findings.end(), more.begin(), more.end());
}

}  // namespace

bool is_derived(const Layer& layer) {
  constexpr std::array<std::string_view, 3> kDerived{"occupancy", kSemanticLayer, kStackLayer};
  return std::ranges::find(kDerived, layer.info.name) != kDerived.end();
}

Result<std::vector<Finding>> add_layers(MapArchive& map,
                                        MapArchive added,
                                        const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(auto findings, add_own_layers(map, added, name));
  HYPERMAP_ASSIGN_OR_RETURN(auto renamed, add_octomaps(map, std::move(added.octomaps), name));
  append_to(findings, std::move(renamed));
  HYPERMAP_TRY(add_frames(map.hypermap, added.hypermap.frames()));
  if (map.vocabulary.empty()) {
    map.vocabulary = std::move(added.vocabulary);
  } else if (!added.vocabulary.empty() && added.vocabulary != map.vocabulary) {
    findings.push_back(said("its names of classes are left out: another map has others"));
  }
  if (added.true_surfaces) findings.push_back(said("its true surfaces are left out"));
  if (!added.opaque_files.empty() || !added.foreign_extensions.empty()) {
    findings.push_back(said("members that nobody knows are left out"));
  }
  return findings;
}

}  // namespace hypermap
