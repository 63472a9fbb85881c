// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/png_image.hpp"
#include "picture_limits.hpp"
#include "png_chunks.hpp"
#include "png_rows.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <span>

namespace hypermap {
namespace {

/// A sub-picture of an interlaced PNG; the whole is one pass of step 1.
struct Pass {
  int x0 = 0;
  int y0 = 0;
  int step_x = 1;
  int step_y = 1;
};

constexpr std::array<Pass, 1> kWhole = {{{}}};
/// Source: PNG specification, section 8.2, Adam7.
constexpr std::array<Pass, 7> kAdam7 = {{{0, 0, 8, 8},
                                         {4, 0, 8, 8},
                                         {0, 4, 4, 8},
                                         {2, 0, 4, 4},
                                         {0, 2, 2, 4},
                                         {1, 0, 2, 2},
                                         {0, 1, 1, 2}}};

std::span<const Pass> passes_of(const PngHeader& header) {
  return header.interlaced ? std::span<const Pass>(kAdam7) : std::span<const Pass>(kWhole);
}

int steps(std::int64_t size, int start, int step) {
  return size <= start ? 0 : static_cast<int>((size - start + step - 1) / step);
}

std::size_t row_bytes(const PngHeader& header, int width) {
  const auto bits = static_cast<std::size_t>(header.bits) *
                    static_cast<std::size_t>(stored_channels(header.color));
  return (bits * static_cast<std::size_t>(width) + 7) / 8;
}

/// Bytes of all filtered rows, before compression.
std::uint64_t raw_bytes(const PngHeader& header) {
  std::uint64_t total = 0;
  for (const Pass& pass : passes_of(header)) {
    const int width = steps(header.width_px, pass.x0, pass.step_x);
    const int height = steps(header.height_px, pass.y0, pass.step_y);
    if (width > 0) total += static_cast<std::uint64_t>(height) * (row_bytes(header, width) + 1);
  }
  return total;
}

/// Deflate shrinks to no less than one 1,032nd; what declares more cannot be honest.
Result<void> check_declared_size(const PngLayout& layout) {
  constexpr std::uint64_t kMostInflation = 1032;
  std::uint64_t compressed = 0;
  for (const std::string_view part : layout.data) compressed += part.size();
  if (raw_bytes(layout.header) <= compressed * kMostInflation) return {};
  return fail(ErrorCode::kMalformedFile,
              std::to_string(compressed) + " bytes cannot hold " +
                  std::to_string(layout.header.width_px) + " x " +
                  std::to_string(layout.header.height_px) + " pixels",
              "IDAT");
}

/// Turns unfiltered rows into samples of the picture.
class PixelWriter {
 public:
  explicit PixelWriter(const PngLayout& layout) : layout_(layout) {
    const PngHeader& header = layout.header;
    const bool is_palette = header.color == PngColor::kPalette;
    const int colors = is_palette ? 3 : stored_channels(header.color);
    picture_.width_px = static_cast<int>(header.width_px);
    picture_.height_px = static_cast<int>(header.height_px);
    picture_.channels = colors + (layout.transparency.empty() ? 0 : 1);
    picture_.bits = header.bits == 16 ? 16 : 8;
    picture_.max_value = header.bits == 16 ? 65'535 : 255;
    const std::size_t count = picture_.num_pixels() * static_cast<std::size_t>(picture_.channels);
    if (header.bits == 16) {
      picture_.samples16.resize(count);
    } else {
      picture_.samples8.resize(count);
    }
  }

  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> row,
                                   int width,
                                   const Pass& pass,
                                   int y) {
    for (int i = 0; i < width; ++i) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width_px) +
                         static_cast<std::size_t>(pass.x0 + i * pass.step_x);
      const std::size_t to = pixel * static_cast<std::size_t>(picture_.channels);
      if (layout_.header.color == PngColor::kPalette) {
        HYPERMAP_TRY(write_index(stored(row, static_cast<std::size_t>(i)), to));
      } else {
        write_colors(row, static_cast<std::size_t>(i), to);
      }
    }
    return {};
  }

  [[nodiscard]] Picture take() { return std::move(picture_); }

 private:
  /// The stored sample at a place of the row, 1 to 16 bit.
  [[nodiscard]] unsigned stored(std::span<const std::uint8_t> row, std::size_t index) const {
    const auto bits = static_cast<std::size_t>(layout_.header.bits);
    if (bits == 8) return row[index];
    if (bits == 16) return (unsigned{row[2 * index]} << 8U) | row[2 * index + 1];
    const std::size_t at = index * bits;
    return (unsigned{row[at / 8]} >> (8 - bits - at % 8)) & ((1U << bits) - 1U);
  }

  [[nodiscard]] Result<void> write_index(unsigned index, std::size_t to) {
    const std::string_view palette = layout_.palette;
    if (3 * std::size_t{index} >= palette.size()) {
      return fail(ErrorCode::kMalformedFile,
                  "palette index " + std::to_string(index) + " of " +
                      std::to_string(palette.size() / 3) + " colours",
                  "IDAT");
    }
    for (std::size_t c = 0; c < 3; ++c) {
      picture_.samples8[to + c] = static_cast<std::uint8_t>(palette[3 * std::size_t{index} + c]);
    }
    if (picture_.channels == 4) {
      const std::string_view alpha = layout_.transparency;
      picture_.samples8[to + 3] =
          index < alpha.size() ? static_cast<std::uint8_t>(alpha[index]) : std::uint8_t{255};
    }
    return {};
  }

  void write_colors(std::span<const std::uint8_t> row, std::size_t index, std::size_t to) {
    const auto channels = static_cast<std::size_t>(stored_channels(layout_.header.color));
    bool is_key = !layout_.transparency.empty();
    for (std::size_t c = 0; c < channels; ++c) {
      const unsigned sample = stored(row, index * channels + c);
      is_key = is_key && sample == key(c);
      put(to + c, sample);
    }
    if (!layout_.transparency.empty()) put_alpha(to + channels, is_key);
  }

  [[nodiscard]] unsigned key(std::size_t channel) const {
    const auto byte = [&](std::size_t i) {
      return unsigned{static_cast<unsigned char>(layout_.transparency[2 * channel + i])};
    };
    return (byte(0) << 8U) | byte(1);
  }

  void put(std::size_t at, unsigned sample) {
    if (picture_.bits == 16) {
      picture_.samples16[at] = static_cast<std::uint16_t>(sample);
    } else {  // 1, 2 and 4 bit are spread over 0..255
      const unsigned most = (1U << static_cast<unsigned>(layout_.header.bits)) - 1U;
      picture_.samples8[at] = static_cast<std::uint8_t>(sample * 255U / most);
    }
  }

  void put_alpha(std::size_t at, bool is_transparent) {
    if (picture_.bits == 16) {
      picture_.samples16[at] = is_transparent ? 0 : 65'535;
    } else {
      picture_.samples8[at] = is_transparent ? 0 : 255;
    }
  }

  const PngLayout& layout_;
  Picture picture_;
};

