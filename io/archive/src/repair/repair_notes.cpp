// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_repair.hpp"
#include "repair_text.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {

std::string text_of(Error error) {
  error.file = std::exchange(error.entry, "");
  return to_string(error);
}

std::string text_of(std::span<const Finding> findings) {
  std::string text;
  for (const Finding& finding : findings)
    text += (text.empty() ? "" : "; ") + text_of(finding.error);
  return text;
}

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
