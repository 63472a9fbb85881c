// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the header of a point cloud says of the data behind it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/point_cloud_file.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

enum class CloudScalar : std::uint8_t {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kUint8,
  kUint16,
  kUint32,
  kUint64,
  kFloat,
  kDouble,
};

[[nodiscard]] std::size_t size_of(CloudScalar type);

struct CloudField {
  std::string name;
  CloudScalar type = CloudScalar::kFloat;
  std::size_t count = 1;   ///< Values a point.
  std::size_t offset = 0;  ///< Within the bytes of a point.
};

enum class CloudForm : std::uint8_t {
  kText,     ///< A line a point.
  kRows,     ///< All bytes of a point, then those of the next.
  kColumns,  ///< All values of a field, then those of the next; compressed.
};

struct CloudHeader {
  std::vector<CloudField> fields = {};
  std::size_t num_points = 0;
  std::size_t num_lines_before = 0;  ///< Of text: those of other elements.
  std::size_t bytes_before = 0;      ///< Of rows: the same.
  CloudForm form = CloudForm::kText;
  bool is_big_endian = false;
  std::map<std::int64_t, std::string> names = {};
  std::size_t num_bytes = 0;  ///< Of the header itself.
  int num_lines = 0;          ///< The same.

  /// Bytes of one point.
  [[nodiscard]] std::size_t row_bytes() const;
};

/// Lines of a header one after the other, each of at most kMaxLineBytes.
class HeaderLines {
 public:
  static constexpr std::size_t kMaxLineBytes = 65'536;
  static constexpr int kMaxLines = 100'000;

  explicit HeaderLines(std::string_view bytes) : bytes_(bytes) {}
  /// None behind the last whole one, and behind a line or a header that is too long.
  [[nodiscard]] std::optional<std::string_view> next();
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::size_t num_bytes() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// Errors: those of parse_point_cloud, without the file.
[[nodiscard]] Result<CloudHeader> parse_pcd_header(std::string_view bytes);
[[nodiscard]] Result<CloudHeader> parse_ply_header(std::string_view bytes);

/// An error at a line.
[[nodiscard]] Unexpected malformed_cloud(std::string what, std::string field, int line = 0);

/// What LZF packed. Errors: kMalformedFile when it is not exactly `num_bytes`.
[[nodiscard]] Result<std::string> unpacked_lzf(std::string_view packed, std::size_t num_bytes);

}  // namespace hypermap
