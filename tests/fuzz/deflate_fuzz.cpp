// SPDX-License-Identifier: BSD-3-Clause
// A raw deflate stream behind two bytes that say how much it claims to hold.
#include "fuzz_target.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "targets.hpp"
#include "zip/deflate.hpp"

#include <cstdint>

namespace hypermap::fuzz {

void fuzz_deflate(std::string_view bytes) {
  if (bytes.size() < 2) return;
  const auto low = static_cast<unsigned char>(bytes[0]);
  const auto high = static_cast<unsigned char>(bytes[1]);
  const std::uint64_t num_bytes = low + 256U * high;
  const auto content = unpack(bytes.substr(2), num_bytes, LoadBudget());
  if (!content) return;
  require(content->size() == num_bytes, "a stream gives as much as it claims");
  for (const Packing packing : {Packing::kBest, Packing::kHuffmanOnly}) {
    const auto packed = pack(*content, packing);
    const auto again = unpack(require(packed, "content can be packed"), num_bytes, LoadBudget());
    require(require(again, "what was packed is unpacked") == *content, "packing loses nothing");
  }
}

}  // namespace hypermap::fuzz
