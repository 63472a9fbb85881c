// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// libjpeg's decompressor with its errors as results.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace hypermap {

/// One JPEG: read_header, then read_rows once.
///
/// What libjpeg only warns of is an error where coded pixels are missing or damaged: it would fill
/// them with grey.
class JpegDecompression {
 public:
  JpegDecompression();
  JpegDecompression(const JpegDecompression&) = delete;
  JpegDecompression& operator=(const JpegDecompression&) = delete;
  JpegDecompression(JpegDecompression&&) = delete;
  JpegDecompression& operator=(JpegDecompression&&) = delete;
  ~JpegDecompression();

  /// Requires: the bytes outlive the object. Errors: kMalformedFile, kOutOfMemory.
  [[nodiscard]] Result<void> read_header(std::string_view bytes);

  [[nodiscard]] int width_px() const;
  [[nodiscard]] int height_px() const;
  /// Of the rows: 1 grey, 3 RGB.
  [[nodiscard]] int channels() const;

  /// Fills `samples`, row by row. Requires: width x height x channels of them.
  /// Errors: kMalformedFile, for more than 500 scans too (they cost time, not bytes); kOutOfMemory.
  [[nodiscard]] Result<void> read_rows(std::span<std::uint8_t> samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hypermap
