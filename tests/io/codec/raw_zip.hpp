// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Zip files put together header by header, so that a test can let any field lie.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::test {

/// A member whose central header says one thing and whose local header may say another.
struct RawMember {
  std::string name;
  std::string data;  ///< As it lies in the file.
  std::uint16_t method = 0;
  std::uint16_t flags = 0;
  std::uint32_t crc = 0;
  std::uint32_t num_bytes = 0;
  std::uint32_t num_packed_bytes = 0;
  std::uint16_t made_by = 3U << 8U;
  std::uint32_t attributes = 0100644U << 16U;
  std::string extra = {};
  std::string descriptor = {};
  std::optional<std::string> local_name = {};
  std::optional<std::uint16_t> local_method = {};
  std::optional<std::uint32_t> local_crc = {};
  std::optional<std::uint32_t> local_num_bytes = {};
  std::optional<std::uint32_t> header_offset = {};
};

inline RawMember stored(const std::string& name, const std::string& content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(content.data()), size);
  return {.name = name,
          .data = content,
          .crc = static_cast<std::uint32_t>(crc),
          .num_bytes = size,
          .num_packed_bytes = size};
}

inline void put(std::string& out, std::uint64_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

inline std::string descriptor_of(const RawMember& m, bool with_signature) {
  std::string out;
  if (with_signature) put(out, 0x08074b50, 4);
  put(out, m.crc, 4);
  put(out, m.num_packed_bytes, 4);
  put(out, m.num_bytes, 4);
  return out;
}

inline std::string end_record(std::uint64_t entries,
                              std::uint64_t bytes,
                              std::uint64_t offset,
                              const std::string& comment = {}) {
  std::string out;
  put(out, 0x06054b50, 4);
  put(out, 0, 4);
  put(out, entries, 2);
  put(out, entries, 2);
  put(out, bytes, 4);
  put(out, offset, 4);
  put(out, comment.size(), 2);
  return out + comment;
}

inline std::string raw_zip(const std::vector<RawMember>& members, const std::string& comment = {}) {
  std::string out;
  std::string directory;
  for (const RawMember& m : members) {
    const std::uint64_t offset = m.header_offset.value_or(static_cast<std::uint32_t>(out.size()));
    const std::string& local_name = m.local_name ? *m.local_name : m.name;
    put(out, 0x04034b50, 4);
    put(out, 20, 2);
    put(out, m.flags, 2);
    put(out, m.local_method.value_or(m.method), 2);
    put(out, 0, 4);
    put(out, m.local_crc.value_or(m.crc), 4);
    put(out, m.num_packed_bytes, 4);
    put(out, m.local_num_bytes.value_or(m.num_bytes), 4);
    put(out, local_name.size(), 2);
    put(out, m.extra.size(), 2);
    out += local_name + m.extra + m.data + m.descriptor;

    put(directory, 0x02014b50, 4);
    put(directory, m.made_by, 2);
    put(directory, 20, 2);
    put(directory, m.flags, 2);
    put(directory, m.method, 2);
    put(directory, 0, 4);
    put(directory, m.crc, 4);
    put(directory, m.num_packed_bytes, 4);
    put(directory, m.num_bytes, 4);
    put(directory, m.name.size(), 2);
    put(directory, m.extra.size(), 2);
    put(directory, 0, 2);
    put(directory, 0, 4);
    put(directory, m.attributes, 4);
    put(directory, offset, 4);
    directory += m.name + m.extra;
  }
  const std::string end = end_record(members.size(), directory.size(), out.size(), comment);
  return out + directory + end;
}

}  // namespace hypermap::test
