// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"

#include "hypermap/io/archive/vocabulary_file.hpp"

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

}  // namespace hypermap::app
