// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_server.hpp"

#include "hypermap/io/archive/hashed_image_name.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"

#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

/// One pixel as its readers see it. Sums stay whole numbers, so that thresholds compare exactly.
struct Shade {
  double colors = 0.0;  ///< Sum over the colour channels.
  double full = 1.0;    ///< What that sum is for white.
  double alpha = 0.0;   ///< Of one channel; `white` when there is none.
  double white = 1.0;   ///< Of one channel.
  bool has_alpha = false;
};

Shade shade_of(const DecodedImage& image, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t num_colors = channels - (image.has_alpha() ? 1 : 0);
  const auto sample = [&](std::size_t c) {
    const std::size_t at = pixel * channels + c;
    const int value = image.bits == 8 ? int{image.samples8[at]} : int{image.samples16[at]};
    return static_cast<double>(value);
  };
  Shade shade{.full = static_cast<double>(num_colors) * image.max_value,
              .white = static_cast<double>(image.max_value),
              .has_alpha = image.has_alpha()};
  for (std::size_t c = 0; c < num_colors; ++c) shade.colors += sample(c);
  shade.alpha = shade.has_alpha ? sample(num_colors) : shade.white;
  return shade;
}

bool is_transparent(const Shade& shade) {
  return shade.alpha < shade.white;
}

/// Source: [hypermap] 3.3.5; `in_between` gives the occupancy for r in [0, 1].
template <class InBetween>
std::int8_t by_thresholds(double sum,
                          double full,
                          const MapMetadata& metadata,
                          const InBetween& in_between) {
  const double p = (metadata.negate ? sum : full - sum) / full;
  if (p > metadata.occupied_thresh) return kOccupiedCell;
  if (p < metadata.free_thresh) return kFreeCell;
  if (metadata.mode == MapMode::kTrinary) return kUnknownCell;
  const double width = metadata.occupied_thresh - metadata.free_thresh;
  return in_between(width > 0.0 ? (p - metadata.free_thresh) / width : 0.0);
}

/// The grey value as a byte, negated if asked.
int raw_value(const Shade& shade, const MapMetadata& metadata) {
  const int value = static_cast<int>(std::lround(255.0 * shade.colors / shade.full));
  return metadata.negate ? 255 - value : value;
}

std::int8_t raw_cell(const Shade& shade, const MapMetadata& metadata) {
  const int value = raw_value(shade, metadata);
  return value <= kOccupiedCell ? static_cast<std::int8_t>(value) : kUnknownCell;
}

std::int8_t hypermap_cell(const Shade& shade, const MapMetadata& metadata) {
  if (is_transparent(shade)) return kUnknownCell;
  if (metadata.mode == MapMode::kRaw) return raw_cell(shade, metadata);
  return by_thresholds(shade.colors, shade.full, metadata, [](double r) {
    return static_cast<std::int8_t>(std::lround(100.0 * r));
  });
}

std::int8_t map_server_cell(const Shade& shade, const MapMetadata& metadata) {
  if (metadata.mode == MapMode::kRaw) return raw_cell(shade, metadata);
  if (metadata.mode == MapMode::kScale && is_transparent(shade)) return kUnknownCell;
  const bool averages_alpha = metadata.mode == MapMode::kTrinary && shade.has_alpha;
  const double sum = shade.colors + (averages_alpha ? shade.alpha : 0.0);
  const double full = shade.full + (averages_alpha ? shade.white : 0.0);
  return by_thresholds(
      sum, full, metadata, [](double r) { return static_cast<std::int8_t>(99.0 * r); });
}

/// Raw values that are no occupancy and not 255, which a signed byte reads as -1.
std::size_t count_odd_raw_values(const DecodedImage& image, const MapMetadata& metadata) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.num_pixels(); ++i) {
    const Shade shade = shade_of(image, i);
    const int value = raw_value(shade, metadata);
    if (!is_transparent(shade) && value > kOccupiedCell && value < 255) ++count;
  }
  return count;
}

