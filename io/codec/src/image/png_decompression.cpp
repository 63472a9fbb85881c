// SPDX-License-Identifier: BSD-3-Clause
//
// The only file that knows libpng. Its errors end in stop(), which jumps back to the setjmp of
// begin() or feed(): between the two no object with a destructor lives. Its progressive reader is
// used because that one alone insists on the end of the compressed stream.
#include "png_decompression.hpp"

#include "image_limits.hpp"

#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <span>
#include <string>

namespace hypermap {
namespace {

/// A libpng reader; libpng's pointers of users point here.
struct PngStream {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::span<std::uint8_t> pixels = {};
  std::size_t row_bytes = 0;
  bool is_interlaced = false;
  bool is_whole = false;  ///< All rows came.
  bool is_out_of_memory = false;
  std::array<char, 128> message{};

  PngStream() = default;
  PngStream(const PngStream&) = delete;
  PngStream& operator=(const PngStream&) = delete;
  PngStream(PngStream&&) = delete;
  PngStream& operator=(PngStream&&) = delete;
  ~PngStream() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void stop(png_structp png, png_const_charp message) {
  auto& stream = *static_cast<PngStream*>(png_get_error_ptr(png));
  std::snprintf(stream.message.data(), stream.message.size(), "%s", message);
  png_longjmp(png, 1);
}

png_voidp allocate(png_structp png, png_alloc_size_t size) {
  void* const memory = std::malloc(size);  // NOLINT: libpng's own way
  if (memory == nullptr) static_cast<PngStream*>(png_get_mem_ptr(png))->is_out_of_memory = true;
  return memory;
}

void release(png_structp /*png*/, png_voidp memory) {
  std::free(memory);  // NOLINT: libpng's own way
}

PngStream& stream_of(png_structp png) {
  return *static_cast<PngStream*>(png_get_progressive_ptr(png));
}

/// The header and what stands before the pixels are read: says in which form rows are wanted.
void choose_form(png_structp png, png_infop info) {
  PngStream& stream = stream_of(png);
  const bool has_alpha = png_get_valid(png, info, PNG_INFO_tRNS) != 0;
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE) {
    png_set_packing(png);
  } else {
    png_set_expand_gray_1_2_4_to_8(png);
    if (has_alpha) png_set_tRNS_to_alpha(png);
  }
  if (std::endian::native == std::endian::little) png_set_swap(png);
  if (stream.is_interlaced) png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != stream.row_bytes) png_error(png, "rows of another size");
}

void take_row(png_structp png, png_bytep row, png_uint_32 v, int /*pass*/) {
  const PngStream& stream = stream_of(png);
  std::uint8_t* const target = stream.pixels.subspan(v * stream.row_bytes, stream.row_bytes).data();
  png_progressive_combine_row(png, target, row);
}

void take_end(png_structp png, png_infop info) {
  constexpr int kPassesOfAdam7 = 7;
  PngStream& stream = stream_of(png);
  stream.is_whole = stream.is_interlaced
                        ? png_get_current_pass_number(png) == kPassesOfAdam7
                        : png_get_current_row_number(png) == png_get_image_height(png, info);
}

bool create(PngStream& stream) {
  stream.png = png_create_read_struct_2(
      PNG_LIBPNG_VER_STRING, &stream, stop, stop, &stream, allocate, release);
  if (stream.png == nullptr) return false;
  stream.info = png_create_info_struct(stream.png);
  return stream.info != nullptr;
}

/// False when libpng complains of the settings.
bool begin(PngStream& stream) {
  if (setjmp(png_jmpbuf(stream.png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  png_set_progressive_read_fn(stream.png, &stream, choose_form, take_row, take_end);
  // Sides, CRCs and the size of the file were checked already.
  png_set_user_limits(stream.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_chunk_malloc_max(stream.png, 0);
  png_set_crc_action(stream.png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
  return true;
}

/// False when libpng complains of the bytes.
bool feed(PngStream& stream, std::string_view bytes) {
  if (setjmp(png_jmpbuf(stream.png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  // libpng does not write through it; its type is older than const.
  auto* const data = reinterpret_cast<png_bytep>(const_cast<char*>(bytes.data()));  // NOLINT
  png_process_data(stream.png, stream.info, data, bytes.size());
  return true;
}

Result<void> feed_all(PngStream& stream,
                      std::span<const std::string_view> chunks,
                      const LoadBudget& budget) {
  constexpr std::size_t kPieceBytes = std::size_t{1} << 14U;
  bool is_fed = begin(stream);
  for (std::string_view rest : chunks) {
    while (is_fed && !rest.empty()) {
      HYPERMAP_TRY(budget.check_stop());
      const std::string_view piece = rest.substr(0, kPieceBytes);
      rest.remove_prefix(piece.size());
      is_fed = feed(stream, piece);
    }
  }
  if (stream.is_out_of_memory) throw std::bad_alloc();
  if (is_fed) return {};
  return fail(ErrorCode::kMalformedFile,
              std::string("cannot be decoded: ") + stream.message.data(),
              "IDAT");
}

/// An image of the layout's size, its samples still 0.
DecodedImage blank_image(const PngLayout& layout) {
  const PngHeader& header = layout.header;
  const bool has_key = header.color != PngColor::kPalette && !layout.transparency.empty();
  DecodedImage image{.width_px = static_cast<int>(header.width_px),
                     .height_px = static_cast<int>(header.height_px),
                     .channels = stored_channels(header.color) + (has_key ? 1 : 0),
                     .bits = header.bits == 16 ? 16 : 8,
                     .max_value = header.bits == 16 ? 65'535 : 255};
  const std::size_t count = image.num_pixels() * static_cast<std::size_t>(image.channels);
  if (header.bits == 16) {
    image.samples16.resize(count);
  } else {
    image.samples8.resize(count);
  }
  return image;
}

std::span<std::uint8_t> bytes_of(DecodedImage& image) {
  if (image.bits == 8) return image.samples8;
  return {reinterpret_cast<std::uint8_t*>(image.samples16.data()), 2 * image.samples16.size()};
}

}  // namespace

Result<DecodedImage> decompress_png(const PngLayout& layout, const LoadBudget& budget) {
  DecodedImage image = blank_image(layout);
  PngStream stream;
  stream.pixels = bytes_of(image);
  stream.row_bytes = stream.pixels.size() / static_cast<std::size_t>(image.height_px);
  stream.is_interlaced = layout.header.interlaced;
  if (!create(stream)) throw std::bad_alloc();
  HYPERMAP_TRY(feed_all(stream, layout.chunks, budget));
  if (!stream.is_whole) return fail(ErrorCode::kMalformedFile, "holds too few pixels", "IDAT");
  return image;
}

}  // namespace hypermap
