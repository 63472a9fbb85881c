// SPDX-License-Identifier: BSD-3-Clause
#include "zip_content.hpp"

#include "deflate.hpp"
#include "hypermap/io/codec/checksum.hpp"

#include <utility>

namespace hypermap::zip {

Result<std::string> content_of(const ByteSource& source,
                               const ZipMember& member,
                               const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(
      std::string packed,
      source.read_at(member.data_offset, static_cast<std::size_t>(member.num_packed_bytes)));
  std::string content;
  if (member.deflated) {
    HYPERMAP_ASSIGN_OR_RETURN(content, unpack(packed, member.num_bytes, budget));
  } else {
    content = std::move(packed);
  }
  if (crc32_of(content) != member.crc32)
    return fail(ErrorCode::kMalformedFile, "CRC-32 of the content is wrong");
  return content;
}

}  // namespace hypermap::zip
