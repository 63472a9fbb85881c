// SPDX-License-Identifier: BSD-3-Clause
// Names of classes, a line each.
#include "fuzz_target.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_classes(std::string_view bytes) {
  const auto names = read_class_names(file_of(bytes, "classes.txt"));
  if (!names) return;
  std::string written;
  for (const std::string& name : *names) written += name + "\n";
  const auto again = read_class_names(file_of(written, "written.txt"));
  require(require(again, "what was written is read") == *names, "as the same names");
}

}  // namespace hypermap::fuzz
