// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Members of a damaged archive that are sound, in memory.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

using SalvagedContents = std::map<std::string, std::string, std::less<>>;

/// One part of the map reads from it. Refers to the contents.
class SalvagedMembers final : public ArchiveMembers {
 public:
  SalvagedMembers(const SalvagedContents& contents, std::string file, LoadBudget budget)
      : ArchiveMembers(std::move(file), std::move(budget)), contents_(contents) {}

  [[nodiscard]] bool contains(std::string_view name) const override {
    return contents_.contains(name);
  }
  [[nodiscard]] Result<std::string> start_of(std::string_view name,
                                             std::size_t max_bytes) const override;
  [[nodiscard]] Result<std::vector<OpaqueFile>> rest(std::uint64_t max_bytes) const override;
  /// The members that were read, in the order of their names.
  [[nodiscard]] std::vector<std::string> taken_names() const;

 protected:
  [[nodiscard]] Result<void> check_name(std::string_view name) const override;
  [[nodiscard]] Result<std::uint64_t> size_of(std::string_view name) const override;
  [[nodiscard]] Result<std::string> read(std::string_view name,
                                         std::uint64_t max_bytes) const override;

 private:
  const SalvagedContents& contents_;
};

}  // namespace hypermap
