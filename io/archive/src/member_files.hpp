// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The members of an archive that is being written.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "hypermap/projection/layers/hypermap.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// One of them, packed already where that is done beside other work.
struct MemberFile {
  std::string name;
  std::string bytes;                                  ///< None where they are packed.
  std::optional<PackedMember> packed = std::nullopt;  ///< Under `name`.
};

/// Packs it and gives its bytes free. Errors: those of packed_member, naming the member.
[[nodiscard]] Result<MemberFile> packed_file(MemberFile file, const ZipLimits& limits);

/// Puts `more` behind `files`.
void append_files(std::vector<MemberFile>& files, std::vector<OpaqueFile> more);

/// The archive of these members, those packed at the same time that are not yet, in any threads of
/// the caller's arena. Errors: those of packed_file and of ZipWriter, naming the member.
[[nodiscard]] Result<std::string> zip_of(std::vector<MemberFile> files, const ZipLimits& limits);

}  // namespace hypermap
