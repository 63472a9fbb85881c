// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/vocabulary/class_vocabulary.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <deque>
#include <utility>

namespace hypermap {
namespace {

Unexpected refuse_name(const VocabularyName& name,
                       const std::string& what,
                       const std::string& field,
                       ErrorCode code = ErrorCode::kInvalidArgument) {
  return Unexpected(Error{.code = code, .what = what, .field = field, .line = name.line});
}

std::string quoted_name(std::string_view name) {
  return "\"" + printable(name) + "\"";
}

Result<void> check_vocabulary_name(const VocabularyName& name, const std::string& field) {
  const std::string& text = name.text;
  if (text.empty()) return refuse_name(name, "a name must not be empty", field);
  if (text.size() > ClassVocabulary::kMaxNameBytes) {
    return refuse_name(
        name,
        "names of at most 256 bytes are read, one has " + std::to_string(text.size()),
        field,
        ErrorCode::kLimit);
  }
  if (first_bad_utf8(text) == text.size() && text.find('\0') == std::string::npos) return {};
  return refuse_name(name, "a name must be UTF-8 without NUL, is " + quoted_name(text), field);
}

/// All names of the groups; a group that stands there twice is refused.
Result<std::size_t> check_groups(const std::vector<VocabularyGroup>& groups,
                                 const std::string& key) {
  std::size_t count = 0;
  std::set<std::string> seen;
  for (const VocabularyGroup& group : groups) {
    const std::string field = key + "." + printable(group.name.text);
    HYPERMAP_TRY(check_vocabulary_name(group.name, key));
    if (!seen.insert(canonical_class_name(group.name.text)).second) {
      return refuse_name(group.name, "stands there twice, in another spelling", field);
    }
    for (const VocabularyName& member : group.members) {
      HYPERMAP_TRY(check_vocabulary_name(member, field));
    }
    count += 1 + group.members.size();
  }
  return count;
}

template <class Map>
const typename Map::mapped_type& entry_or_empty(const Map& map, const std::string& key) {
  static const typename Map::mapped_type kNone{};
  const auto found = map.find(key);
  return found == map.end() ? kNone : found->second;
}

}  // namespace

Result<void> ClassVocabulary::add_aliases(const VocabularyGroup& group) {
  const std::string field = "aliases." + printable(group.name.text);
  const std::string class_name = canonical_class_name(group.name.text);
  shown_.emplace(class_name, group.name.text);
  for (const VocabularyName& alias : group.members) {
    const std::string name = canonical_class_name(alias.text);
    if (name == class_name) continue;
    const auto [known, is_new] = class_of_.emplace(name, class_name);
    if (!is_new) {
      const bool is_twice = known->second == class_name;
      return refuse_name(
          alias,
          quoted_name(alias.text) +
              (is_twice ? " stands there twice"
                        : " is an alias of " + quoted_name(shown_.at(known->second)) + " already"),
          field);
    }
    shown_.emplace(name, alias.text);
    aliases_[class_name].push_back(name);
  }
  return {};
}

Result<void> ClassVocabulary::add_super_class(const VocabularyGroup& group) {
  const std::string field = "super_classes." + printable(group.name.text);
  const auto refuse_alias = [&](const VocabularyName& name) -> Result<void> {
    const auto alias = class_of_.find(canonical_class_name(name.text));
    if (alias == class_of_.end()) return {};
    return refuse_name(name,
                       quoted_name(name.text) + " is an alias of " +
                           quoted_name(shown_.at(alias->second)) + ": that class must stand here",
                       field);
  };
  HYPERMAP_TRY(refuse_alias(group.name));
  const std::string super_class = canonical_class_name(group.name.text);
  shown_.emplace(super_class, group.name.text);
  auto& members = members_[super_class];
  std::set<std::string> seen;
  for (const VocabularyName& member : group.members) {
    HYPERMAP_TRY(refuse_alias(member));
    const std::string name = canonical_class_name(member.text);
    if (!seen.insert(name).second) {
      return refuse_name(member, quoted_name(member.text) + " stands there twice", field);
    }
    shown_.emplace(name, member.text);
    members.push_back({name, member.line});
    super_classes_[name].push_back(super_class);
  }
  return {};
}

// NOLINTNEXTLINE(misc-no-recursion): the path is at most kMaxSuperClasses + 1 long
Result<std::size_t> ClassVocabulary::height(const VocabularyName& name,
                                            Names& path,
                                            std::map<std::string, std::size_t>& known) const {
  const auto done = known.find(name.text);
  const std::size_t so_far = path.size();
  const auto limit = [&]() -> Result<std::size_t> {
    return refuse_name(name,
                       "at most 16 super-classes may stand one above the other, more do above " +
                           quoted_name(shown_.at(name.text)),
                       "super_classes." + printable(shown_.at(path.front())),
                       ErrorCode::kLimit);
  };
  if (done != known.end()) {
    if (so_far + done->second > kMaxSuperClasses + 1) return limit();
    return done->second;
  }
  const auto above = std::find(path.begin(), path.end(), name.text);
  if (above != path.end()) {
    std::string circle;
    for (auto one = above; one != path.end(); ++one) circle += shown_.at(*one) + " > ";
    return refuse_name(
        name,
        "super-classes form a circle: " + printable(circle + shown_.at(name.text), 2000),
        "super_classes." + printable(shown_.at(path.back())));
  }
  if (so_far > kMaxSuperClasses) return limit();
  std::size_t below = 0;
  path.push_back(name.text);
  for (const VocabularyName& member : entry_or_empty(members_, name.text)) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::size_t one, height(member, path, known));
    below = std::max(below, one);
  }
  path.pop_back();
  known.emplace(name.text, below + 1);
  return below + 1;
}

