// SPDX-License-Identifier: BSD-3-Clause
// Checks of maps and of their parts.
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/places/topological_routes.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/embedding_file.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/point_cloud_file.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Rule 2 of [smap] 3.5.1, of the first object for which it does not hold; what is read obeys the
/// others.
std::optional<Finding> find_object_without_vertex(const MapArchive& archive,
                                                  const std::filesystem::path& path) {
  const TopologicalMap& map = *archive.topological_map;
  for (const Object& object : archive.objects.objects()) {
    const auto nearest = map.nearest(object.centroid_in_map);
    const auto broken = nearest ? broken_rules(map.options(),
                                               {&map.vertices()[nearest->value], 1},
                                               {},
                                               {&object.centroid_in_map, 1})
                                : std::vector<BrokenRule>{{.rule = 2, .what = "no vertex"}};
    if (broken.empty()) continue;
    return Finding{Severity::kWarning,
                   {.code = ErrorCode::kMalformedFile,
                    .what = "object " + std::to_string(object.id.value) +
                            " is not nearer than V_d to a vertex of the topological map",
                    .file = path.string(),
                    .field = "topological map"}};
  }
  return std::nullopt;
}

}  // namespace

Result<FileSummary> check_archive(const std::filesystem::path& path,
                                  const FileCheckOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded, load_archive(path, options.limits, archive_layer_types(), options.stop));
  std::string text = "archive of " + std::to_string(loaded.value.hypermap.layers().size()) +
                     " layer(s), " + std::to_string(loaded.value.objects.size()) + " object(s)";
  HYPERMAP_ASSIGN_OR_RETURN(const auto dimensions, embedding_dimensions(loaded.value.objects));
  for (const auto& [model, dimension] : dimensions.models()) {
    text += ", embeddings of " + printable(model) + " (" + std::to_string(dimension) + " numbers)";
  }
  if (loaded.value.topological_map) {
    text += ", topological map of " +
            std::to_string(loaded.value.topological_map->vertices().size()) + " vertices";
    if (auto finding = find_object_without_vertex(loaded.value, path)) {
      loaded.findings.push_back(std::move(*finding));
    }
  }
  return FileSummary{std::move(text), std::move(loaded.findings)};
}

Result<FileSummary> check_octree(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_octomap(path));
  return FileSummary{"octree of resolution " + std::to_string(loaded.value.resolution_m) + " m",
                     std::move(loaded.findings)};
}

Result<FileSummary> check_image(const std::filesystem::path& path, ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, read_image_file(path));
  const bool fits = (expected.width_px == 0 || image.width_px == expected.width_px) &&
                    (expected.height_px == 0 || image.height_px == expected.height_px);
  const std::string size = std::to_string(image.width_px) + " x " + std::to_string(image.height_px);
  if (!fits) {
    return fail(ErrorCode::kInvalidArgument,
                "is " + size + ", expected " + std::to_string(expected.width_px) + " x " +
                    std::to_string(expected.height_px),
                "size");
  }
  return FileSummary{size + ", " + std::to_string(image.channels) + " channel(s) of " +
                         std::to_string(image.bits) + " bit",
                     {}};
}

Result<FileSummary> check_map(const std::filesystem::path& path, const FileCheckOptions& options) {
  constexpr std::size_t kMaxTextBytes = std::size_t{16} << 20U;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxTextBytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto metadata, parse_map_metadata(text, SourceName{path.string()}));
  const std::filesystem::path image = path.parent_path() / metadata.value.image;
  std::error_code ec;
  const FileReach reach = options.limits.reach;
  const bool may_be_read = check_reach(reach, path.parent_path(), metadata.value.image).has_value();
  if (may_be_read && !std::filesystem::exists(image, ec)) {
    FileSummary out{"map without its image", std::move(metadata.findings)};
    out.findings.push_back({Severity::kWarning,
                            {.code = ErrorCode::kNotFound,
                             .what = "names " + printable(image.string()) + ", which is not there",
                             .file = path.string(),
                             .field = "image"}});
    return out;
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_map(path, MapDialect::kMapServer, reach));
  const GridGeometry& geometry = loaded.value.grid.geometry();
  return FileSummary{
      "map of " + std::to_string(geometry.cols) + " x " + std::to_string(geometry.rows) + " cells",
      std::move(loaded.findings)};
}

Result<FileSummary> check_semantic(const std::filesystem::path& path,
                                   const FileCheckOptions& options) {
  const LoadBudget budget(options.limits.sums, options.stop);
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_semantic_layer(path, {}, budget));
  return FileSummary{std::to_string(loaded.value.objects().size()) + " object(s)",
                     std::move(loaded.findings)};
}

Result<FileSummary> check_embedding(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const EmbeddingFile file, read_embedding_file(path));
  const std::string model = file.model ? " of " + printable(*file.model) : "";
  return FileSummary{"embedding" + model + " of " + std::to_string(file.vector.size()) + " numbers",
                     {}};
}

Result<FileSummary> check_cloud(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const LabelledPoints cloud, read_point_cloud(path));
  std::string summary = count_text(cloud.points.size(), "point");
  if (cloud.num_unmeasured > 0)
    summary += ", " + std::to_string(cloud.num_unmeasured) + " places without a measurement";
  const std::set<std::int64_t> labels(cloud.labels.begin(), cloud.labels.end());
  summary += cloud.labels.empty() ? ", no labels" : ", " + count_text(labels.size(), "label");
  return FileSummary{std::move(summary), {}};
}

}  // namespace hypermap