std::vector<Finding> findings_of(const DecodedImage& image,
                                 const MapMetadata& metadata,
                                 MapDialect dialect) {
  if (metadata.mode != MapMode::kRaw || dialect != MapDialect::kHypermap) return {};
  const std::size_t odd = count_odd_raw_values(image, metadata);
  if (odd == 0) return {};
  return {{.severity = Severity::kWarning,
           .error = {.code = ErrorCode::kMalformedFile,
                     .what = std::to_string(odd) + " raw values of 101 to 254 are read as unknown",
                     .field = "mode"}}};
}

GridGeometry geometry_of(const DecodedImage& image, const MapMetadata& metadata) {
  return {.resolution_m = metadata.resolution_m,
          .origin = {metadata.origin[0], metadata.origin[1]},
          .yaw_rad = metadata.origin[2],
          .cols = image.width_px,
          .rows = image.height_px};
}

/// A name that says what is in the image, yet of another content.
std::optional<Finding> other_content(const std::filesystem::path& path, std::string_view image) {
  const std::string name = path.filename().string();
  const auto stem = stem_of_hashed_name(name);
  if (!stem) return std::nullopt;
  const std::string real = hashed_image_name(*stem, image);
  if (real == name) return std::nullopt;
  return Finding{.error = {.code = ErrorCode::kMalformedFile,
                           .what = "is not the image that its name says, that would be " +
                                   printable(real) + ": it was damaged, or changed and not renamed",
                           .file = path.string()}};
}

}  // namespace

Result<Loaded<OccupancyGrid>> grid_from_image(const DecodedImage& image,
                                              const MapMetadata& metadata,
                                              MapDialect dialect,
                                              const LoadBudget& budget) {
  const GridGeometry geometry = geometry_of(image, metadata);
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid, OccupancyGrid::create(geometry));
  const auto cell_of = dialect == MapDialect::kHypermap ? hypermap_cell : map_server_cell;
  for (int row = 0; row < geometry.rows; ++row) {
    HYPERMAP_TRY(budget.check_stop());
    const auto top_row = static_cast<std::size_t>(geometry.rows - 1 - row);
    for (int col = 0; col < geometry.cols; ++col) {
      const std::size_t pixel =
          top_row * static_cast<std::size_t>(geometry.cols) + static_cast<std::size_t>(col);
      grid.set({col, row}, cell_of(shade_of(image, pixel), metadata));
    }
  }
  return Loaded<OccupancyGrid>{std::move(grid), findings_of(image, metadata, dialect)};
}

Result<Loaded<OccupancyLayer>> read_map(const std::filesystem::path& yaml_path,
                                        MapDialect dialect,
                                        FileReach reach,
                                        const LoadBudget& budget) {
  const SourceName source{.file = yaml_path.string()};
  HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml, read_file(yaml_path, YamlLimits{}.max_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(Loaded<MapMetadata> metadata, parse_map_metadata(yaml, source));
  const std::filesystem::path folder = yaml_path.parent_path();
  if (auto within = check_reach(reach, folder, metadata.value.image); !within) {
    within.error().field = "image";
    return tl::make_unexpected(with_source(std::move(within).error(), source));
  }
  const std::filesystem::path image_path = folder / metadata.value.image;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            read_file(image_path, ImageLimits().max_file_bytes));
  const SourceName of_image{.file = image_path.string()};
  if (const auto header = read_image_header(bytes, of_image)) {
    if (const auto drawn = budget.draw_pixels(header->num_pixels()); !drawn) {
      return tl::make_unexpected(with_source(drawn.error(), of_image));
    }
  }
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, decode_image(bytes, of_image));
  auto grid = grid_from_image(image, metadata.value, dialect, budget);
  if (!grid) return tl::make_unexpected(with_source(grid.error(), source));
  std::vector<Finding> findings = std::move(metadata.findings);
  if (auto other = other_content(image_path, bytes)) findings.push_back(std::move(*other));
  for (Finding& finding : grid->findings) {
    findings.push_back({finding.severity, with_source(finding.error, source)});
  }
  return Loaded<OccupancyLayer>{
      OccupancyLayer(std::move(grid->value), std::move(metadata.value.extra)), std::move(findings)};
}

}  // namespace hypermap
