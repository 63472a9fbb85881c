// SPDX-License-Identifier: BSD-3-Clause
//
// libjpeg's errors end in stop(), which returns to the setjmp of compress(): between the two no
// object with a destructor lives.
#include "hypermap/io/codec/jpeg_writer.hpp"

#include "image_limits.hpp"

// In this order: jpeglib.h needs FILE, jerror.h what jpeglib.h says of the build.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <array>
#include <cassert>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>

namespace hypermap {
namespace {

static_assert(sizeof(Rgb8) == 3, "rows are handed on as they lie");

/// What libjpeg works on; its client_data points here.
struct JpegCompression {
  JpegCompression() = default;
  JpegCompression(const JpegCompression&) = delete;
  JpegCompression& operator=(const JpegCompression&) = delete;
  JpegCompression(JpegCompression&&) = delete;
  JpegCompression& operator=(JpegCompression&&) = delete;
  ~JpegCompression() {
    jpeg_destroy_compress(&info);
    std::free(bytes);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg's own
  }

  [[noreturn]] static void stop(j_common_ptr common) {
    auto& state = *static_cast<JpegCompression*>(common->client_data);
    state.errors.format_message(common, state.message.data());
    std::longjmp(state.call, 1);  // NOLINT(cert-err52-cpp): libjpeg's way out
  }

  /// False when it ended in stop().
  bool compress(const ColorImage& image, int quality) {
    if (setjmp(call) != 0) return false;  // NOLINT(cert-err52-cpp): libjpeg's way out
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, &bytes, &num_bytes);
    info.image_width = static_cast<JDIMENSION>(image.width_px());
    info.image_height = static_cast<JDIMENSION>(image.height_px());
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    info.dct_method = JDCT_ISLOW;
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < info.image_height) {
      const auto* row = &image.at(0, static_cast<int>(info.next_scanline));
      // libjpeg only reads it.
      auto* samples = const_cast<JSAMPROW>(reinterpret_cast<const JSAMPLE*>(row));
      jpeg_write_scanlines(&info, &samples, 1);
    }
    jpeg_finish_compress(&info);
    return true;
  }

  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  std::jmp_buf call{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  unsigned char* bytes = nullptr;
  unsigned long num_bytes = 0;  // NOLINT(google-runtime-int): libjpeg's type
};

}  // namespace

Result<std::string> encode_jpeg(const ColorImage& image, int quality) {
  assert(!image.empty() && quality >= 1 && quality <= 100);
  JpegCompression state;
  state.info.err = jpeg_std_error(&state.errors);
  state.info.client_data = &state;
  state.errors.error_exit = JpegCompression::stop;
  if (state.compress(image, quality)) {
    return std::string(reinterpret_cast<const char*>(state.bytes), state.num_bytes);
  }
  if (state.errors.msg_code == JERR_OUT_OF_MEMORY) return tl::make_unexpected(out_of_memory());
  return fail(ErrorCode::kInvalidArgument,
              std::string("cannot be encoded: ") + state.message.data());
}

}  // namespace hypermap
