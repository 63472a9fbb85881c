// SPDX-License-Identifier: BSD-3-Clause
#include "frame_stream.hpp"

#include <system_error>
#include <utility>

namespace hypermap {

FrameStream::FrameStream(FrameSource source, std::size_t first, std::size_t end, bool ahead)
    : source_(std::move(source)), next_(first), end_(end), ahead_(ahead) {
  if (ahead_) start();
}

Result<PreparedFrame> FrameStream::next() {
  if (!ahead_) return source_(next_++);
  ++next_;
  std::future<Result<PreparedFrame>> ready = std::move(pending_);
  ready.wait();  // one at a time
  start();
  return ready.get();
}

void FrameStream::start() {
  if (next_ >= end_) return;
  const auto prepare = [this, position = next_] { return source_(position); };
  try {
    pending_ = std::async(std::launch::async, prepare);
  } catch (const std::system_error&) {  // no thread to be had: prepared when asked
    pending_ = std::async(std::launch::deferred, prepare);
  }
}

}  // namespace hypermap
