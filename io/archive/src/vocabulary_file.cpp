// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/vocabulary_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kAliasesKey = "aliases";
constexpr std::string_view kSuperClassesKey = "super_classes";
constexpr std::array<std::string_view, 2> kVocabularyKeys{kAliasesKey, kSuperClassesKey};

/// The groups below a key of the document; none when it is not there.
Result<std::vector<VocabularyGroup>> groups_at(const YamlNode& root, std::string_view key) {
  std::vector<VocabularyGroup> groups;
  const auto node = root.find(key);
  if (!node) return groups;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node->as_map());
  groups.reserve(entries.size());
  for (const auto& [name, members] : entries) {
    VocabularyGroup& group =
        groups.emplace_back(VocabularyGroup{.name = {name, members.line()}, .members = {}});
    HYPERMAP_ASSIGN_OR_RETURN(const auto items, members.as_list());
    group.members.reserve(items.size());
    for (const YamlNode& item : items) {
      HYPERMAP_ASSIGN_OR_RETURN(std::string text, item.as_string());
      group.members.push_back({std::move(text), item.line()});
    }
  }
  return groups;
}

Result<ClassVocabulary> vocabulary_of(const YamlDocument& document) {
  const YamlNode root = document.root();
  HYPERMAP_TRY(root.refuse_other_keys(kVocabularyKeys, ErrorCode::kMalformedFile));
  VocabularyGroups groups;
  HYPERMAP_ASSIGN_OR_RETURN(groups.aliases, groups_at(root, kAliasesKey));
  HYPERMAP_ASSIGN_OR_RETURN(groups.super_classes, groups_at(root, kSuperClassesKey));
  auto vocabulary = ClassVocabulary::create(std::move(groups));
  if (vocabulary) return vocabulary;
  Error error = with_source(std::move(vocabulary).error(), document.source);
  if (error.code == ErrorCode::kInvalidArgument) error.code = ErrorCode::kMalformedFile;
  return Unexpected(std::move(error));
}

ValueTree tree_of(const std::vector<VocabularyGroup>& groups) {
  std::vector<ValueTree::Entry> entries;
  entries.reserve(groups.size());
  for (const VocabularyGroup& group : groups) {
    std::vector<ValueTree> names;
    names.reserve(group.members.size());
    for (const VocabularyName& member : group.members) names.push_back(make_text(member.text));
    entries.emplace_back(group.name.text, make_list(std::move(names)));
  }
  return make_map(std::move(entries));
}

}  // namespace

Result<ClassVocabulary> parse_vocabulary(std::string_view bytes, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source));
  return vocabulary_of(document);
}

Result<ClassVocabulary> read_vocabulary(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  return vocabulary_of(document);
}

std::string write_vocabulary(const ClassVocabulary& vocabulary) {
  std::vector<ValueTree::Entry> entries;
  entries.emplace_back(kAliasesKey, tree_of(vocabulary.groups().aliases));
  entries.emplace_back(kSuperClassesKey, tree_of(vocabulary.groups().super_classes));
  return write_yaml(make_map(std::move(entries)));
}

}  // namespace hypermap