Result<void> read_pass(const PngHeader& header,
                       const Pass& pass,
                       PngRows& rows,
                       PixelWriter& writer) {
  const int width = steps(header.width_px, pass.x0, pass.step_x);
  const int height = steps(header.height_px, pass.y0, pass.step_y);
  if (width == 0) return {};
  const int pixel_bits = header.bits * stored_channels(header.color);
  rows.start_pass(row_bytes(header, width), static_cast<std::size_t>(std::max(1, pixel_bits / 8)));
  for (int i = 0; i < height; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::span<const std::uint8_t> row, rows.next());
    HYPERMAP_TRY(writer.write(row, width, pass, pass.y0 + i * pass.step_y));
  }
  return {};
}

Result<Picture> decode(std::string_view bytes, const PictureLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const PngHeader header, read_png_header(bytes));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  HYPERMAP_ASSIGN_OR_RETURN(const PngLayout layout, read_png_layout(bytes));
  HYPERMAP_TRY(check_declared_size(layout));
  PngRows rows(layout.data);
  PixelWriter writer(layout);
  for (const Pass& pass : passes_of(header)) {
    HYPERMAP_TRY(read_pass(header, pass, rows, writer));
  }
  HYPERMAP_TRY(rows.finish());
  return writer.take();
}

}  // namespace

Result<Picture> decode_png(std::string_view bytes,
                           const SourceName& source,
                           const PictureLimits& limits) {
  try {
    auto picture = decode(bytes, limits);
    if (!picture) return tl::make_unexpected(with_source(picture.error(), source));
    return picture;
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(with_source(out_of_memory(), source));
  }
}

}  // namespace hypermap
