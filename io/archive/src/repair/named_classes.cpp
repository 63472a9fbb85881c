// SPDX-License-Identifier: BSD-3-Clause
#include "named_classes.hpp"

#include "archive_checks.hpp"
#include "hypermap/core/base/count_text.hpp"

#include <cstddef>

namespace hypermap {

std::string name_absent_classes(MapArchive& archive) {
  /// No map of ours has so many; a damaged id must not be made true by names without end.
  constexpr std::size_t kMostNames = 65'535;
  const auto largest = largest_class_of(archive);
  const std::size_t num_wanted = largest ? std::size_t{largest->value} + 1 : 0;
  if (num_wanted > kMostNames) return "";
  const std::size_t num_before = archive.classes.size();
  while (archive.classes.size() < num_wanted) {
    if (!archive.classes.add("class_" + std::to_string(archive.classes.size()))) break;
  }
  const std::size_t num_named = archive.classes.size() - num_before;
  if (num_named == 0) return "";
  return count_text(num_named, "name") + " of classes are lost; they are called class_<id>";
}

}  // namespace hypermap
