// SPDX-License-Identifier: BSD-3-Clause
// Judges of maps and of what they are made of.
#include "file_judges.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/picture_file.hpp"

#include <system_error>
#include <utility>

namespace hypermap {

Result<Verdict> judge_archive(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, load_archive(path));
  return Verdict{"archive of " + std::to_string(loaded.value.hypermap.layers().size()) +
                     " layer(s), " + std::to_string(loaded.value.objects.size()) + " object(s)",
                 std::move(loaded.findings)};
}

Result<Verdict> judge_octree(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_octomap(path));
  return Verdict{"octree of resolution " + std::to_string(loaded.value.resolution_m) + " m",
                 std::move(loaded.findings)};
}

Result<Verdict> judge_image(const std::filesystem::path& path, PictureSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(const Picture picture, read_picture(path));
  const bool fits = (expected.width_px == 0 || picture.width_px == expected.width_px) &&
                    (expected.height_px == 0 || picture.height_px == expected.height_px);
  const std::string size =
      std::to_string(picture.width_px) + " x " + std::to_string(picture.height_px);
  if (!fits) {
    return fail(ErrorCode::kInvalidArgument,
                "is " + size + ", expected " + std::to_string(expected.width_px) + " x " +
                    std::to_string(expected.height_px),
                "size");
  }
  return Verdict{size + ", " + std::to_string(picture.channels) + " channel(s) of " +
                     std::to_string(picture.bits) + " bit",
                 {}};
}

Result<Verdict> judge_map(const std::filesystem::path& path) {
  constexpr std::size_t kMaxTextBytes = std::size_t{16} << 20U;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxTextBytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto metadata, parse_map_metadata(text, SourceName{path.string()}));
  const std::filesystem::path image = path.parent_path() / metadata.value.image;
  std::error_code ec;
  if (!std::filesystem::exists(image, ec)) {
    Verdict out{"map without its picture", std::move(metadata.findings)};
    out.findings.push_back({Severity::kWarning,
                            {.code = ErrorCode::kNotFound,
                             .what = "names " + printable(image.string()) + ", which is not there",
                             .file = path.string(),
                             .field = "image"}});
    return out;
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_map(path));
  const GridGeometry& geometry = loaded.value.grid.geometry();
  return Verdict{
      "map of " + std::to_string(geometry.cols) + " x " + std::to_string(geometry.rows) + " cells",
      std::move(loaded.findings)};
}

Result<Verdict> judge_semantic(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_semantic_layer(path));
  return Verdict{std::to_string(loaded.value.objects().size()) + " object(s)",
                 std::move(loaded.findings)};
}

}  // namespace hypermap
