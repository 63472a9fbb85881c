// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rows of a PNG as they come out of the compressed stream, one at a time, filters undone.
///
/// Source: PNG specification, third edition, sections 9 (filters), 10 (compression).
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace hypermap {

/// Requires: the parts outlive it. Memory: two rows and zlib's window, whatever the stream holds.
class PngRows {
 public:
  explicit PngRows(std::span<const std::string_view> parts);
  PngRows(const PngRows&) = delete;
  PngRows& operator=(const PngRows&) = delete;
  PngRows(PngRows&&) = delete;
  PngRows& operator=(PngRows&&) = delete;
  ~PngRows();

  /// Rows of `row_bytes` follow whose filters look `pixel_bytes` to the left.
  void start_pass(std::size_t row_bytes, std::size_t pixel_bytes);
  /// The next row; valid until the next call. Errors: kMalformedFile when the stream is damaged or
  /// ends, or the filter type is not known.
  [[nodiscard]] Result<std::span<const std::uint8_t>> next();
  /// Errors: kMalformedFile unless the stream ends here, checksum included.
  [[nodiscard]] Result<void> finish();

 private:
  struct ZlibStream;
  [[nodiscard]] Result<void> inflate_exactly(std::span<std::uint8_t> target);

  std::span<const std::string_view> parts_;
  std::unique_ptr<ZlibStream> stream_;
  std::vector<std::uint8_t> previous_;
  std::vector<std::uint8_t> current_;  ///< Filter type, then the row.
  std::size_t pixel_bytes_ = 1;
  bool ended_ = false;
};

}  // namespace hypermap
