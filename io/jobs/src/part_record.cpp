// SPDX-License-Identifier: BSD-3-Clause
#include "part_record.hpp"

#include "content_hash.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPartVersion = 1;
constexpr std::size_t kMaxRecordBytes = std::size_t{1} << 20U;
constexpr std::array<std::string_view, 14> kRecordKeys{"format",
                                                       "version",
                                                       "program",
                                                       "input",
                                                       "settings",
                                                       "content",
                                                       "frames",
                                                       "skipped",
                                                       "objects",
                                                       "tentative",
                                                       "sessions",
                                                       "occupied",
                                                       "free",
                                                       "findings"};

struct PartCountKey {
  std::string_view name;
  std::uint64_t PartCounts::*count;
};
constexpr std::array<PartCountKey, 5> kPartCountKeys{{{"frames", &PartCounts::frames},
                                                      {"skipped", &PartCounts::skipped},
                                                      {"objects", &PartCounts::objects},
                                                      {"tentative", &PartCounts::tentative},
                                                      {"sessions", &PartCounts::sessions}}};

Result<std::string> record_text(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  return node.as_string();
}

Result<std::uint64_t> record_count(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t count,
                            node.as_int(0, std::numeric_limits<std::int64_t>::max()));
  return static_cast<std::uint64_t>(count);
}

Result<void> check_record_format(const YamlNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode format, root.at("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string name, format.as_string());
  if (name != kPartFormat) {
    return Unexpected(
        format.error("must be " + std::string(kPartFormat) + ", is " + printable(name),
                     ErrorCode::kUnsupported));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode version, root.at("version"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t number,
                            version.as_int(0, std::numeric_limits<std::int32_t>::max()));
  if (number == kPartVersion) return {};
  return Unexpected(
      version.error("must be 1, is " + std::to_string(number), ErrorCode::kUnsupported));
}

ValueTree part_count_tree(std::uint64_t count) {
  return {.kind = ValueKind::kScalar, .text = std::to_string(count)};
}

}  // namespace

std::vector<std::string> kept_findings(std::vector<std::string> findings) {
  if (findings.size() <= kMaxKeptFindings) return findings;
  const std::size_t num_more = findings.size() - kMaxKeptFindings;
  findings.resize(kMaxKeptFindings);
  findings.push_back("and " + std::to_string(num_more) + " more");
  return findings;
}

std::string write_part_record(const PartRecord& record) {
  std::vector<ValueTree::Entry> entries{
      {"format", make_text(std::string(kPartFormat))},
      {"version", part_count_tree(static_cast<std::uint64_t>(kPartVersion))},
      {"program", make_text(record.recipe.program)},
      {"input", make_text(record.recipe.input)},
      {"settings", make_text(record.recipe.settings)},
      {"content", make_text(record.content)}};
  for (const PartCountKey& key : kPartCountKeys) {
    entries.emplace_back(std::string(key.name), part_count_tree(record.counts.*key.count));
  }
  entries.emplace_back("occupied", part_count_tree(record.counts.leaves.occupied));
  entries.emplace_back("free", part_count_tree(record.counts.leaves.free));
  std::vector<ValueTree> findings;
  findings.reserve(record.findings.size());
  for (const std::string& finding : record.findings) findings.push_back(make_text(finding));
  entries.emplace_back("findings", make_list(std::move(findings)));
  return write_yaml(make_map(std::move(entries)));
}

Result<PartRecord> parse_part_record(std::string_view bytes, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document,
                            parse_yaml(bytes, source, {.max_bytes = kMaxRecordBytes}));
  const YamlNode root = document.root();
  HYPERMAP_TRY(check_record_format(root));
  HYPERMAP_TRY(root.refuse_other_keys(kRecordKeys, ErrorCode::kMalformedFile));
  PartRecord record;
  HYPERMAP_ASSIGN_OR_RETURN(record.recipe.program, record_text(root, "program"));
  HYPERMAP_ASSIGN_OR_RETURN(record.recipe.input, record_text(root, "input"));
  HYPERMAP_ASSIGN_OR_RETURN(record.recipe.settings, record_text(root, "settings"));
  HYPERMAP_ASSIGN_OR_RETURN(record.content, record_text(root, "content"));
  for (const PartCountKey& key : kPartCountKeys) {
    HYPERMAP_ASSIGN_OR_RETURN(record.counts.*key.count, record_count(root, key.name));
  }
  HYPERMAP_ASSIGN_OR_RETURN(record.counts.leaves.occupied, record_count(root, "occupied"));
  HYPERMAP_ASSIGN_OR_RETURN(record.counts.leaves.free, record_count(root, "free"));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode findings, root.at("findings"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, findings.as_list());
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string finding, item.as_string());
    record.findings.push_back(std::move(finding));
  }
  return record;
}

Result<PartRecord> read_part_record(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, kMaxRecordBytes));
  return parse_part_record(bytes, {.file = path.string()});
}

std::optional<std::string> reason_to_make(const PartFiles& files, const PartRecipe& recipe) {
  std::error_code failed;
  const bool is_there = fs::exists(files.part, failed);
  if (!failed && !is_there) return "";
  const auto record = read_part_record(files.record);
  if (!record) return "nothing says of what it was made";
  if (record->recipe.program != recipe.program) return "was made by " + record->recipe.program;
  if (record->recipe.input != recipe.input) return "was made of other data";
  if (record->recipe.settings != recipe.settings) return "was made with other options";
  const auto content = content_hash(files.part);
  if (!content) return "cannot be read";
  if (*content != record->content) return "is not as it was made";
  return std::nullopt;
}

Result<void> save_part_record(const PartFiles& files, PartRecord record) {
  HYPERMAP_ASSIGN_OR_RETURN(record.content, content_hash(files.part));
  return write_file_atomically(files.record, write_part_record(record));
}

}  // namespace hypermap
