// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "export_parts.hpp"

namespace hypermap {

/// `<stem>.yaml` for map_server and the image that it names, `<stem>-<hash of the image>.pgm`:
/// trinary, unturned unless asked; beside the image its world file, `.pgw`. The YAML is replaced
/// last; then the image that the old one named is removed when an export to this stem wrote it.
/// Errors: those of without_rotation, write_trinary_map and write_file_atomically; until the YAML
/// is replaced the old pair stays whole.
[[nodiscard]] Result<WrittenFiles> write_map_pair(const OccupancyLayer& layer,
                                                  const std::filesystem::path& stem,
                                                  bool keep_rotation);

}  // namespace hypermap
