// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/vocabulary/asked_names.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "vocabulary/name_expression.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// As a text is written.
enum class AskedForm { kName, kPrefix, kExpression };

bool is_known_name(std::string_view text,
                   std::span<const std::string> known,
                   const ClassVocabulary& vocabulary) {
  return vocabulary.knows(text) || std::ranges::any_of(known, [&](const std::string& name) {
           return is_spelling_of(name, text);
         });
}

AskedForm form_of(std::string_view text,
                  std::span<const std::string> known,
                  const ClassVocabulary& vocabulary) {
  if (is_known_name(text, known, vocabulary)) return AskedForm::kName;
  if (text.ends_with('*')) return AskedForm::kPrefix;
  const bool is_between_slashes = text.size() > 2 && text.starts_with('/') && text.ends_with('/');
  return is_between_slashes ? AskedForm::kExpression : AskedForm::kName;
}

std::string_view without_star(std::string_view text) {
  return text.substr(0, text.size() - 1);
}

std::string_view without_slashes(std::string_view text) {
  return text.substr(1, text.size() - 2);
}

class PrefixTest {
 public:
  explicit PrefixTest(std::string_view prefix) : prefix_(folded_class_name(prefix)) {}
  [[nodiscard]] Result<bool> operator()(const std::string& name) const {
    return folded_class_name(name).starts_with(prefix_) ||
           canonical_class_name(name).starts_with(prefix_);
  }

 private:
  std::string prefix_;
};

/// All that the names mean for which `test` holds.
template <class Test>
Result<NameSelection> names_that(const Test& test,
                                 std::span<const std::string> known,
                                 const ClassVocabulary& vocabulary) {
  std::set<std::string> canonical;
  const auto add = [&](const std::string& name) -> Result<void> {
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_meant, test(name));
    if (!is_meant) return {};
    for (std::string& one : vocabulary.names_of(name)) canonical.insert(std::move(one));
    return {};
  };
  for (const std::string& name : known) HYPERMAP_TRY(add(name));
  for (const std::string& name : vocabulary.all_names()) HYPERMAP_TRY(add(name));
  return NameSelection::of_canonical({canonical.begin(), canonical.end()});
}

constexpr std::size_t kMostListed = 100;

/// "a, b", when they are few enough to look one up; else nothing.
std::string listed_names(std::span<const std::string> names) {
  std::string text;
  if (names.size() > kMostListed) return text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text;
}

std::string list_in_parentheses(std::span<const std::string> names) {
  const std::string list = listed_names(names);
  return list.empty() ? list : " (" + list + ")";
}

std::string joined_after_colon(std::span<const std::string> names) {
  const std::string list = listed_names(names);
  return list.empty() ? list : ": " + list;
}

}  // namespace

Result<NameSelection> asked_names(std::string_view text,
                                  std::span<const std::string> known,
                                  const ClassVocabulary& vocabulary) {
  switch (form_of(text, known, vocabulary)) {
    case AskedForm::kPrefix:
      return names_that(PrefixTest(without_star(text)), known, vocabulary);
    case AskedForm::kExpression: {
      HYPERMAP_ASSIGN_OR_RETURN(const NameExpression expression,
                                NameExpression::create(without_slashes(text)));
      const auto is_match = [&](const std::string& name) { return expression.matches(name); };
      return names_that(is_match, known, vocabulary);
    }
    case AskedForm::kName:
      break;
  }
  return NameSelection::of_canonical(vocabulary.names_of(text));
}

std::string nothing_asked(std::string_view text,
                          std::span<const std::string> known,
                          const ClassVocabulary& vocabulary,
                          std::string_view subject) {
  std::string said(subject);
  switch (form_of(text, known, vocabulary)) {
    case AskedForm::kPrefix:
      return said + " begins with \"" + printable(without_star(text)) + "\"";
    case AskedForm::kExpression:
      return said + " matches " + printable(text);
    case AskedForm::kName:
      break;
  }
  if (vocabulary.is_super_class(text)) {
    return said + " is of \"" + printable(text) + "\"" +
           list_in_parentheses(vocabulary.names_of(text));
  }
  std::vector<std::string> names(known.begin(), known.end());
  for (std::string& name : vocabulary.all_names()) names.push_back(std::move(name));
  const bool is_there = vocabulary.knows(text);
  return said + " is called \"" + printable(text) + "\"" +
         (is_there ? std::string() : did_you_mean(text, names));
}

Result<std::vector<ClassId>> asked_classes(const ClassRegistry& classes,
                                           const ClassVocabulary& vocabulary,
                                           std::span<const std::string> texts) {
  std::set<ClassId> ids;
  for (const std::string& text : texts) {
    HYPERMAP_ASSIGN_OR_RETURN(const NameSelection names,
                              asked_names(text, classes.names(), vocabulary));
    bool is_any = false;
    for (const std::string& name : names.canonical_names()) {
      const auto id = classes.find(name);
      if (!id) continue;
      ids.insert(*id);
      is_any = true;
    }
    if (is_any) continue;
    return fail(ErrorCode::kNotFound,
                nothing_asked(text, classes.names(), vocabulary) + " (" +
                    std::to_string(classes.size()) + " are known" +
                    joined_after_colon(classes.names()) + ")");
  }
  return std::vector<ClassId>(ids.begin(), ids.end());
}

}  // namespace hypermap
