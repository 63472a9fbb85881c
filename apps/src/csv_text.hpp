// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tables for spreadsheets.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// Lines of cells after RFC 4180, but for plain line ends; what is not known is an empty cell.
class CsvText {
 public:
  explicit CsvText(const std::vector<std::string>& heading);

  void add(const std::string& cell);
  void add(std::size_t count);
  void add(const std::optional<std::size_t>& count);
  void add(const std::optional<double>& number);
  /// Three cells.
  void add(const std::optional<Eigen::Vector3d>& vector);
  void end_line();
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool is_first_ = true;
};

struct CsvFile {
  const char* name = "";
  std::string text = {};
};

/// Writes the files into `folder`, which is made; what is there by their names is replaced, each as
/// a whole. Errors: kIo, with the files written before.
[[nodiscard]] Result<void> write_csv_files(const std::vector<CsvFile>& files,
                                           const std::filesystem::path& folder);

}  // namespace hypermap::app
