// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_header.hpp"

#include <utility>

namespace hypermap {

std::size_t size_of(CloudScalar type) {
  switch (type) {
    case CloudScalar::kInt8:
    case CloudScalar::kUint8:
      return 1;
    case CloudScalar::kInt16:
    case CloudScalar::kUint16:
      return 2;
    case CloudScalar::kInt32:
    case CloudScalar::kUint32:
    case CloudScalar::kFloat:
      return 4;
    default:
      return 8;
  }
}

std::size_t CloudHeader::row_bytes() const {
  return fields.empty() ? 0
                        : fields.back().offset + fields.back().count * size_of(fields.back().type);
}

std::optional<std::string_view> HeaderLines::next() {
  const std::string_view rest = bytes_.substr(at_, kMaxLineBytes);
  const std::size_t end = rest.find('\n');
  if (end == std::string_view::npos || line_ >= kMaxLines) return std::nullopt;
  at_ += end + 1;
  ++line_;
  std::string_view line = rest.substr(0, end);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Unexpected malformed_cloud(std::string what, std::string field, int line) {
  return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                          .what = std::move(what),
                          .field = std::move(field),
                          .line = line});
}

}  // namespace hypermap
