// SPDX-License-Identifier: BSD-3-Clause
#include "frame_stream.hpp"

#include <system_error>

namespace hypermap {

FrameStream::FrameStream(const DatasetReader& dataset, bool ahead)
    : dataset_(dataset), ahead_(ahead) {
  if (ahead_) start();
}

Result<RgbdFrame> FrameStream::next() {
  if (!ahead_) return dataset_.read(next_++);
  Result<RgbdFrame> frame = pending_.get();
  ++next_;
  start();
  return frame;
}

void FrameStream::start() {
  if (next_ >= dataset_.size()) return;
  const auto read = [this, index = next_] { return dataset_.read(index); };
  try {
    pending_ = std::async(std::launch::async, read);
  } catch (const std::system_error&) {  // no thread is to be had: read when it is asked for
    pending_ = std::async(std::launch::deferred, read);
  }
}

}  // namespace hypermap
