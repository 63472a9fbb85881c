// SPDX-License-Identifier: BSD-3-Clause
// Images of one and of three channels are written, too.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "image_oracle.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_png(std::string_view bytes) {
  if (!bytes.starts_with("\x89PNG")) return;
  const auto image = checked_image(bytes);
  if (!image) return;
  const auto read_as = [](auto convert) {
    return [convert](std::string_view text) -> decltype(convert(DecodedImage{})) {
      HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage decoded, checked_image(text));
      return convert(decoded);
    };
  };
  const auto write = [](const auto& pixels) { return encode_png(pixels, PngEffort::kFast); };
  require_round_trip(bytes, read_as(to_gray8), write);
  require_round_trip(bytes, read_as(to_gray16), write);
  const auto colors = [](const DecodedImage& decoded) -> Result<ColorImage> {
    return to_color(decoded);
  };
  require_round_trip(bytes, read_as(colors), write);
}

}  // namespace hypermap::fuzz
