// SPDX-License-Identifier: BSD-3-Clause
#include "utf8.hpp"

#include <cstddef>

namespace hypermap {
namespace {

/// What may follow a lead byte: how many bytes, and the range of the first of them.
struct Sequence {
  std::size_t num_following = 0;
  unsigned char min_second = 0x80;
  unsigned char max_second = 0xbf;
  bool valid = true;
};

Sequence sequence_of(unsigned char lead) {
  if (lead < 0x80) return {};
  if (lead >= 0xc2 && lead <= 0xdf) return {.num_following = 1};
  if (lead == 0xe0) return {.num_following = 2, .min_second = 0xa0};
  if (lead == 0xed) return {.num_following = 2, .max_second = 0x9f};
  if (lead >= 0xe1 && lead <= 0xef) return {.num_following = 2};
  if (lead == 0xf0) return {.num_following = 3, .min_second = 0x90};
  if (lead >= 0xf1 && lead <= 0xf3) return {.num_following = 3};
  if (lead == 0xf4) return {.num_following = 3, .max_second = 0x8f};
  return {.valid = false};
}

}  // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Sequence sequence = sequence_of(static_cast<unsigned char>(text[i]));
    if (!sequence.valid || sequence.num_following > text.size() - i - 1) return false;
    for (std::size_t k = 1; k <= sequence.num_following; ++k) {
      const auto byte = static_cast<unsigned char>(text[i + k]);
      const unsigned char min = k == 1 ? sequence.min_second : 0x80;
      const unsigned char max = k == 1 ? sequence.max_second : 0xbf;
      if (byte < min || byte > max) return false;
    }
    i += sequence.num_following;
  }
  return true;
}

}  // namespace hypermap
