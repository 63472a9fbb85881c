// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which classes are known: an open set that grows as detectors name new ones.
///
/// Source: [smap] 3.5.3, expandable classification: the combined set has each class once.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Names of classes and their ids 0, 1, 2, ... in the order of first mention.
///
/// Spellings of the same class ("dining table", "diningtable"; "tv", "tvmonitor") share one id, see
/// `canonical_class_name`; the first spelling is the one that is shown and saved.
class ClassRegistry {
 public:
  /// A detector's list: the i-th name has id i.
  /// Errors: those of `add`, and kInvalidArgument when a name or another spelling of it occurs
  /// twice; the field is `names[i]`.
  [[nodiscard]] static Result<ClassRegistry> from_names(std::span<const std::string> names);

  /// The id of `name`, which is added when it is new. Names come from detectors and may hold
  /// control characters, slashes or quotes: whoever shows or writes one escapes it.
  /// Errors: kInvalidArgument when the name is empty, no UTF-8 or holds NUL; kLimit when it is
  /// longer than 256 bytes or when there would be more than 65,535 classes.
  [[nodiscard]] Result<ClassId> add(std::string_view name);

  /// The id of `name` or of another spelling of it, when known.
  [[nodiscard]] std::optional<ClassId> find(std::string_view name) const;

  /// Requires: contains(id).
  [[nodiscard]] const std::string& name(ClassId id) const;

  [[nodiscard]] bool contains(ClassId id) const noexcept { return id.value < names_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return names_.size(); }
  /// In the order of their ids.
  [[nodiscard]] std::span<const std::string> names() const noexcept { return names_; }
  friend bool operator==(const ClassRegistry& a, const ClassRegistry& b) {
    return a.names_ == b.names_;
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, ClassId, std::less<>> id_of_canonical_;
};

/// Lower case (of ASCII), without spaces, hyphens and underscores.
[[nodiscard]] std::string folded_class_name(std::string_view name);
/// One spelling for all spellings of a class: `folded_class_name`, and the names of COCO 2017
/// mapped to those of the VOC style ("tv" -> "tvmonitor", "couch" -> "sofa", "potted plant" ->
/// "pottedplant", "motorcycle" -> "motorbike", "airplane" -> "aeroplane").
[[nodiscard]] std::string canonical_class_name(std::string_view name);
/// Whether both are spellings of one class, or of one word.
[[nodiscard]] bool is_spelling_of(std::string_view a, std::string_view b);

}  // namespace hypermap
