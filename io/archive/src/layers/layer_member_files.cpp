// SPDX-License-Identifier: BSD-3-Clause
#include "layer_member_files.hpp"

#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "layer_files.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hypermap {

MemberFileReader::MemberFileReader(ArchiveMembers& members,
                                   LayerFiles files,
                                   const ArchiveLimits& limits)
    : members_(members), files_(std::move(files)), limits_(limits) {
  last_source_ = members_.source_of(files_.stem);
}

Result<std::string> MemberFileReader::take(std::string_view suffix, std::uint64_t max_bytes) {
  const std::string name = files_.stem + std::string(suffix);
  last_source_ = members_.source_of(name);
  return members_.take(name, files_.owner, max_bytes);
}

void MemberFileReader::keep(std::vector<Finding> findings) {
  std::move(findings.begin(), findings.end(), std::back_inserter(findings_));
}

Result<std::string> MemberFileReader::bytes(std::string_view suffix) {
  return take(suffix, limits_.zip.max_entry_bytes);
}

Result<ValueTree> MemberFileReader::yaml(std::string_view suffix) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, take(suffix, limits_.max_text_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(YamlDocument document, parse_yaml(text, last_source_));
  return std::move(document.value);
}

Result<OccupancyLayer> MemberFileReader::grid(std::string_view suffix) {
  const std::string stem = files_.stem + std::string(suffix);
  last_source_ = members_.source_of(stem + ".yaml");
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_occupancy(members_, stem, files_.owner, limits_));
  keep(std::move(layer.findings));
  return std::move(layer.value);
}

Result<SemanticLayer> MemberFileReader::shapes(std::string_view suffix) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, take(suffix, limits_.max_shapes_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto layer,
                            parse_semantic_layer(text, last_source_, {}, members_.budget()));
  keep(std::move(layer.findings));
  return std::move(layer.value);
}

Result<void> MemberFileWriter::put(OpaqueFile file) {
  const auto same_name = [&file](const OpaqueFile& other) { return other.name == file.name; };
  if (std::any_of(files_.begin(), files_.end(), same_name))
    return fail(ErrorCode::kInvalidArgument, "is written twice", "member " + printable(file.name));
  files_.push_back(std::move(file));
  return {};
}

Result<void> MemberFileWriter::bytes(std::string_view suffix, std::string bytes) {
  return put({.name = member(suffix), .bytes = std::move(bytes)});
}

Result<void> MemberFileWriter::yaml(std::string_view suffix, const ValueTree& tree) {
  return put({.name = member(suffix), .bytes = write_yaml(tree)});
}

Result<void> MemberFileWriter::grid(std::string_view suffix, const OccupancyLayer& grid) {
  HYPERMAP_ASSIGN_OR_RETURN(auto files, write_occupancy(grid, member(suffix)));
  for (OpaqueFile& file : files) HYPERMAP_TRY(put(std::move(file)));
  return {};
}

Result<void> MemberFileWriter::shapes(std::string_view suffix, const SemanticLayer& shapes) {
  return put({.name = member(suffix), .bytes = write_semantic_layer(shapes)});
}

}  // namespace hypermap
