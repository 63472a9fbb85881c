// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which names mean one class, and which classes are kinds of others: data, not code.
///
/// A map keeps the names that its detectors gave. A vocabulary says afterwards that a settee is a
/// sofa, and that sofas and chairs are furniture; another one may say otherwise of the same map.
///
/// Source: [smap] 3.5.3, expandable classification; the super-classes are ours.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// A name as it was written, and in which line; lines do not count when two are compared.
struct VocabularyName {
  std::string text;
  int line = 0;  ///< 1-based; 0 when it came from no file.
  friend bool operator==(const VocabularyName& a, const VocabularyName& b) {
    return a.text == b.text;
  }
};

/// A class with its aliases, or a super-class with its members.
struct VocabularyGroup {
  VocabularyName name;
  std::vector<VocabularyName> members;
  friend bool operator==(const VocabularyGroup&, const VocabularyGroup&) = default;
};

/// What is written down, in its order.
struct VocabularyGroups {
  std::vector<VocabularyGroup> aliases;
  std::vector<VocabularyGroup> super_classes;
  friend bool operator==(const VocabularyGroups&, const VocabularyGroups&) = default;
};

/// Aliases (many names, one class) and super-classes (a class may be of several, and they of
/// others).
///
/// A value. All names are taken in any spelling (`canonical_class_name`); a name that stands
/// nowhere is a class of its own.
class ClassVocabulary {
 public:
  static constexpr std::size_t kMaxNames = 20'000;     ///< As often as they are written.
  static constexpr std::size_t kMaxNameBytes = 256;    ///< Of one.
  static constexpr std::size_t kMaxSuperClasses = 16;  ///< One above the other.

  /// An empty one: every name is a class of its own.
  ClassVocabulary() = default;

  /// Errors, with the line and as field `aliases.NAME` or `super_classes.NAME`: kInvalidArgument
  /// for a name that is empty, no UTF-8 or holds NUL, that stands twice in one place, that is an
  /// alias of two classes, an alias that is a class, a super-class or a member of one, and for
  /// super-classes that form a circle, which is told; kLimit beyond the limits above.
  /// Boundary: an alias that is a spelling of its class says nothing new and is no error.
  /// Cost: n log n in the names.
  [[nodiscard]] static Result<ClassVocabulary> create(VocabularyGroups groups);

  [[nodiscard]] bool empty() const noexcept {
    return groups_.aliases.empty() && groups_.super_classes.empty();
  }
  [[nodiscard]] const VocabularyGroups& groups() const noexcept { return groups_; }

  /// Whether the name stands anywhere in it.
  [[nodiscard]] bool knows(std::string_view name) const;
  /// Whether other classes are kinds of this one.
  [[nodiscard]] bool is_super_class(std::string_view name) const;
  /// The canonical name of the class that `name` means.
  [[nodiscard]] std::string class_of(std::string_view name) const;
  /// The class that `name` means as it is written here; `name` where it stands nowhere.
  [[nodiscard]] std::string shown_class(std::string_view name) const;
  /// The canonical names of the class that `name` means and of its aliases, ascending.
  [[nodiscard]] std::vector<std::string> same_names(std::string_view name) const;
  /// The canonical names of that class, its aliases, and all that are kinds of it, ascending.
  [[nodiscard]] std::vector<std::string> names_of(std::string_view name) const;
  /// The super-classes of the class that `name` means, canonical: the nearest first, of equally
  /// near ones in the order in which they are written; each once.
  [[nodiscard]] std::vector<std::string> super_classes_of(std::string_view name) const;
  /// All names as they are first written, each class once in any spelling.
  [[nodiscard]] std::vector<std::string> all_names() const;

  friend bool operator==(const ClassVocabulary& a, const ClassVocabulary& b) {
    return a.groups_ == b.groups_;
  }

 private:
  using Names = std::vector<std::string>;

  /// Of canonical names; errors as `create`.
  Result<void> add_aliases(const VocabularyGroup& group);
  Result<void> add_super_class(const VocabularyGroup& group);
  /// Levels below a class, its own included. `path`: the classes above it, from the top.
  Result<std::size_t> height(const VocabularyName& name,
                             Names& path,
                             std::map<std::string, std::size_t>& known) const;

  VocabularyGroups groups_;
  std::map<std::string, std::string> shown_;     ///< As first written, by canonical name.
  std::map<std::string, std::string> class_of_;  ///< By alias.
  std::map<std::string, Names> aliases_;         ///< By class.
  std::map<std::string, Names> super_classes_;   ///< By member, in the order of the file.
  std::map<std::string, std::vector<VocabularyName>> members_;  ///< By super-class.
};

}  // namespace hypermap
