// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include "interruption.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace hypermap::app {

Progress::Progress(std::string what, const std::string& when)
    : what_(std::move(what)), on_terminal_(isatty(STDERR_FILENO) == 1) {
  visible_ = when == "always" || (when == "auto" && on_terminal_);
}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

bool Progress::update(std::size_t done, std::size_t total) {
  show(done, total);
  return interrupting_signal() == 0;
}

void Progress::show(std::size_t done, std::size_t total) {
  if (!visible_ || total == 0) return;
  const std::size_t percent = 100 * done / total;
  if (percent == last_percent_) return;
  last_percent_ = percent;
  const char* format = on_terminal_ ? "\r%s %zu/%zu (%zu %%)" : "%s %zu/%zu (%zu %%)\n";
  std::fprintf(stderr, format, what_.c_str(), done, total, percent);
  line_open_ = on_terminal_;
}

}  // namespace hypermap::app
