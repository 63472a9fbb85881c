// SPDX-License-Identifier: BSD-3-Clause
#include "zip_names.hpp"

#include "hypermap/core/base/utf8.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {
namespace {

constexpr std::size_t kMaxEntryNameBytes = 255;

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

bool has_drive(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return name.size() >= 2 && name[1] == ':' && is_letter(name[0]);
}

/// Why a part between slashes is no good, or an empty text.
std::string_view fault_of_part(std::string_view part) {
  if (part.empty()) return "has an empty part";
  if (part == "." || part == "..") return "has a part that is '.' or '..'";
  return {};
}

std::string_view fault_of(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > kMaxEntryNameBytes) return "is longer than 255 bytes";
  if (std::any_of(name.begin(), name.end(), is_control)) return "has a control character";
  if (first_bad_utf8(name) < name.size()) return "is not UTF-8";
  if (name.find('\\') != std::string_view::npos) return "has a backslash";
  if (has_drive(name)) return "has a drive";
  if (name.front() == '/') return "is absolute";
  if (name.back() == '/') name.remove_suffix(1);
  while (true) {
    const std::size_t slash = name.find('/');
    if (const auto fault = fault_of_part(name.substr(0, slash)); !fault.empty()) return fault;
    if (slash == std::string_view::npos) return {};
    name.remove_prefix(slash + 1);
  }
}

}  // namespace

Result<void> check_member_name(std::string_view name) {
  const std::string_view fault = fault_of(name);
  if (fault.empty()) return {};
  return fail(ErrorCode::kMalformedFile,
              "member name '" + printable(name) + "' " + std::string(fault));
}

std::string folded_name(std::string_view name) {
  if (name.ends_with('/')) name.remove_suffix(1);
  std::string folded(name);
  for (char& c : folded)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return folded;
}

Result<void> MemberNames::add(std::string_view name) {
  HYPERMAP_TRY(check_member_name(name));
  const bool is_folder = name.ends_with('/');
  const std::string folded = folded_name(name);
  const auto taken = [&](std::string_view how) {
    return fail(ErrorCode::kMalformedFile,
                "member name '" + printable(name) + "' " + std::string(how));
  };
  for (std::size_t slash = folded.find('/'); slash != std::string::npos;
       slash = folded.find('/', slash + 1)) {
    const std::string parent = folded.substr(0, slash);
    if (files_.contains(parent)) return taken("lies in a folder that is also a member");
    folders_.insert(parent);
  }
  if (is_folder ? files_.contains(folded) : folders_.contains(folded))
    return taken("is also the name of a folder");
  if (!(is_folder ? listed_folders_ : files_).insert(folded).second)
    return taken("is there twice (letters in another case count as the same)");
  if (is_folder) folders_.insert(folded);
  return {};
}

}  // namespace hypermap
