// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of members, and whether they can lie beside each other on any file system.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <set>
#include <string>
#include <string_view>

namespace hypermap {

/// The name with ASCII letters in lower case and without a final '/'.
[[nodiscard]] std::string folded_name(std::string_view name);

/// The names of one archive.
class MemberNames {
 public:
  /// Errors: kMalformedFile when the name breaks `check_member_name`, is there already (in any
  /// case of its letters), or is a file and a folder at once.
  [[nodiscard]] Result<void> add(std::string_view name);

 private:
  std::set<std::string, std::less<>> files_;
  std::set<std::string, std::less<>> folders_;
  std::set<std::string, std::less<>> listed_folders_;
};

}  // namespace hypermap
