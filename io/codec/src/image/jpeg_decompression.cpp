// SPDX-License-Identifier: BSD-3-Clause
//
// It and jpeg_writer.cpp alone know libjpeg. Its errors end in jump_back(), which returns to the
// setjmp of the running call: between the two no object with a destructor lives.
#include "jpeg_decompression.hpp"

#include "image_limits.hpp"

// In this order: jpeglib.h needs FILE, jerror.h what jpeglib.h says of the build.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <array>
#include <csetjmp>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr int kMaxScans = 500;
constexpr int kCmyk = 4;

/// Adobe's inverted CMYK, as OpenCV mixes it.
void write_rgb_of_cmyk(std::span<const std::uint8_t> cmyk, std::uint8_t* rgb) {
  for (std::size_t i = 0; i < cmyk.size() / kCmyk; ++i) {
    const int black = cmyk[4 * i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const int ink = 255 - cmyk[4 * i + c];
      rgb[3 * i + c] = static_cast<std::uint8_t>(black - ((ink * black) >> 8));
    }
  }
}

bool loses_pixels(int warning) {
  return warning == JWRN_HIT_MARKER || warning == JWRN_HUFF_BAD_CODE || warning == JWRN_JPEG_EOF ||
         warning == JWRN_MUST_RESYNC || warning == JWRN_ARITH_BAD_CODE;
}

}  // namespace

/// What libjpeg works on; its client_data points here.
struct JpegDecompression::State {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf call{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  std::vector<std::uint8_t> cmyk_row = {};  ///< Empty unless the JPEG has four components.

  static State& of(j_common_ptr common) { return *static_cast<State*>(common->client_data); }

  [[noreturn]] void jump_back() {
    std::longjmp(call, 1);  // NOLINT(cert-err52-cpp): libjpeg's way out
  }

  [[noreturn]] static void stop(j_common_ptr common) {
    State& state = of(common);
    state.errors.format_message(common, state.message.data());
    state.jump_back();
  }

  static void watch_message(j_common_ptr common, int level) {
    if (level < 0 && loses_pixels(common->err->msg_code)) stop(common);
  }

  static void watch_scans(j_common_ptr common) {
    State& state = of(common);
    if (state.info.input_scan_number <= kMaxScans) return;
    std::snprintf(state.message.data(), state.message.size(), "has over %d scans", kMaxScans);
    state.jump_back();
  }

  /// Does `work`; false when it ended in jump_back(). Requires: nothing in it has a destructor.
  template <class Work>
  bool runs_through(Work work) {
    if (setjmp(call) != 0) return false;  // NOLINT(cert-err52-cpp): libjpeg's way out
    work();
    return true;
  }

  [[nodiscard]] Unexpected error() const {
    if (errors.msg_code == JERR_OUT_OF_MEMORY) return tl::make_unexpected(out_of_memory());
    return fail(
        ErrorCode::kMalformedFile, std::string("cannot be decoded: ") + message.data(), "raster");
  }
};

JpegDecompression::JpegDecompression() : state_(std::make_unique<State>()) {
  state_->info.err = jpeg_std_error(&state_->errors);
  state_->info.client_data = state_.get();
  state_->errors.error_exit = State::stop;
  state_->errors.emit_message = State::watch_message;
  state_->progress.progress_monitor = State::watch_scans;
}

JpegDecompression::~JpegDecompression() {
  jpeg_destroy_decompress(&state_->info);
}

Result<void> JpegDecompression::read_header(std::string_view bytes) {
  State& state = *state_;
  const bool is_read = state.runs_through([&state, bytes] {
    jpeg_create_decompress(&state.info);
    state.info.progress = &state.progress;
    jpeg_mem_src(&state.info,
                 reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));  // NOLINT(google-runtime-int)
    jpeg_read_header(&state.info, TRUE);
  });
  if (!is_read) return state.error();
  const int components = state.info.num_components;
  if (components == kCmyk) {
    state.info.out_color_space = JCS_CMYK;
    state.cmyk_row.resize(kCmyk * std::size_t{state.info.image_width});
  } else {
    state.info.out_color_space = components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  }
  return {};
}

int JpegDecompression::width_px() const {
  return static_cast<int>(state_->info.image_width);
}

int JpegDecompression::height_px() const {
  return static_cast<int>(state_->info.image_height);
}

int JpegDecompression::channels() const {
  return state_->info.num_components == 1 ? 1 : 3;
}

Result<void> JpegDecompression::read_rows(std::span<std::uint8_t> samples) {
  State& state = *state_;
  const std::size_t row_bytes =
      static_cast<std::size_t>(width_px()) * static_cast<std::size_t>(channels());
  const bool is_read = state.runs_through([&state, samples, row_bytes] {
    jpeg_start_decompress(&state.info);
    while (state.info.output_scanline < state.info.output_height) {
      std::uint8_t* const target = samples.data() + state.info.output_scanline * row_bytes;
      std::uint8_t* row = state.cmyk_row.empty() ? target : state.cmyk_row.data();
      jpeg_read_scanlines(&state.info, &row, 1);
      if (!state.cmyk_row.empty()) write_rgb_of_cmyk(state.cmyk_row, target);
    }
    jpeg_finish_decompress(&state.info);
  });
  if (!is_read) return state.error();
  return {};
}

}  // namespace hypermap
