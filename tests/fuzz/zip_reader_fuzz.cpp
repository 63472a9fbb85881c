// SPDX-License-Identifier: BSD-3-Clause
// What the zip reader takes, the zip writer can write, and that is read again equal and written
// again to the same bytes; the rest is refused.
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_writer.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

using Members = std::map<std::string, std::string>;

constexpr ZipLimits kFuzzLimits{.max_archive_bytes = 1U << 20U,
                                .max_entries = 64,
                                .max_entry_bytes = 1U << 22U,
                                .max_total_bytes = 1U << 24U};

void require(bool holds) {
  if (!holds) std::abort();
}

/// All members of an archive; none when reader or inflater refuse it.
std::optional<Members> members_of(std::string_view bytes) {
  const auto zip = ZipReader::create(view_bytes(bytes), kFuzzLimits);
  if (!zip) return std::nullopt;
  Members members;
  for (const ZipMember& member : zip->members()) {
    auto content = zip->read(member.name, kFuzzLimits.max_entry_bytes);
    if (!content) return std::nullopt;
    require(content->size() == member.num_bytes);
    require(members.emplace(member.name, *std::move(content)).second);
  }
  return members;
}

std::string written(const Members& members) {
  ZipWriter writer(kFuzzLimits);
  for (const auto& [name, content] : members) require(writer.add(name, content).has_value());
  auto bytes = writer.finish();
  require(bytes.has_value());
  return *std::move(bytes);
}

}  // namespace
}  // namespace hypermap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT
  using namespace hypermap;                                                          // NOLINT
  const auto members = members_of({reinterpret_cast<const char*>(data), size});
  if (!members) return 0;
  const std::string bytes = written(*members);
  const auto again = members_of(bytes);
  require(again == members);
  require(written(*again) == bytes);
  return 0;
}
