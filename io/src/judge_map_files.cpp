// SPDX-License-Identifier: BSD-3-Clause
// Judges of maps and of what they are made of.
#include "file_judges.hpp"
#include "hypermap/io/octomap_file.hpp"
#include "hypermap/io/picture_file.hpp"

#include <utility>

namespace hypermap {

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

}  // namespace hypermap
