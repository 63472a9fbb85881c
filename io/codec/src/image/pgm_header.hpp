// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The text of portable grey maps: numbers between blanks and comments, and their header.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {

/// Reads a PGM's text from front to back.
class PgmText {
 public:
  explicit PgmText(std::string_view bytes) : rest_(bytes) {}

  /// Blanks and comments; false when a comment never ends or all together exceed 64 KiB.
  [[nodiscard]] bool skip_blanks();
  /// A decimal number from 0 to `max` that ends at a blank, a comment or the end.
  [[nodiscard]] std::optional<int> number(int max);
  /// The one blank between maxval and the raster of P5.
  [[nodiscard]] bool skip_one_blank();
  /// What is not read yet, for messages and for the raster.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t comment_bytes_ = 0;
};

struct PgmHeader {
  bool is_text = false;
  int width_px = 0;
  int height_px = 0;
  int max_value = 0;
  std::string_view raster = {};  ///< A view of the bytes that were read.
};

/// Errors: kMalformedFile, naming the field.
[[nodiscard]] Result<PgmHeader> read_pgm_header(std::string_view bytes);

/// The first bytes of what stands there, for messages.
[[nodiscard]] std::string printable_token(std::string_view text);

}  // namespace hypermap
