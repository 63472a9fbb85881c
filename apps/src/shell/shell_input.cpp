// SPDX-License-Identifier: BSD-3-Clause
#include "shell_input.hpp"

#include "interruption.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace hypermap::app {
namespace {

/// A signal that comes just before the wait is seen after it.
constexpr int kLongestWaitMs = 250;
constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16U;

Unexpected unreadable() {
  return fail(ErrorCode::kIo, std::string("cannot be read: ") + std::strerror(errno));
}

}  // namespace

Result<ShellInput::Byte> ShellInput::next() {
  while (next_ == buffer_.size()) {
    if (interrupting_signal() != 0) return Byte{.state = ShellInputState::kInterrupted};
    pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
    const int ready = ::poll(&waiting, 1, kLongestWaitMs);
    if (ready < 0 && errno != EINTR) return unreadable();
    if (ready <= 0) continue;
    buffer_.resize(kBytesAtOnce);
    const ssize_t count = ::read(descriptor_, buffer_.data(), buffer_.size());
    buffer_.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    next_ = 0;
    if (count == 0) return Byte{.state = ShellInputState::kEnd};
    if (count < 0 && errno != EINTR && errno != EAGAIN) return unreadable();
  }
  return Byte{.state = ShellInputState::kByte, .value = buffer_[next_++]};
}

Result<ShellInput::Line> ShellInput::next_line() {
  Line line;
  bool is_begun = false;
  while (true) {
    HYPERMAP_ASSIGN_OR_RETURN(const Byte byte, next());
    if (byte.state == ShellInputState::kInterrupted) return Line{.state = byte.state};
    const bool is_last = byte.state == ShellInputState::kEnd;
    if (is_last && !is_begun) return Line{.state = ShellInputState::kEnd};
    if (is_last || byte.value == '\n') break;
    is_begun = true;
    line.is_too_long = line.is_too_long || line.text.size() == kMaxShellLineBytes;
    if (!line.is_too_long) line.text.push_back(byte.value);
  }
  line.state = ShellInputState::kByte;
  if (line.is_too_long) line.text.clear();
  if (line.text.ends_with('\r')) line.text.pop_back();
  return line;
}

}  // namespace hypermap::app
