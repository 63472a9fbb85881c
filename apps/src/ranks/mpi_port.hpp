// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Messages between ranks by MPI.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/rank_crew.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

namespace hypermap::app {

/// MPI itself, from its beginning to its end: one in a process. Faults of MPI end all ranks, as
/// does the death of one. Threads: that which made it.
class MpiPort final : public MessagePort {
 public:
  /// Begins MPI. Errors: kUnavailable when MPI cannot be begun.
  [[nodiscard]] static Result<std::unique_ptr<MpiPort>> open();
  MpiPort(const MpiPort&) = delete;
  MpiPort& operator=(const MpiPort&) = delete;
  MpiPort(MpiPort&&) = delete;
  MpiPort& operator=(MpiPort&&) = delete;
  /// Ends MPI once all ranks do.
  ~MpiPort() override;

  [[nodiscard]] std::size_t rank() const override { return rank_; }
  [[nodiscard]] std::size_t num_ranks() const override { return num_ranks_; }
  void send(std::size_t to, std::string_view bytes) override;
  [[nodiscard]] std::optional<RankMessage> poll() override;

 private:
  MpiPort(int rank, int num_ranks)
      : rank_(static_cast<std::size_t>(rank)), num_ranks_(static_cast<std::size_t>(num_ranks)) {}

  std::size_t rank_;
  std::size_t num_ranks_;
};

}  // namespace hypermap::app
