// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The tables of the hostile corpus, so that each of its files is a test.
#pragma once

#include "support/test_data.hpp"

#include <fstream>
#include <string>
#include <vector>

namespace hypermap::test {

/// Names of the files that INDEX.md lists under a heading; empty when the corpus is not there.
inline std::vector<std::string> hostile_files(const std::string& folder) {
  std::ifstream index(shared_data("hostile/INDEX.md"));
  std::vector<std::string> names;
  bool inside = false;
  for (std::string line; std::getline(index, line);) {
    if (line.starts_with("## ")) inside = line == "## " + folder;
    if (!inside || !line.starts_with("| `")) continue;
    names.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  return names;
}

/// The same, or one name that stands for the absent corpus, so that its test skips with a message.
inline std::vector<std::string> hostile_files_or_none(const std::string& folder) {
  const std::vector<std::string> names = hostile_files(folder);
  return names.empty() ? std::vector<std::string>{"absent"} : names;
}

/// A file's name as GoogleTest takes it.
inline std::string test_name_of(const std::string& file) {
  std::string name;
  for (const char c : file) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : 'X';
  return name;
}

}  // namespace hypermap::test
