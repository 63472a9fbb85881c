// SPDX-License-Identifier: BSD-3-Clause
#include "member_files.hpp"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

Unexpected of_member(Error error, const std::string& name) {
  error.entry = name;
  return tl::make_unexpected(std::move(error));
}

}  // namespace

Result<MemberFile> packed_file(MemberFile file, const ZipLimits& limits) {
  if (file.packed) return file;
  auto packed = packed_member(file.name, file.bytes, limits);
  if (!packed) return of_member(std::move(packed).error(), file.name);
  return MemberFile{.name = std::move(file.name), .bytes = {}, .packed = *std::move(packed)};
}

void append_files(std::vector<MemberFile>& files, std::vector<OpaqueFile> more) {
  files.reserve(files.size() + more.size());
  for (OpaqueFile& file : more)
    files.push_back({.name = std::move(file.name), .bytes = std::move(file.bytes)});
}

Result<std::string> zip_of(std::vector<MemberFile> files, const ZipLimits& limits) {
  std::vector<std::optional<Result<MemberFile>>> packed(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    packed[i] = packed_file(std::move(files[i]), limits);
  });
  ZipWriter writer(limits);
  for (std::optional<Result<MemberFile>>& one : packed) {
    HYPERMAP_ASSIGN_OR_RETURN(MemberFile file, *std::move(one));
    auto added = writer.add(*std::move(file.packed));
    if (!added) return of_member(std::move(added).error(), file.name);
  }
  return writer.finish();
}

}  // namespace hypermap
