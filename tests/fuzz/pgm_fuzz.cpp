// SPDX-License-Identifier: BSD-3-Clause
// Grey maps of 8 bit are written, too.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "image_oracle.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_pgm(std::string_view bytes) {
  if (!bytes.starts_with("P")) return;
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<Image<std::uint8_t>> {
        HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, checked_image(text));
        return to_gray8(image);
      },
      [](const Image<std::uint8_t>& image) { return encode_pgm(image); });
}

}  // namespace hypermap::fuzz
