// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/archive_size.hpp"

#include <string>
#include <utility>

namespace hypermap {

Result<void> check_archive_size(std::uint64_t num_bytes, const ZipLimits& limits) {
  if (num_bytes <= limits.max_archive_bytes) return {};
  std::string what = "archive of " + std::to_string(num_bytes) + " bytes, the limit is " +
                     std::to_string(limits.max_archive_bytes);
  const bool is_within_large =
      limits.max_archive_bytes < kLargeArchiveBytes && num_bytes <= kLargeArchiveBytes;
  if (is_within_large) what += "; --large allows " + std::to_string(kLargeArchiveBytes);
  return fail(ErrorCode::kLimit, std::move(what));
}

}  // namespace hypermap
