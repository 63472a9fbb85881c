// SPDX-License-Identifier: BSD-3-Clause
#include "shell_history.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <system_error>

namespace hypermap::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHistoryBytes = kMaxHistoryLines * (kMaxHistoryLineBytes + 1);

/// The folder that a variable of the environment names, when it names one from the root on.
std::optional<fs::path> folder_in(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value != '/') return std::nullopt;
  return fs::path(value);
}

bool is_kept(std::string_view line) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20U && c != '\t'; };
  return !line.empty() && line.size() <= kMaxHistoryLineBytes &&
         std::ranges::none_of(line, is_control);
}

}  // namespace

std::optional<fs::path> history_file() {
  const fs::path own = fs::path("hypermap") / "history";
  if (const auto state = folder_in("XDG_STATE_HOME")) return *state / own;
  if (const auto home = folder_in("HOME")) return *home / ".local" / "state" / own;
  return std::nullopt;
}

std::vector<std::string> read_history(const fs::path& file) {
  const auto bytes = read_file(file, kMaxHistoryBytes);
  std::vector<std::string> lines;
  if (!bytes) return lines;
  for (const TextLine& line : split_lines(*bytes)) {
    if (is_kept(line.text)) lines.emplace_back(line.text);
  }
  return lines;
}

Result<void> append_history(const fs::path& file, std::span<const std::string> lines) {
  std::vector<std::string> all = read_history(file);
  std::ranges::copy_if(lines, std::back_inserter(all), is_kept);
  std::string text;
  const std::size_t first = all.size() - std::min(all.size(), kMaxHistoryLines);
  for (std::size_t i = first; i < all.size(); ++i) text += all[i] + "\n";
  std::error_code failed;  // writing says why
  fs::create_directories(file.parent_path(), failed);
  return write_file_atomically(file, text);
}

}  // namespace hypermap::app
