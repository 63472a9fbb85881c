// SPDX-License-Identifier: BSD-3-Clause
#include "frame_stream.hpp"

#include <system_error>
#include <utility>

namespace hypermap {

FrameStream::FrameStream(const DatasetReader& dataset, bool ahead, std::size_t first)
    : dataset_(dataset), ahead_(ahead), next_(first) {
  if (ahead_) start();
}

Result<RgbdFrame> FrameStream::next() {
  if (!ahead_) return dataset_.read(next_++);
  ++next_;
  std::future<Result<RgbdFrame>> ready = std::move(pending_);
  ready.wait();  // one at a time
  start();
  return ready.get();
}

void FrameStream::start() {
  if (next_ >= dataset_.size()) return;
  const auto read = [this, index = next_] { return dataset_.read(index); };
  try {
    pending_ = std::async(std::launch::async, read);
  } catch (const std::system_error&) {  // no thread to be had: read when asked
    pending_ = std::async(std::launch::deferred, read);
  }
}

}  // namespace hypermap
