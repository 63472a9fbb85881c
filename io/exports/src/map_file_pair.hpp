// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "export_parts.hpp"

#include <filesystem>
#include <string>

namespace hypermap {

struct NamedBytes {
  std::string name;
  std::string bytes;
};

/// A map of map_server as files of one folder.
struct MapFileSet {
  NamedBytes yaml;
  NamedBytes image;  ///< Which the YAML names, after its content.
  NamedBytes world;
};

/// `<stem>.yaml`, the image `<stem>-<hash of the image>.pgm` and its world file, `.pgw`: trinary,
/// unturned unless asked. Errors: those of without_rotation and write_trinary_map.
[[nodiscard]] Result<MapFileSet> map_files(const OccupancyLayer& layer,
                                           const std::string& stem,
                                           bool keep_rotation);

/// The image that a YAML names where both are such a pair; empty where they are not.
/// Errors: kIo when the YAML cannot be read; kLimit when it is too large for one.
[[nodiscard]] Result<std::string> image_of_pair(const std::filesystem::path& yaml);

/// map_files of the stem's name in the stem's folder. The YAML is replaced last; then the image
/// that the old one named is removed when an export to this stem wrote it. Errors: those of
/// without_rotation, write_trinary_map and write_file_atomically; until the YAML is replaced the
/// old pair stays whole.
[[nodiscard]] Result<WrittenFiles> write_map_pair(const OccupancyLayer& layer,
                                                  const std::filesystem::path& stem,
                                                  bool keep_rotation);

}  // namespace hypermap
