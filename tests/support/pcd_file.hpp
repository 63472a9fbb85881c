// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads organised, compressed PCD clouds for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hypermap::test {

/// Fields of 4 bytes each, by name, one value per point.
struct PcdCloud {
  int width = 0;
  int height = 0;
  std::map<std::string, std::vector<std::uint32_t>> fields;

  [[nodiscard]] float number(const std::string& field, std::size_t point) const {
    float value = 0.0F;
    std::memcpy(&value, &fields.at(field)[point], sizeof value);
    return value;
  }
};

/// LZF: a control byte below 32 announces literals, another a back reference.
inline std::vector<char> decompress_lzf(const std::vector<unsigned char>& in, std::size_t size) {
  std::vector<char> out;
  out.reserve(size);
  for (std::size_t at = 0; at < in.size();) {
    const unsigned control = in.at(at++);
    if (control < 32) {
      for (unsigned i = 0; i <= control; ++i) out.push_back(static_cast<char>(in.at(at++)));
      continue;
    }
    unsigned length = control >> 5U;
    if (length == 7) length += in.at(at++);
    const std::size_t offset = ((control & 31U) << 8U) + in.at(at++) + 1U;
    for (unsigned i = 0; i < length + 2; ++i) out.push_back(out.at(out.size() - offset));
  }
  if (out.size() != size) throw std::runtime_error("LZF: unexpected size");
  return out;
}

inline PcdCloud read_pcd(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  PcdCloud cloud;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "FIELDS") names.assign(std::istream_iterator<std::string>(words), {});
    if (key == "WIDTH") words >> cloud.width;
    if (key == "HEIGHT") words >> cloud.height;
    if (key == "DATA") break;
  }
  std::uint32_t sizes[2] = {0, 0};
  file.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  std::vector<unsigned char> packed(sizes[0]);
  file.read(reinterpret_cast<char*>(packed.data()), sizes[0]);
  const std::vector<char> bytes = decompress_lzf(packed, sizes[1]);
  const std::size_t points =
      static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<std::uint32_t>& field = cloud.fields[names[i]];
    field.resize(points);
    std::memcpy(field.data(), bytes.data() + 4 * points * i, 4 * points);
  }
  return cloud;
}

}  // namespace hypermap::test
