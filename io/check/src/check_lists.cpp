// SPDX-License-Identifier: BSD-3-Clause
// Checks of files that list: sequences, changes to shapes, tiles of a map.
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/semantic_update_file.hpp"
#include "hypermap/io/jobs/sequence_list.hpp"
#include "hypermap/io/jobs/tile_set.hpp"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

std::string entry_field(const char* list, std::size_t index, const char* key) {
  return list + ("[" + std::to_string(index) + "]." + key);
}

/// What a list names and nobody finds there.
void note_absent(const fs::path& named, std::string field, std::vector<Finding>& findings) {
  std::error_code unreadable;
  if (fs::exists(named, unreadable)) return;
  findings.push_back({Severity::kWarning,
                      {.code = ErrorCode::kNotFound,
                       .what = "names " + printable(named.string()) + ", which is not there",
                       .field = std::move(field)}});
}

void note_absent_files(const ListedSequence& sequence,
                       std::size_t index,
                       std::vector<Finding>& findings) {
  const auto field = [index](const char* key) { return entry_field("sequences", index, key); };
  note_absent(sequence.input, field("input"), findings);
  if (sequence.description) note_absent(*sequence.description, field("dataset"), findings);
  for (const fs::path& file : sequence.detections) note_absent(file, field("detections"), findings);
  if (sequence.poses) note_absent(*sequence.poses, field("poses"), findings);
}

}  // namespace

Result<FileSummary> check_sequences(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto sequences, read_sequence_list(path));
  FileSummary summary{count_text(sequences.size(), "sequence"), {}};
  for (std::size_t i = 0; i < sequences.size(); ++i)
    note_absent_files(sequences[i], i, summary.findings);
  return summary;
}

Result<FileSummary> check_update(const fs::path& path, const FileCheckOptions& options) {
  const LoadBudget budget(options.limits.sums, options.stop);
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_semantic_update(path, {}, budget));
  const SemanticUpdate& update = loaded.value;
  return FileSummary{std::to_string(update.to_add.size() + update.to_number.size()) + " to add, " +
                         std::to_string(update.to_modify.size()) + " to modify, " +
                         std::to_string(update.to_delete.size()) + " to delete",
                     std::move(loaded.findings)};
}

Result<FileSummary> check_tile_set(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const TileSet set, read_tile_set(path));
  FileSummary summary{"index of " + count_text(set.tiles.size(), "tile"), {}};
  for (std::size_t i = 0; i < set.tiles.size(); ++i)
    note_absent(set.folder / set.tiles[i].file, entry_field("tiles", i, "file"), summary.findings);
  return summary;
}

}  // namespace hypermap
