// SPDX-License-Identifier: BSD-3-Clause
#include "unknown_names.hpp"

#include "hypermap/core/base/nearest_name.hpp"

namespace hypermap {

std::vector<Finding> unknown_names(std::span<const std::string> names,
                                   const char* option,
                                   const ClassRegistry& classes) {
  std::vector<Finding> findings;
  for (const std::string& name : names) {
    if (classes.find(name)) continue;
    findings.push_back({.error = {.code = ErrorCode::kNotFound,
                                  .what = "no class of the input is called \"" + printable(name) +
                                          "\"" + did_you_mean(name, classes.names()),
                                  .field = option}});
  }
  return findings;
}

}  // namespace hypermap
