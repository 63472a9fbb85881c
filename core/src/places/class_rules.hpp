// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What relations ask of the classes of two objects.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/places/relation_options.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {

/// Names of classes, as they were written.
struct DeclaredPart {
  std::string part;
  std::string whole;
};

/// Of "keyboard of laptop". None when a name is missing.
[[nodiscard]] std::optional<DeclaredPart> parse_part(std::string_view text);

/// The options' class names as the ids of a map; names that it does not know fit nothing there.
class ClassRules {
 public:
  ClassRules(const RelationOptions& options, const ClassRegistry& classes);

  [[nodiscard]] bool may_hold(std::optional<ClassId> holder) const {
    return holder && holders_.contains(*holder);
  }
  [[nodiscard]] bool may_be_part(std::optional<ClassId> part, std::optional<ClassId> whole) const {
    return part && whole && parts_.contains({*part, *whole});
  }

 private:
  std::set<ClassId> holders_;
  std::set<std::pair<ClassId, ClassId>> parts_;
};

}  // namespace hypermap
