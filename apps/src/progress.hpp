// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far long work has come, on stderr.
#pragma once

#include "hypermap/core/base/progress_line.hpp"

#include <cstddef>
#include <string>

namespace hypermap::app {

/// One line that is written over while work goes on, "mapping 120/200 (60 %), 41.2 a second, 2 s
/// left"; where stderr is no terminal a line for each per cent. Silent unless stderr is a terminal
/// or `when` is "always".
class Progress {
 public:
  /// `when` is auto, always or never.
  Progress(std::string what, const std::string& when);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// False when the user wants the work to end.
  [[nodiscard]] bool update(std::size_t done, std::size_t total);

 private:
  void write_over(std::string line);

  bool on_terminal_;
  bool visible_;
  ProgressLine line_;
  std::size_t open_columns_ = 0;  ///< Of the line that the cursor stands at the end of; 0: none.
};

}  // namespace hypermap::app
