// SPDX-License-Identifier: BSD-3-Clause
#include "declared_sizes.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "layers/layer_files.hpp"
#include "octree/octomap_header.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kHeaderBytes = std::size_t{1} << 12U;
constexpr std::size_t kMetadataBytes = std::size_t{1} << 16U;

class DeclaredSizes {
 public:
  DeclaredSizes(const ArchiveMembers& members, const BudgetLimits& limits)
      : members_(members), budget_(limits) {}

  [[nodiscard]] Result<void> add_grid(const std::string& stem) const {
    const std::string metadata_member = stem + ".yaml";
    const auto yaml = members_.start_of(metadata_member, kMetadataBytes);
    if (!yaml || yaml->size() == kMetadataBytes) return {};
    const auto metadata = parse_map_metadata(*yaml, {});
    if (!metadata) return {};
    const std::string image = image_member(metadata_member, metadata->value.image);
    const auto start = members_.start_of(image, kHeaderBytes);
    if (!start) return {};
    const auto header = read_image_header(*start, members_.source_of(image));
    return header ? named(budget_.draw_pixels(header->num_pixels()), image) : Result<void>();
  }

  [[nodiscard]] Result<void> add_octree(const std::string& member) const {
    const auto start = members_.start_of(member, kHeaderBytes);
    if (!start) return {};
    const auto header = parse_octomap_header(*start);
    return header ? named(budget_.draw_octree_nodes(header->num_nodes), member) : Result<void>();
  }

 private:
  [[nodiscard]] Result<void> named(Result<void> drawn, const std::string& member) const {
    if (drawn) return {};
    return tl::make_unexpected(with_source(std::move(drawn).error(), members_.source_of(member)));
  }

  const ArchiveMembers& members_;
  LoadBudget budget_;
};

bool is_grid(const LayerEntry& entry, const LayerRegistry& types) {
  const LayerType* type = types.find(entry.class_name);
  return entry.info.load_file && type != nullptr && type->empty.as<OccupancyLayer>() != nullptr;
}

}  // namespace

Result<void> check_declared_sizes(const ArchiveMembers& members,
                                  const HypermapConfig& config,
                                  const BudgetLimits& limits,
                                  const LayerRegistry& types) {
  const DeclaredSizes sizes(members, limits);
  for (const LayerEntry& entry : config.layers)
    if (is_grid(entry, types)) HYPERMAP_TRY(sizes.add_grid(stem_of(entry.info)));
  for (const ExtensionEntry& entry : config.extensions) {
    if (entry.format == kClassGridFormat) HYPERMAP_TRY(sizes.add_grid(entry.file));
    if (entry.format == kOctomapFormat) HYPERMAP_TRY(sizes.add_octree(entry.file));
  }
  return {};
}

}  // namespace hypermap
