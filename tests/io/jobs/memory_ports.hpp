// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Ranks that are threads of a test.
#pragma once

#include "hypermap/io/jobs/rank_crew.hpp"

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::test {

/// What lies between ranks.
struct MemoryMail {
  explicit MemoryMail(std::size_t num_ranks) : boxes(num_ranks) {}

  std::mutex mutex;
  std::vector<std::deque<RankMessage>> boxes;
};

/// Until so many messages lie before a rank.
inline void wait_for_mail(MemoryMail& mail, std::size_t rank, std::size_t num_messages) {
  for (bool has_come = false; !has_come;) {
    const std::scoped_lock lock(mail.mutex);
    has_come = mail.boxes[rank].size() >= num_messages;
  }
}

class MemoryPort final : public MessagePort {
 public:
  MemoryPort(MemoryMail& mail, std::size_t rank) : mail_(mail), rank_(rank) {}

  [[nodiscard]] std::size_t rank() const override { return rank_; }
  [[nodiscard]] std::size_t num_ranks() const override { return mail_.boxes.size(); }
  void send(std::size_t to, std::string_view bytes) override {
    const std::scoped_lock lock(mail_.mutex);
    mail_.boxes[to].push_back({.from = rank_, .bytes = std::string(bytes)});
  }
  [[nodiscard]] std::optional<RankMessage> poll() override {
    const std::scoped_lock lock(mail_.mutex);
    auto& box = mail_.boxes[rank_];
    if (box.empty()) return std::nullopt;
    RankMessage message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  MemoryMail& mail_;
  std::size_t rank_;
};

}  // namespace hypermap::test
