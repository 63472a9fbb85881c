// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where tests find data: the project's own, and data by others that may be absent.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hypermap::test {

/// A file of the project's own tree.
[[nodiscard]] std::filesystem::path source_path(const std::string& relative);

/// Data by others: $HYPERMAP_DATA, else ../shared/data beside the project. May not exist.
inline std::filesystem::path shared_data(const std::string& relative) {
  const char* from_environment = std::getenv("HYPERMAP_DATA");
  const std::filesystem::path root = from_environment != nullptr
                                         ? std::filesystem::path(from_environment)
                                         : source_path("../shared/data");
  return root / relative;
}

}  // namespace hypermap::test

/// Skips the running test, with a message, when data by others is not there.
#define HYPERMAP_REQUIRE_SHARED_DATA(relative)                                              \
  do {                                                                                      \
    if (!std::filesystem::exists(::hypermap::test::shared_data(relative)))                  \
      GTEST_SKIP() << "test data not present: " << ::hypermap::test::shared_data(relative); \
  } while (false)
