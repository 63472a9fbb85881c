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

using Belongings = decltype(PlaceRules::belongings);

/// Rules by the class that their names mean; the rule of its own name goes before that of an alias.
Belongings belongings_of_classes(const Belongings& rules, const ClassVocabulary& vocabulary) {
  Belongings of_classes;
  for (const auto& [name, weights] : rules) {
    const std::string class_name = vocabulary.class_of(name);
    if (class_name == name) of_classes.insert_or_assign(class_name, weights);
    of_classes.emplace(class_name, weights);
  }
  return of_classes;
}

/// The rule of a class, or of the nearest super-class with one; null when there is none.
const Belongings::mapped_type* rule_of(const std::string& name,
                                       const Belongings& of_classes,
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

}  // namespace

PlaceRules with_vocabulary(PlaceRules rules, const ClassVocabulary& vocabulary) {
  if (vocabulary.empty()) return rules;
  const Belongings of_classes = belongings_of_classes(rules.belongings, vocabulary);
  std::set<std::string> names;
  for (const auto& [class_name, weights] : of_classes) {
    for (std::string& name : vocabulary.names_of(class_name)) names.insert(std::move(name));
  }
  for (const std::string& name : names) {
    if (rules.belongings.contains(name)) continue;
    const auto* weights = rule_of(name, of_classes, vocabulary);
    if (weights != nullptr) rules.belongings.emplace(name, *weights);
  }
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