Result<ClassVocabulary> ClassVocabulary::create(VocabularyGroups groups) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t num_aliases, check_groups(groups.aliases, "aliases"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t num_members,
                            check_groups(groups.super_classes, "super_classes"));
  if (num_aliases + num_members > kMaxNames) {
    return fail(ErrorCode::kLimit,
                "at most 20000 names are kept, has " + std::to_string(num_aliases + num_members));
  }
  ClassVocabulary vocabulary;
  for (const VocabularyGroup& group : groups.aliases) HYPERMAP_TRY(vocabulary.add_aliases(group));
  for (const VocabularyGroup& group : groups.aliases) {
    const auto alias = vocabulary.class_of_.find(canonical_class_name(group.name.text));
    if (alias == vocabulary.class_of_.end()) continue;
    return refuse_name(group.name,
                       "is an alias of " + quoted_name(vocabulary.shown_.at(alias->second)) +
                           ", and has aliases of its own",
                       "aliases." + printable(group.name.text));
  }
  for (const VocabularyGroup& group : groups.super_classes) {
    HYPERMAP_TRY(vocabulary.add_super_class(group));
  }
  std::map<std::string, std::size_t> heights;
  for (const VocabularyGroup& group : groups.super_classes) {
    Names path;
    HYPERMAP_TRY(
        vocabulary.height({canonical_class_name(group.name.text), group.name.line}, path, heights));
  }
  vocabulary.groups_ = std::move(groups);
  return vocabulary;
}

bool ClassVocabulary::knows(std::string_view name) const {
  return shown_.contains(canonical_class_name(name));
}

bool ClassVocabulary::is_super_class(std::string_view name) const {
  return members_.contains(class_of(name));
}

std::string ClassVocabulary::class_of(std::string_view name) const {
  std::string canonical = canonical_class_name(name);
  const auto alias = class_of_.find(canonical);
  return alias == class_of_.end() ? canonical : alias->second;
}

std::string ClassVocabulary::shown_class(std::string_view name) const {
  const auto shown = shown_.find(class_of(name));
  return shown == shown_.end() ? std::string(name) : shown->second;
}

std::vector<std::string> ClassVocabulary::same_names(std::string_view name) const {
  const std::string class_name = class_of(name);
  Names names = entry_or_empty(aliases_, class_name);
  names.push_back(class_name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> ClassVocabulary::names_of(std::string_view name) const {
  std::set<std::string> names;
  std::deque<std::string> open{class_of(name)};
  while (!open.empty()) {
    const std::string one = std::move(open.front());
    open.pop_front();
    if (!names.insert(one).second) continue;
    for (const std::string& alias : entry_or_empty(aliases_, one)) names.insert(alias);
    for (const VocabularyName& member : entry_or_empty(members_, one)) {
      open.push_back(member.text);
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> ClassVocabulary::super_classes_of(std::string_view name) const {
  std::vector<std::string> above;
  std::deque<std::string> open{class_of(name)};
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string one = std::move(open.front());
    open.pop_front();
    for (const std::string& super_class : entry_or_empty(super_classes_, one)) {
      if (!seen.insert(super_class).second) continue;
      above.push_back(super_class);
      open.push_back(super_class);
    }
  }
  return above;
}

std::vector<std::string> ClassVocabulary::all_names() const {
  std::vector<std::string> names;
  names.reserve(shown_.size());
  for (const auto& [canonical, shown] : shown_) names.push_back(shown);
  return names;
}

}  // namespace hypermap
