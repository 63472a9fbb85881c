// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include "hypermap/core/base/stop_watch.hpp"
#include "interruption.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

namespace hypermap::app {
namespace {

/// A terminal's line is written over also within a per cent.
double refresh_s(bool on_terminal) {
  if (on_terminal) return 0.5;
  return std::numeric_limits<double>::infinity();
}

/// Of the terminal; a large number when it does not say.
std::size_t num_columns() {
  winsize size{};
  const bool is_told = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_told ? size.ws_col : std::numeric_limits<std::size_t>::max();
}

}  // namespace

Progress::Progress(std::string what, const std::string& when)
    : on_terminal_(isatty(STDERR_FILENO) == 1),
      visible_(when == "always" || (when == "auto" && on_terminal_)),
      line_(std::move(what), refresh_s(on_terminal_)) {}

Progress::~Progress() {
  if (open_columns_ > 0) std::fputc('\n', stderr);
}

bool Progress::update(std::size_t done, std::size_t total) {
  if (visible_) {
    auto line = line_.update(wall_clock_s(), done, total);
    if (line && on_terminal_)
      write_over(std::move(*line));
    else if (line)
      std::fprintf(stderr, "%s\n", line->c_str());
  }
  return interrupting_signal() == 0;
}

/// Blanks hide the end of a longer line. A line that is broken could not be written over.
void Progress::write_over(std::string line) {
  line.resize(std::min(line.size(), num_columns() - 1));
  const std::size_t length = line.size();
  line.resize(std::max(length, open_columns_), ' ');
  std::fprintf(stderr, "\r%s", line.c_str());
  open_columns_ = length;
}

}  // namespace hypermap::app
