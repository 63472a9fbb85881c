// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "export_parts.hpp"

namespace hypermap {

/// `<stem>.pgm` and `<stem>.yaml` for map_server: trinary, unturned unless asked.
/// Errors: those of without_rotation, write_trinary_map and write_file_atomically.
[[nodiscard]] Result<WrittenFiles> write_map_pair(const OccupancyLayer& layer,
                                                  const std::filesystem::path& stem,
                                                  bool keep_rotation);

}  // namespace hypermap
