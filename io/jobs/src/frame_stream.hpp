// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames of a dataset in order, the next one read and decoded while the last one is worked on.
#pragma once

#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <future>

namespace hypermap {

/// At most one frame is read ahead. Destroying the stream waits for it.
class FrameStream {
 public:
  /// Frames from `first` on. `ahead`: read on another thread; else no thread is started and nothing
  /// is read before it is asked for. The frames are the same. Requires: `dataset` outlives it.
  FrameStream(const DatasetReader& dataset, bool ahead, std::size_t first = 0);
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;
  ~FrameStream() = default;

  /// The next frame or its error, in order; what the reader throws is thrown here.
  /// Requires: called at most dataset.size() - first times.
  [[nodiscard]] Result<RgbdFrame> next();

 private:
  void start();

  const DatasetReader& dataset_;
  bool ahead_;
  std::size_t next_;
  std::future<Result<RgbdFrame>> pending_;
};

}  // namespace hypermap
