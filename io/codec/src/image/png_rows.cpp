// SPDX-License-Identifier: BSD-3-Clause
#include "png_rows.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>

namespace hypermap {
namespace {

Unexpected malformed_rows(std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what), "IDAT");
}

/// Source: PNG specification, section 9.4.
std::uint8_t paeth(int left, int above, int above_left) {
  const int estimate = left + above - above_left;
  const int to_left = std::abs(estimate - left);
  const int to_above = std::abs(estimate - above);
  const int to_above_left = std::abs(estimate - above_left);
  if (to_left <= to_above && to_left <= to_above_left) return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(to_above <= to_above_left ? above : above_left);
}

std::uint8_t predicted(std::uint8_t filter, int left, int above, int above_left) {
  switch (filter) {
    case 1:
      return static_cast<std::uint8_t>(left);
    case 2:
      return static_cast<std::uint8_t>(above);
    case 3:
      return static_cast<std::uint8_t>((left + above) / 2);
    case 4:
      return paeth(left, above, above_left);
    default:
      return 0;
  }
}

void undo_filter(std::uint8_t filter,
                 std::span<std::uint8_t> row,
                 std::span<const std::uint8_t> above,
                 std::size_t pixel_bytes) {
  if (filter == 0) return;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool has_left = i >= pixel_bytes;
    const int left = has_left ? row[i - pixel_bytes] : 0;
    const int above_left = has_left ? above[i - pixel_bytes] : 0;
    row[i] = static_cast<std::uint8_t>(row[i] + predicted(filter, left, above[i], above_left));
  }
}

}  // namespace

struct PngRows::ZlibStream {
  z_stream z{};
  std::size_t next_part = 0;
  bool ready = false;
};

PngRows::PngRows(std::span<const std::string_view> parts)
    : parts_(parts), stream_(std::make_unique<ZlibStream>()) {
  if (inflateInit(&stream_->z) != Z_OK) throw std::bad_alloc();
  stream_->ready = true;
}

PngRows::~PngRows() {
  if (stream_->ready) inflateEnd(&stream_->z);
}

void PngRows::start_pass(std::size_t row_bytes, std::size_t pixel_bytes) {
  previous_.assign(row_bytes, 0);
  current_.assign(row_bytes + 1, 0);
  pixel_bytes_ = pixel_bytes;
}

Result<std::span<const std::uint8_t>> PngRows::next() {
  std::copy(current_.begin() + 1, current_.end(), previous_.begin());
  HYPERMAP_TRY(inflate_exactly(current_));
  const std::uint8_t filter = current_.front();
  if (filter > 4) return malformed_rows("filter type " + std::to_string(filter) + " is not known");
  const std::span<std::uint8_t> row = std::span(current_).subspan(1);
  undo_filter(filter, row, previous_, pixel_bytes_);
  return row;
}

Result<void> PngRows::inflate_exactly(std::span<std::uint8_t> target) {
  z_stream& z = stream_->z;
  while (!target.empty()) {
    if (ended_) return malformed_rows("holds too few pixels");
    const bool has_more = stream_->next_part < parts_.size();
    if (z.avail_in == 0 && has_more) {
      const std::string_view part = parts_[stream_->next_part++];
      // zlib does not write through next_in; its type is older than const.
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));  // NOLINT
      z.avail_in = static_cast<uInt>(part.size());
    }
    const auto portion = static_cast<uInt>(
        std::min<std::size_t>(target.size(), std::numeric_limits<uInt>::max() / 2));
    z.next_out = target.data();
    z.avail_out = portion;
    const int status = inflate(&z, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      return malformed_rows(std::string("is damaged: ") +
                            (z.msg != nullptr ? z.msg : "no zlib stream"));
    }
    ended_ = status == Z_STREAM_END;
    const std::size_t produced = portion - z.avail_out;
    if (produced == 0 && !ended_ && !has_more) return malformed_rows("holds too few pixels");
    target = target.subspan(produced);
  }
  return {};
}

Result<void> PngRows::finish() {
  z_stream& z = stream_->z;
  std::array<std::uint8_t, 1> more{};
  // One byte more must not come; asking for it lets zlib check the stream's end.
  while (!ended_) {
    const auto got = inflate_exactly(more);
    if (got) return malformed_rows("holds more pixels than declared");
    if (!ended_) return tl::make_unexpected(got.error());
  }
  const bool is_all = z.avail_in == 0 &&
                      std::all_of(parts_.begin() + static_cast<std::ptrdiff_t>(stream_->next_part),
                                  parts_.end(),
                                  [](std::string_view part) { return part.empty(); });
  if (!is_all) return malformed_rows("bytes follow after the compressed pixels");
  return {};
}

}  // namespace hypermap
