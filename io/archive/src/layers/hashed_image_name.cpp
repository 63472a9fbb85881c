// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/hashed_image_name.hpp"

#include "hypermap/io/archive/provenance.hpp"

#include <cstddef>

namespace hypermap {
namespace {

constexpr std::size_t kHashDigits = 16;
constexpr std::string_view kImageSuffix = ".pgm";

}  // namespace

std::string hashed_image_name(std::string_view stem, std::string_view image) {
  InputHash hash;
  hash.add(image);
  const std::string text = hash.text();
  std::string name(stem);
  name += "-";
  name += text.substr(text.size() - kHashDigits);
  return name += kImageSuffix;
}

std::optional<std::string_view> stem_of_hashed_name(std::string_view name) {
  constexpr std::size_t kEndBytes = 1 + kHashDigits + kImageSuffix.size();
  if (name.size() <= kEndBytes || !name.ends_with(kImageSuffix)) return std::nullopt;
  const std::string_view end = name.substr(name.size() - kEndBytes);
  const std::size_t behind_digits = end.find_first_not_of("0123456789abcdef", 1);
  if (end.front() != '-' || behind_digits != 1 + kHashDigits) return std::nullopt;
  return name.substr(0, name.size() - kEndBytes);
}

}  // namespace hypermap
