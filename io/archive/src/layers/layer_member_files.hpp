// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The members of one layer as files of an archive or of a folder.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Which layer's members these are.
struct LayerFiles {
  std::string stem;
  std::string owner;  ///< How errors call whoever names the stem ("layers[0].file").
  int version = 1;
};

class MemberFileReader final : public LayerReader {
 public:
  /// Requires: `members` and `limits` outlive the reader.
  MemberFileReader(ArchiveMembers& members, LayerFiles files, const ArchiveLimits& limits);

  [[nodiscard]] int version() const override { return files_.version; }
  [[nodiscard]] Result<std::string> bytes(std::string_view suffix) override;
  [[nodiscard]] Result<ValueTree> yaml(std::string_view suffix) override;
  [[nodiscard]] Result<OccupancyLayer> grid(std::string_view suffix) override;
  [[nodiscard]] Result<SemanticLayer> shapes(std::string_view suffix) override;

  /// The member read last; before the first one, the stem.
  [[nodiscard]] const SourceName& last_source() const noexcept { return last_source_; }
  /// What was noticed so far.
  [[nodiscard]] std::vector<Finding> take_findings() { return std::move(findings_); }

 private:
  [[nodiscard]] Result<std::string> take(std::string_view suffix, std::uint64_t max_bytes);
  void keep(std::vector<Finding> findings);

  ArchiveMembers& members_;
  LayerFiles files_;
  const ArchiveLimits& limits_;
  SourceName last_source_;
  std::vector<Finding> findings_;
};

class MemberFileWriter final : public LayerWriter {
 public:
  explicit MemberFileWriter(std::string stem) : stem_(std::move(stem)) {}

  [[nodiscard]] Result<void> bytes(std::string_view suffix, std::string bytes) override;
  [[nodiscard]] Result<void> yaml(std::string_view suffix, const ValueTree& tree) override;
  [[nodiscard]] Result<void> grid(std::string_view suffix, const OccupancyLayer& grid) override;
  [[nodiscard]] Result<void> shapes(std::string_view suffix, const SemanticLayer& shapes) override;

  /// In the order in which they were written.
  [[nodiscard]] std::vector<OpaqueFile> files() && { return std::move(files_); }

 private:
  [[nodiscard]] Result<void> put(OpaqueFile file);
  [[nodiscard]] std::string member(std::string_view suffix) const {
    return stem_ + std::string(suffix);
  }

  std::string stem_;
  std::vector<OpaqueFile> files_;
};

}  // namespace hypermap
