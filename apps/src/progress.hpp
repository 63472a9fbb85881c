// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far long work has come, on stderr.
#pragma once

#include <cstddef>
#include <string>

namespace hypermap::app {

/// One line that is written over while work goes on: "mapping 120/200". Silent unless stderr is a
/// terminal or `when` is "always".
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
  void show(std::size_t done, std::size_t total);

  std::string what_;
  bool visible_ = false;
  bool on_terminal_ = false;
  bool line_open_ = false;
  std::size_t last_percent_ = 101;
};

}  // namespace hypermap::app
