// SPDX-License-Identifier: BSD-3-Clause
#include "frame_stream.hpp"

#include "hypermap/io/dataset/dataset_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kNumFrames = 20;

/// Frames that bear their number; the 4th cannot be read, the 7th makes the reader throw.
class NumberedFrames final : public DatasetReader {
 public:
  explicit NumberedFrames(bool faulty) : faulty_(faulty) {}

  [[nodiscard]] std::size_t size() const noexcept override { return kNumFrames; }
  [[nodiscard]] std::string frame_name(std::size_t index) const override {
    return std::to_string(index);
  }
  [[nodiscard]] const DatasetSummary& summary() const noexcept override { return summary_; }
  [[nodiscard]] Result<RgbdFrame> read(std::size_t index) const override {
    const int others = num_reading_++;
    most_at_once_ = std::max(most_at_once_.load(), others + 1);
    read_elsewhere_ = read_elsewhere_ || std::this_thread::get_id() != maker_;
    ++num_read_;
    --num_reading_;
    if (faulty_ && index == 4) return fail(ErrorCode::kIo, "frame 4");
    if (faulty_ && index == 7) throw std::runtime_error("frame 7");
    RgbdFrame frame;
    frame.index = index;
    return frame;
  }

  [[nodiscard]] std::size_t num_read() const { return num_read_; }
  [[nodiscard]] int most_at_once() const { return most_at_once_; }
  [[nodiscard]] bool read_elsewhere() const { return read_elsewhere_; }

 private:
  bool faulty_;
  std::thread::id maker_ = std::this_thread::get_id();
  DatasetSummary summary_;
  mutable std::atomic<int> num_reading_ = 0;
  mutable std::atomic<int> most_at_once_ = 0;
  mutable std::atomic<std::size_t> num_read_ = 0;
  mutable std::atomic<bool> read_elsewhere_ = false;
};

FrameSource source_of(const NumberedFrames& dataset) {
  return [&dataset](std::size_t position) -> Result<PreparedFrame> {
    HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, dataset.read(position));
    PreparedFrame prepared;
    prepared.frame = std::move(frame);
    return prepared;
  };
}

class FrameStreamTest : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WhenAskedAndAhead, FrameStreamTest, ::testing::Bool());

TEST_P(FrameStreamTest, GivesEachFrameOnceInOrder) {
  const NumberedFrames dataset(false);
  FrameStream stream(source_of(dataset), 0, kNumFrames, GetParam());
  for (std::size_t i = 0; i < kNumFrames; ++i) {
    const auto frame = stream.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame.index, i);
  }
  EXPECT_EQ(dataset.num_read(), kNumFrames);
  EXPECT_EQ(dataset.most_at_once(), 1);
  EXPECT_EQ(dataset.read_elsewhere(), GetParam()) << "one thread is one thread";
}

TEST_P(FrameStreamTest, ErrorsAndExceptionsStandInTheirPlace) {
  const NumberedFrames dataset(true);
  FrameStream stream(source_of(dataset), 0, kNumFrames, GetParam());
  for (std::size_t i = 0; i < kNumFrames; ++i) {
    if (i == 7) {
      EXPECT_THROW((void)stream.next(), std::runtime_error);
      continue;
    }
    const auto frame = stream.next();
    ASSERT_EQ(frame.has_value(), i != 4);
    if (frame) {
      EXPECT_EQ(frame->frame.index, i);
    } else {
      EXPECT_EQ(frame.error().what, "frame 4");
    }
  }
}

TEST_P(FrameStreamTest, MayBeLeftInTheMiddle) {
  const NumberedFrames dataset(false);
  {
    FrameStream stream(source_of(dataset), 0, kNumFrames, GetParam());
    ASSERT_TRUE(stream.next());
  }
  EXPECT_LE(dataset.num_read(), 2U) << "at most one frame ahead";
}

TEST_P(FrameStreamTest, BeginsWhereItIsTold) {
  const NumberedFrames dataset(false);
  FrameStream stream(source_of(dataset), kNumFrames - 2, kNumFrames, GetParam());
  EXPECT_EQ(stream.next()->frame.index, kNumFrames - 2);
  EXPECT_EQ(stream.next()->frame.index, kNumFrames - 1);
  EXPECT_EQ(dataset.num_read(), 2U);
}

}  // namespace
}  // namespace hypermap
