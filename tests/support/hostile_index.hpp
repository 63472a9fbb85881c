// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The table of hostile files by others: which must load and which be refused.
#pragma once

#include "support/test_data.hpp"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hypermap::test {

struct HostileFile {
  std::filesystem::path path;
  bool must_load = false;
  bool may_be_repaired = false;  ///< The index leaves a choice; ours is to mend and say so.
  std::string outcome;
};

/// Rows of the section `## folder`, whose files lie in that folder.
inline std::vector<HostileFile> hostile_files(const std::string& folder) {
  std::vector<HostileFile> files;
  std::ifstream index(shared_data("hostile/INDEX.md"));
  bool is_here = false;
  for (std::string line; std::getline(index, line);) {
    if (line.starts_with("## ")) is_here = line == "## " + folder;
    if (!is_here || !line.starts_with("| `")) continue;
    const std::string name = line.substr(3, line.find('`', 3) - 3);
    std::string path = "hostile/";
    path.append(folder).append("/").append(name);
    files.push_back({shared_data(path),
                     name.starts_with("ok_"),
                     name == "err_bbox_outside.json" || name == "err_inner_children_disagree.ot",
                     line});
  }
  return files;
}

/// Names of those files, for one test each; one name that stands for the absent corpus without it,
/// so that its test skips with a message.
inline std::vector<std::string> hostile_names(const std::string& folder) {
  std::vector<std::string> names;
  for (const HostileFile& file : hostile_files(folder)) names.push_back(file.path.filename());
  return names.empty() ? std::vector<std::string>{"absent"} : names;
}

/// A file's name as GoogleTest takes it.
inline std::string test_name_of(const std::string& file) {
  std::string name;
  for (const char c : file) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : 'X';
  return name;
}

}  // namespace hypermap::test
