// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

namespace hypermap::app {

void ClassNames::add_to(CLI::App& command, const char* effect) {
  command.add_option(
      "--class-names",
      file,
      std::string("YAML file of aliases and super-classes, as data/vocabulary.yaml, ") + effect);
}

Result<std::optional<ClassVocabulary>> ClassNames::given() const {
  if (file.empty()) return std::optional<ClassVocabulary>();
  HYPERMAP_ASSIGN_OR_RETURN(ClassVocabulary vocabulary, read_vocabulary(file));
  return std::optional(std::move(vocabulary));
}

Result<void> ClassNames::replace(ClassVocabulary& vocabulary) const {
  HYPERMAP_ASSIGN_OR_RETURN(auto read, given());
  if (read) vocabulary = std::move(*read);
  return {};
}

ExitCode warn_of_unknown_classes(const MapArchive& archive,
                                 const std::string& file,
                                 const std::vector<std::string>& class_names) {
  std::vector<std::string> known = names_in(archive);
  std::ranges::copy(archive.vocabulary.all_names(), std::back_inserter(known));
  std::set<std::string> canonical;
  for (const std::string& name : known) canonical.insert(canonical_class_name(name));
  ExitCode worst = ExitCode::kDone;
  for (const std::string& name : class_names) {
    if (canonical.contains(name)) continue;
    worst = report(Finding{.error = {.code = ErrorCode::kNotFound,
                                     .what = "is no class of the map, nor of its vocabulary" +
                                             did_you_mean(name, known),
                                     .file = file,
                                     .field = printable(name)}});
  }
  return worst;
}

}  // namespace hypermap::app
