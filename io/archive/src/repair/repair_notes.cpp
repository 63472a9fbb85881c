// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_repair.hpp"

#include <algorithm>

namespace hypermap {

std::string_view name_of(RepairOutcome outcome) {
  switch (outcome) {
    case RepairOutcome::kKept:
      return "kept";
    case RepairOutcome::kRepaired:
      return "repaired";
    case RepairOutcome::kRebuilt:
      return "rebuilt";
    case RepairOutcome::kLost:
      break;
  }
  return "lost";
}

bool RepairedArchive::is_unchanged() const {
  return std::ranges::all_of(
      notes, [](const RepairNote& note) { return note.outcome == RepairOutcome::kKept; });
}

}  // namespace hypermap
