// SPDX-License-Identifier: BSD-3-Clause
// Checks of what people write about classes: what names mean, where robots go, what belongs where.
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "hypermap/io/exports/zone_masks.hpp"
#include "hypermap/io/options/place_rules_file.hpp"

#include <string>

namespace hypermap {
namespace {

std::string classes_text(std::size_t count, const std::string& kind = "") {
  return std::to_string(count) + " " + kind + (count == 1 ? "class" : "classes");
}

}  // namespace

Result<FileSummary> check_vocabulary(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const ClassVocabulary vocabulary, read_vocabulary(path));
  const VocabularyGroups& groups = vocabulary.groups();
  return FileSummary{"other names of " + classes_text(groups.aliases.size()) + ", members of " +
                         classes_text(groups.super_classes.size(), "super-"),
                     {}};
}

Result<FileSummary> check_zones(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const ZoneRules rules, read_zone_rules(path));
  return FileSummary{"zones of " + classes_text(rules.of_class.size()), {}};
}

Result<FileSummary> check_places(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const PlaceRules rules, read_place_rules(path));
  return FileSummary{"where objects of " + classes_text(rules.belongings.size()) + " belong, of " +
                         count_text(rules.places.size(), "place"),
                     {}};
}

}  // namespace hypermap
