// SPDX-License-Identifier: BSD-3-Clause
#include "csv_text.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "outputs.hpp"

#include <system_error>

namespace hypermap::app {

CsvText::CsvText(const std::vector<std::string>& heading) {
  for (const std::string& name : heading) add(name);
  end_line();
}

void CsvText::add(const std::string& cell) {
  if (!is_first_) text_ += ',';
  is_first_ = false;
  if (cell.find_first_of(",\"\r\n") == std::string::npos) {
    text_ += cell;
    return;
  }
  text_ += '"';
  for (const char c : cell) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
  text_ += '"';
}

void CsvText::add(std::size_t count) {
  add(std::to_string(count));
}

void CsvText::add(const std::optional<std::size_t>& count) {
  add(count ? std::to_string(*count) : std::string());
}

void CsvText::add(const std::optional<double>& number) {
  add(number ? number_text(*number) : std::string());
}

void CsvText::add(const std::optional<Eigen::Vector3d>& vector) {
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    add(vector ? std::optional<double>((*vector)[axis]) : std::nullopt);
}

void CsvText::end_line() {
  text_ += '\n';
  is_first_ = true;
}

Result<void> write_csv_files(const std::vector<CsvFile>& files,
                             const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
  std::vector<std::filesystem::path> written;
  written.reserve(files.size());
  for (const CsvFile& file : files) {
    if (const auto done = write_file_atomically(folder / file.name, file.text); !done)
      return Unexpected(with_written(done.error(), written));
    written.push_back(folder / file.name);
  }
  return {};
}

}  // namespace hypermap::app
