// SPDX-License-Identifier: BSD-3-Clause
#include "rank_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace hypermap::app {
namespace {

constexpr const char* kRankProgram = "hypermap-ranks";

/// The words that this process was started with.
std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\0', begin);
    words.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return words;
}

Unexpected no_rank(const std::filesystem::path& program, const std::error_code& reason) {
  return Unexpected(Error{.code = ErrorCode::kUnavailable,
                          .what = "cannot be run (" + reason.message() +
                                  "); it is built where MPI is found, and lies beside hypermap",
                          .file = program.string(),
                          .field = "--ranks"});
}

}  // namespace

Result<void> become_rank() {
  std::error_code failed;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
  const auto program = self.parent_path() / kRankProgram;
  if (failed) return no_rank(program, failed);
  std::vector<std::string> words = own_words();
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  return no_rank(program, {errno, std::generic_category()});
}

}  // namespace hypermap::app
