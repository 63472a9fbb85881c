// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A damaged archive as a new one: what it still holds, and what follows from that.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/archive_repair.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <filesystem>

namespace hypermap {

struct RepairJob {
  std::filesystem::path input;
  ArchiveLimits limits = {};
  StopCheck stop = {};
};

/// `repair_archive`, and of what it lost the layers `occupancy` and `semantic` and the class grids
/// made anew, where the octree is there (for `semantic` and class grids objects, too), by the
/// options of the map's newest run, or the default ones. In memory: nothing is written.
/// Errors: those of repair_archive.
[[nodiscard]] Result<RepairedArchive> run_repair(const RepairJob& job);

}  // namespace hypermap
