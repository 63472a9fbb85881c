// SPDX-License-Identifier: BSD-3-Clause
#include "system_error.hpp"

#include <system_error>

namespace hypermap {

Error system_error(const std::filesystem::path& path, std::string_view action, int error_number) {
  Error error{.code = ErrorCode::kIo,
              .what = "cannot " + std::string(action) + ": " +
                      std::generic_category().message(error_number) + " (errno " +
                      std::to_string(error_number) + ")"};
  error.file = path.string();
  return error;
}

}  // namespace hypermap
