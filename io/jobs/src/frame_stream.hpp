// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames of a dataset in order, the next one prepared while the last one is worked on.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <functional>
#include <future>

namespace hypermap {

/// A frame that was read, and at which a network looked if it was to.
struct PreparedFrame {
  RgbdFrame frame;
  bool is_looked_at = false;
  double read_s = 0.0;  ///< What took how long, wherever it was done.
  double detect_s = 0.0;
};

/// The frame at a position of the input. Called with ascending positions, one call at a time.
using FrameSource = std::function<Result<PreparedFrame>(std::size_t position)>;

/// At most one frame is prepared ahead. Destroying the stream waits for it.
class FrameStream {
 public:
  /// Frames `first` to `end` - 1. `ahead`: prepared on another thread; else no thread is started
  /// and nothing is prepared before it is asked for. The frames are the same. Requires: what
  /// `source` uses outlives the stream, and is not used elsewhere meanwhile if `ahead`.
  FrameStream(FrameSource source, std::size_t first, std::size_t end, bool ahead);
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;
  ~FrameStream() = default;

  /// The next frame or its error, in order; what the source throws is thrown here.
  /// Requires: called at most end - first times.
  [[nodiscard]] Result<PreparedFrame> next();

 private:
  void start();

  FrameSource source_;
  std::size_t next_;
  std::size_t end_;
  bool ahead_;
  std::future<Result<PreparedFrame>> pending_;
};

}  // namespace hypermap
