// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_lines.hpp"

#include "hypermap/io/codec/text_file.hpp"

#include <cmath>
#include <utility>

namespace hypermap {

Error in_file(Error error, const std::filesystem::path& path, int line) {
  error.file = path.string();
  if (error.line == 0) error.line = line;
  return error;
}

Finding warning(const std::filesystem::path& path, int line, std::string field, std::string what) {
  return {Severity::kWarning,
          {.code = ErrorCode::kMalformedFile,
           .what = std::move(what),
           .file = path.string(),
           .field = std::move(field),
           .line = line}};
}

Result<double> finite_number(std::string_view word, std::string_view field) {
  const auto value = parse_double(word);
  if (value && std::isfinite(*value)) return *value;
  return fail(ErrorCode::kMalformedFile,
              "must be a finite number, is " + printable(word, 60),
              std::string(field));
}

Result<void> check_line_length(std::string_view line, const TrajectoryOptions& options) {
  if (line.size() <= options.max_line_bytes) return {};
  return fail(ErrorCode::kLimit,
              "at most " + std::to_string(options.max_line_bytes) +
                  " bytes are read of a line, has " + std::to_string(line.size()),
              "line");
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#';
}

void note_normalised(std::size_t count,
                     const std::filesystem::path& path,
                     std::vector<Finding>& findings) {
  if (count == 0) return;
  findings.push_back(
      warning(path,
              0,
              "rotation",
              std::to_string(count) + " rotations off by more than 1e-3 were normalised"));
}

}  // namespace hypermap
