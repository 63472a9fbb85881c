// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Another working folder and another one for temporary files, for as long as a test takes.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hypermap::test {

class WorkingFolder {
 public:
  WorkingFolder(const std::filesystem::path& working, const std::filesystem::path& temporaries)
      : before_(std::filesystem::current_path()),
        temporaries_before_(std::filesystem::temp_directory_path().string()) {
    std::filesystem::create_directories(working);
    std::filesystem::create_directories(temporaries);
    std::filesystem::current_path(working);
    ::setenv("TMPDIR", temporaries.c_str(), 1);
  }
  ~WorkingFolder() {
    std::error_code ignored;
    std::filesystem::current_path(before_, ignored);
    ::setenv("TMPDIR", temporaries_before_.c_str(), 1);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;
  WorkingFolder(WorkingFolder&&) = delete;
  WorkingFolder& operator=(WorkingFolder&&) = delete;

 private:
  std::filesystem::path before_;
  std::string temporaries_before_;
};

}  // namespace hypermap::test
