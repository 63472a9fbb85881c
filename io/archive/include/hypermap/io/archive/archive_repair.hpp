// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The map that a damaged archive still holds.
///
/// load_archive refuses an archive of which any part is wrong. Here each member is found by its own
/// header, each part is read by itself, and what cannot be read is left out and named.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

enum class RepairOutcome : std::uint8_t {
  kKept,      ///< As it was.
  kRepaired,  ///< There, with something mended or left out, which the note says.
  kRebuilt,   ///< Made anew from other parts.
  kLost,
};
/// "kept", "repaired", "rebuilt", "lost".
[[nodiscard]] std::string_view name_of(RepairOutcome outcome);

/// What became of a member or of a part of the map.
struct RepairNote {
  std::string subject;  ///< "member semantic", "layer semantic", "extension objects".
  RepairOutcome outcome = RepairOutcome::kKept;
  std::string what = {};  ///< Empty of what was kept as it was.
  friend bool operator==(const RepairNote&, const RepairNote&) = default;
};

/// A part that the configuration tells of and that could not be read.
struct LostPart {
  std::string name;
  std::string class_name;  ///< Of a layer; the format of an extension.
  friend bool operator==(const LostPart&, const LostPart&) = default;
};

struct RepairedArchive {
  MapArchive map;                 ///< Can be saved.
  std::vector<RepairNote> notes;  ///< Members in the order of the file, then parts.
  std::vector<LostPart> lost = {};
  /// Layers by name and class grids by class, lost or not, as the configuration lists them.
  std::vector<std::string> order = {};
  bool is_config_guessed = false;  ///< Parts that left no member are then not among the lost ones.

  /// Whether all was kept as it was.
  [[nodiscard]] bool is_unchanged() const;
};

/// Reads what can be read of an archive; the file is only read.
///
/// A lost configuration is made anew by the names and contents of members (frames other than `map`,
/// flags and unknown keys are then lost). Of an occupancy layer a missing or impossible threshold,
/// `negate`, `mode` or image's name becomes the usual one; of a semantic layer wrong shapes are
/// left out; classes that are spoken of and have no name are called class_<id>. What load_archive
/// mends itself is told too. Errors: those of salvage_zip; kMalformedFile when no layer, octree or
/// object is left; kUnsupported for an archive of a newer version; kIo; kOutOfMemory; kInterrupted.
[[nodiscard]] Result<RepairedArchive> repair_archive(
    const std::filesystem::path& path,
    const ArchiveLimits& limits = {},
    const LayerRegistry& layers = archive_layer_types(),
    const StopCheck& stop = {});

}  // namespace hypermap
