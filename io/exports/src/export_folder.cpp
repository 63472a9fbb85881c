// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <system_error>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNameBytes = 200;  // leaves room for a number and an extension in 255

/// Letters of any script, digits, hyphens and underscores; no control character.
bool is_plain(std::string_view character) {
  const char c = character.front();
  if (character.size() > 1) return printable(character) == character;
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_';
}

/// A name of a class or layer as a file name: nothing in it may lead elsewhere.
std::string file_name(std::string_view text) {
  std::string name;
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, 0), 1);
    const std::string_view character = text.substr(0, length);
    if (name.size() + length > kMaxNameBytes) break;
    name += is_plain(character) ? character : "_";
    text.remove_prefix(length);
  }
  return name;
}

}  // namespace

Result<void> make_export_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
  return {};
}

std::string FileNames::add(std::string_view name) {
  const std::string plain = file_name(name);
  std::string free = plain;
  for (int n = 2; !taken_.insert(free).second; ++n) free = plain + "-" + std::to_string(n);
  return free;
}

}  // namespace hypermap
