// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The files that a map's configuration names, wherever they lie.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/file_reach.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/projection/layers/hypermap.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Hands out each file once, so that no two parts of a map share one.
class ArchiveMembers {
 public:
  ArchiveMembers(std::string file, LoadBudget budget)
      : file_(std::move(file)), budget_(std::move(budget)) {}
  ArchiveMembers(const ArchiveMembers&) = delete;
  ArchiveMembers& operator=(const ArchiveMembers&) = delete;
  ArchiveMembers(ArchiveMembers&&) = delete;
  ArchiveMembers& operator=(ArchiveMembers&&) = delete;
  virtual ~ArchiveMembers() = default;

  /// How errors name a member.
  [[nodiscard]] virtual SourceName source_of(std::string_view name) const {
    return {.file = file_, .entry = std::string(name)};
  }

  /// The content of a member that `owner` ("layers[1].file") names.
  /// Errors: kMalformedFile with `field` = owner when the name leads out of the archive, another
  /// owner had it, or it is not there; those of ZipReader::read.
  [[nodiscard]] Result<std::string> take(std::string_view name,
                                         const std::string& owner,
                                         std::uint64_t max_bytes);

  /// The same of a member that is kept as it is. Its bytes are drawn from the budget before they
  /// are read. Errors: also those of LoadBudget::draw_opaque_bytes.
  [[nodiscard]] Result<std::string> take_opaque(std::string_view name,
                                                const std::string& owner,
                                                std::uint64_t max_bytes);

  /// Whether `name` may name a member. Errors: kMalformedFile with `field` = owner.
  [[nodiscard]] Result<void> check(std::string_view name, const std::string& owner) const;

  [[nodiscard]] virtual bool contains(std::string_view name) const = 0;
  /// At most the first `max_bytes` bytes of a member, which nobody takes by that. Not checked
  /// against its CRC. Errors: kNotFound; kIo; kMalformedFile.
  [[nodiscard]] virtual Result<std::string> start_of(std::string_view name,
                                                     std::size_t max_bytes) const = 0;
  /// Members that nobody took, in the order of their names. They are drawn from the budget before
  /// the first is read. Errors: those of take_opaque.
  [[nodiscard]] virtual Result<std::vector<OpaqueFile>> rest(std::uint64_t max_bytes) const = 0;

  /// The account of this load.
  [[nodiscard]] const LoadBudget& budget() const noexcept { return budget_; }

 protected:
  [[nodiscard]] bool taken(std::string_view name) const { return owner_of_.contains(name); }
  /// Draws bytes that are kept as they are. Errors: naming the member.
  [[nodiscard]] Result<void> draw(std::string_view name, std::uint64_t num_bytes) const;
  [[nodiscard]] virtual Result<void> check_name(std::string_view name) const = 0;
  /// Requires: contains(name). Errors: kIo.
  [[nodiscard]] virtual Result<std::uint64_t> size_of(std::string_view name) const = 0;
  [[nodiscard]] virtual Result<std::string> read(std::string_view name,
                                                 std::uint64_t max_bytes) const = 0;

 private:
  [[nodiscard]] Unexpected refusal(const std::string& owner, std::string what) const;

  std::string file_;
  LoadBudget budget_;
  std::map<std::string, std::string, std::less<>> owner_of_;
};

/// Members of a zip file.
class ZipMembers final : public ArchiveMembers {
 public:
  ZipMembers(ZipReader zip, std::string file, LoadBudget budget)
      : ArchiveMembers(std::move(file), std::move(budget)), zip_(std::move(zip)) {}
  [[nodiscard]] bool contains(std::string_view name) const override { return zip_.contains(name); }
  [[nodiscard]] Result<std::string> start_of(std::string_view name,
                                             std::size_t max_bytes) const override {
    return zip_.read_start(name, max_bytes);
  }
  [[nodiscard]] Result<std::vector<OpaqueFile>> rest(std::uint64_t max_bytes) const override;

 protected:
  [[nodiscard]] Result<void> check_name(std::string_view name) const override {
    return check_member_name(name);
  }
  [[nodiscard]] Result<std::uint64_t> size_of(std::string_view name) const override {
    return zip_.find(name)->num_bytes;
  }
  [[nodiscard]] Result<std::string> read(std::string_view name,
                                         std::uint64_t max_bytes) const override {
    return zip_.read(name, max_bytes, budget());
  }

 private:
  ZipReader zip_;
};

/// Files of a bare configuration: relative to it, or absolute.
class FolderMembers final : public ArchiveMembers {
 public:
  FolderMembers(const std::filesystem::path& config, LoadBudget budget, FileReach reach)
      : ArchiveMembers(config.string(), std::move(budget)),
        folder_(config.parent_path()),
        reach_(reach) {}
  [[nodiscard]] SourceName source_of(std::string_view name) const override {
    return {.file = (folder_ / name).string()};
  }
  [[nodiscard]] bool contains(std::string_view name) const override;
  [[nodiscard]] Result<std::string> start_of(std::string_view name,
                                             std::size_t max_bytes) const override;
  /// None: whatever else lies in the folder is no part of the map.
  [[nodiscard]] Result<std::vector<OpaqueFile>> rest(std::uint64_t) const override {
    return std::vector<OpaqueFile>{};
  }

 protected:
  [[nodiscard]] Result<void> check_name(std::string_view name) const override;
  [[nodiscard]] Result<std::uint64_t> size_of(std::string_view name) const override;
  [[nodiscard]] Result<std::string> read(std::string_view name,
                                         std::uint64_t max_bytes) const override;

 private:
  std::filesystem::path folder_;
  FileReach reach_;
};

}  // namespace hypermap
