// SPDX-License-Identifier: BSD-3-Clause
#include "named_classes.hpp"

#include "hypermap/core/vocabulary/asked_names.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace hypermap {

Result<NamedClasses> named_classes(std::span<const std::string> texts,
                                   const char* option,
                                   const ClassRegistry& classes,
                                   const ClassVocabulary& vocabulary) {
  NamedClasses named;
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    const auto asked = asked_names(text, classes.names(), vocabulary);
    if (!asked) return fail(asked.error().code, asked.error().what, option);
    bool is_any = false;
    for (const std::string& name : asked->canonical_names()) {
      const auto id = classes.find(name);
      if (!id) continue;
      is_any = true;
      if (seen.insert(classes.name(*id)).second) named.names.push_back(classes.name(*id));
    }
    if (is_any) continue;
    Error unknown{.code = ErrorCode::kNotFound,
                  .what = nothing_asked(text, classes.names(), vocabulary, "no class of the input"),
                  .field = option};
    if (!asked->contains(text)) return Unexpected(std::move(unknown));
    named.findings.push_back({.error = std::move(unknown)});
    if (seen.insert(text).second) named.names.push_back(text);
  }
  return named;
}

}  // namespace hypermap
