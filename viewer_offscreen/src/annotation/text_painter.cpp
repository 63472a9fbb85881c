// SPDX-License-Identifier: BSD-3-Clause
#include "text_painter.hpp"

#include "hypermap/core/base/utf8.hpp"
#include "rendering/address_space.hpp"

#include <opencv2/core.hpp>
#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 5> kFontFolders{"/usr/share/fonts/truetype/dejavu",
                                                       "/usr/share/fonts/dejavu-sans-fonts",
                                                       "/usr/share/fonts/dejavu",
                                                       "/usr/share/fonts/TTF",
                                                       "/usr/local/share/fonts/dejavu"};
// Of Debian's fonts-noto-cjk, fonts-wqy-zenhei, fonts-wqy-microhei and fonts-droid-fallback, of
// Fedora's and of Arch Linux's packages of Noto.
constexpr std::array<std::string_view, 6> kEastAsianFonts{
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/usr/share/fonts/google-noto-sans-cjk-fonts/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc"};
constexpr int kShift = 4;  // OpenCV draws at 1/16 of a pixel

/// The image's pixels as OpenCV sees them; red stays first, so colours are given in that order.
cv::Mat pixels_of(ColorImage& image) {
  return {image.height_px(), image.width_px(), CV_8UC3, image.pixels().data()};
}

cv::Scalar scalar_of(Rgb8 color) {
  return {double(color.r), double(color.g), double(color.b)};
}

cv::Point fine_point(double x_px, double y_px) {
  constexpr double kUnits = 1 << kShift;
  return {static_cast<int>(std::lround(x_px * kUnits)),
          static_cast<int>(std::lround(y_px * kUnits))};
}

/// FreeType maps the file and has tables of less than its size beside it; this is ample for both.
constexpr std::size_t kTimesFontSize = 4;

/// Whether a font could not be loaded for want of memory: FreeType does not say why.
bool is_short_of_memory_for(const std::filesystem::path& file) {
  std::error_code unknown;
  const auto num_bytes = std::filesystem::file_size(file, unknown);
  return !unknown && num_bytes > 0 && !has_address_space(kTimesFontSize * num_bytes);
}

/// None when the file holds no font. Throws std::bad_alloc.
cv::Ptr<cv::freetype::FreeType2> load_font(const std::filesystem::path& file) {
  try {
    cv::Ptr<cv::freetype::FreeType2> font = cv::freetype::createFreeType2();
    font->loadFontData(file.string(), 0);
    return font;
  } catch (const cv::Exception& exception) {
    if (exception.code == cv::Error::StsNoMem || is_short_of_memory_for(file)) {
      throw std::bad_alloc();
    }
    return nullptr;
  }
}

/// The first of the folders that holds a readable font file of this name.
cv::Ptr<cv::freetype::FreeType2> find_font(std::string_view name) {
  for (const std::string_view folder : kFontFolders) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    if (auto font = load_font(file)) return font;
  }
  return nullptr;
}

Unexpected no_font() {
  std::string places;
  for (const std::string_view folder : kFontFolders) {
    places += (places.empty() ? "" : ", ") + std::string(folder);
  }
  return fail(ErrorCode::kUnavailable,
              "images need the font DejaVuSans.ttf, looked in " + places +
                  "; install it (Debian: fonts-dejavu-core) or name a font file");
}

/// Where the last whole character of UTF-8 before `end` begins.
std::size_t previous_character(const std::string& text, std::size_t end) {
  do {
    --end;
  } while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U);
  return end;
}

/// Scripts of Chinese, Japanese and Korean, as three bytes of UTF-8 from U+2E80 to U+9FFF, U+AC00
/// to U+D7AF, U+F900 to U+FAFF and U+FF00 to U+FFEF, or four from U+20000 to U+3FFFF.
bool is_east_asian(std::string_view character) {
  constexpr std::array<std::array<std::string_view, 2>, 5> kRanges{{{"\u2E80", "\u9FFF"},
                                                                    {"\uAC00", "\uD7AF"},
                                                                    {"\uF900", "\uFAFF"},
                                                                    {"\uFF00", "\uFFEF"},
                                                                    {"\U00020000", "\U0003FFFF"}}};
  // Bytes of UTF-8 are ordered as the letters that they stand for.
  return std::any_of(kRanges.begin(), kRanges.end(), [&](const auto& range) {
    return range[0] <= character && character <= range[1];
  });
}

bool has_east_asian(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, at), 1);
    if (is_east_asian(text.substr(at, length))) return true;
    at += length;
  }
  return false;
}

cv::Ptr<cv::freetype::FreeType2> find_east_asian_font() {
  for (const std::string_view file : kEastAsianFonts) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    if (auto font = load_font(file)) return font;
  }
  return nullptr;
}

}  // namespace

struct TextPainter::Impl {
  cv::Ptr<cv::freetype::FreeType2> regular;
  cv::Ptr<cv::freetype::FreeType2> bold;
  cv::Ptr<cv::freetype::FreeType2> east_asian;  ///< None where no system font has its letters.

  [[nodiscard]] cv::freetype::FreeType2& font(const std::string& text, FontWeight weight) const {
    if (east_asian != nullptr && has_east_asian(text)) return *east_asian;
    return weight == FontWeight::kBold ? *bold : *regular;
  }
};

