// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the layers of an imported file come from.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/io/jobs/import_job.hpp"

namespace hypermap {

/// Name and hash of the file, and of all that it names; as option `import` (is_import) the layers
/// that it became, which `imported` has, and its frame.
/// Errors: those of reading, and of the descriptions that name further files.
[[nodiscard]] Result<Provenance> import_provenance(const ImportedFile& file,
                                                   FileKind kind,
                                                   const MapArchive& imported,
                                                   const ArchiveLimits& limits);

}  // namespace hypermap
