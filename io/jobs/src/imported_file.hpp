// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One file that is imported, as an archive of its own.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/import_job.hpp"

namespace hypermap {

/// The error names the file, unless it names one already.
[[nodiscard]] Unexpected about_file(const ImportedFile& file, Error error);

/// Whether it has what only one archive can bring: the others' ids would mean other objects and
/// classes.
[[nodiscard]] bool has_3d(const MapArchive& archive);

/// By the file's kind: its layer, by its name and in its frame, with its provenance, or all that an
/// archive has. Errors: those of run_import that are of one file.
[[nodiscard]] Result<Loaded<MapArchive>> import_file(const ImportedFile& file,
                                                     const ImportJob& job,
                                                     const LoadBudget& budget);

}  // namespace hypermap