TextPainter::TextPainter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TextPainter::TextPainter(TextPainter&&) noexcept = default;
TextPainter& TextPainter::operator=(TextPainter&&) noexcept = default;
TextPainter::~TextPainter() = default;

Result<TextPainter> TextPainter::create(const std::filesystem::path& font_file) try {
  auto impl = std::make_unique<Impl>();
  if (!font_file.empty()) {
    impl->regular = load_font(font_file);
    impl->bold = impl->regular;
    impl->east_asian = impl->regular;
    if (impl->regular != nullptr) return TextPainter(std::move(impl));
    return fail(ErrorCode::kNotFound, "no readable font: " + printable(font_file.string()), "font");
  }
  impl->regular = find_font("DejaVuSans.ttf");
  if (impl->regular == nullptr) return no_font();
  impl->bold = find_font("DejaVuSans-Bold.ttf");
  if (impl->bold == nullptr) impl->bold = impl->regular;
  impl->east_asian = find_east_asian_font();
  return TextPainter(std::move(impl));
} catch (const std::bad_alloc&) {
  return fail(ErrorCode::kOutOfMemory, "no memory for a font");
}

bool TextPainter::can_write(const std::string& text) const {
  return impl_->east_asian != nullptr || !has_east_asian(text);
}

double TextPainter::width_px(const std::string& text, const TextStyle& style) const {
  if (text.empty()) return 0.0;
  int below_px = 0;
  return impl_->font(text, style.weight).getTextSize(text, style.height_px, -1, &below_px).width;
}

std::string TextPainter::fitted(const std::string& text,
                                const TextStyle& style,
                                double max_width_px) const {
  if (width_px(text, style) <= max_width_px) return text;
  std::size_t end = text.size();
  while (end > 0) {
    end = previous_character(text, end);
    std::string shorter = text.substr(0, end) + "…";
    if (width_px(shorter, style) <= max_width_px) return shorter;
  }
  return {};
}

void TextPainter::write(ColorImage& image,
                        const std::string& text,
                        double x_px,
                        double baseline_px,
                        const TextStyle& style) const {
  if (text.empty()) return;
  cv::Mat pixels = pixels_of(image);
  const cv::Point place(static_cast<int>(std::lround(x_px)),
                        static_cast<int>(std::lround(baseline_px)));
  impl_->font(text, style.weight)
      .putText(pixels, text, place, style.height_px, scalar_of(style.color), -1, cv::LINE_AA, true);
}

void draw_plate(
    ColorImage& image, const ImageRect& rect, double radius_px, Rgb8 color, double opacity) {
  cv::Mat pixels = pixels_of(image);
  const cv::Rect whole(0, 0, pixels.cols, pixels.rows);
  const cv::Rect around(static_cast<int>(std::floor(rect.x_px)) - 1,
                        static_cast<int>(std::floor(rect.y_px)) - 1,
                        static_cast<int>(std::ceil(rect.width_px)) + 3,
                        static_cast<int>(std::ceil(rect.height_px)) + 3);
  const cv::Rect part = around & whole;
  if (part.area() == 0) return;
  const Eigen::Vector2d half(0.5 * rect.width_px, 0.5 * rect.height_px);
  const Eigen::Vector2d centre = Eigen::Vector2d(rect.x_px, rect.y_px) + half;
  const double radius = std::min(radius_px, half.minCoeff());
  for (int v = part.y; v < part.y + part.height; ++v) {
    for (int u = part.x; u < part.x + part.width; ++u) {
      // Signed distance to a rectangle with round corners; half a pixel of it is blended.
      const Eigen::Vector2d beyond = (Eigen::Vector2d(u + 0.5, v + 0.5) - centre).cwiseAbs() -
                                     half + Eigen::Vector2d::Constant(radius);
      const double distance =
          beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - radius;
      const double cover = opacity * std::clamp(0.5 - distance, 0.0, 1.0);
      Rgb8& pixel = image.at(u, v);
      const auto mix = [cover](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + cover * (to - from)));
      };
      pixel = {mix(pixel.r, color.r), mix(pixel.g, color.g), mix(pixel.b, color.b)};
    }
  }
}

void draw_line(ColorImage& image,
               const Eigen::Vector2d& from_px,
               const Eigen::Vector2d& to_px,
               double width_px,
               Rgb8 color) {
  cv::Mat pixels = pixels_of(image);
  cv::line(pixels,
           fine_point(from_px.x(), from_px.y()),
           fine_point(to_px.x(), to_px.y()),
           scalar_of(color),
           std::max(1, static_cast<int>(std::lround(width_px))),
           cv::LINE_AA,
           kShift);
}

void draw_disc(ColorImage& image, const Eigen::Vector2d& centre_px, double radius_px, Rgb8 color) {
  cv::Mat pixels = pixels_of(image);
  cv::circle(pixels,
             fine_point(centre_px.x(), centre_px.y()),
             static_cast<int>(std::lround(radius_px * (1 << kShift))),
             scalar_of(color),
             cv::FILLED,
             cv::LINE_AA,
             kShift);
}

}  // namespace hypermap
