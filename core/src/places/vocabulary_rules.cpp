// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/vocabulary_rules.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "places/class_rules.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Rules by the class that their names mean; the rule of its own name goes before that of an alias.
template <class Rules>
Rules rules_of_classes(const Rules& rules, const ClassVocabulary& vocabulary) {
  Rules of_classes;
  for (const auto& [name, rule] : rules) {
    const std::string class_name = vocabulary.class_of(name);
    if (class_name == name) of_classes.insert_or_assign(class_name, rule);
    of_classes.emplace(class_name, rule);
  }
  return of_classes;
}

/// The rule of a class, or of the nearest super-class with one; null when there is none.
template <class Rules>
const typename Rules::mapped_type* rule_of(const std::string& name,
                                           const Rules& of_classes,
                                           const ClassVocabulary& vocabulary) {
  std::vector<std::string> candidates{vocabulary.class_of(name)};
  for (std::string& above : vocabulary.super_classes_of(name)) {
    candidates.push_back(std::move(above));
  }
  for (const std::string& candidate : candidates) {
    const auto found = of_classes.find(candidate);
    if (found != of_classes.end()) return &found->second;
  }
  return nullptr;
}

/// The rules, and those of names that they do not have themselves.
template <class Rules>
Rules of_all_names(Rules rules, const ClassVocabulary& vocabulary) {
  const Rules of_classes = rules_of_classes(rules, vocabulary);
  std::set<std::string> names;
  for (const auto& [class_name, rule] : of_classes) {
    for (std::string& name : vocabulary.names_of(class_name)) names.insert(std::move(name));
  }
  for (const std::string& name : names) {
    if (rules.contains(name)) continue;
    const auto* rule = rule_of(name, of_classes, vocabulary);
    if (rule != nullptr) rules.emplace(name, *rule);
  }
  return rules;
}

}  // namespace

PlaceRules with_vocabulary(PlaceRules rules, const ClassVocabulary& vocabulary) {
  if (vocabulary.empty()) return rules;
  rules.belongings = of_all_names(std::move(rules.belongings), vocabulary);
  rules.sizes = of_all_names(std::move(rules.sizes), vocabulary);
  return rules;
}

RelationOptions with_vocabulary(RelationOptions options, const ClassVocabulary& vocabulary) {
  if (vocabulary.empty()) return options;
  std::set<std::string> holders;
  for (const std::string& name : options.holders) {
    for (std::string& one : vocabulary.names_of(name)) holders.insert(std::move(one));
  }
  options.holders.assign(holders.begin(), holders.end());
  std::set<std::string> parts;
  for (const std::string& text : options.parts) {
    const auto declared = parse_part(text);
    if (!declared) continue;
    for (const std::string& part : vocabulary.names_of(declared->part)) {
      for (const std::string& whole : vocabulary.names_of(declared->whole)) {
        parts.insert(std::string(part).append(" of ").append(whole));
      }
    }
  }
  options.parts.assign(parts.begin(), parts.end());
  return options;
}

}  // namespace hypermap
