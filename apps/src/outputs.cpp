// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"

#include <CLI/App.hpp>

#include <system_error>

namespace hypermap::app {
namespace {

namespace fs = std::filesystem;

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

/// A file of a dataset: there, below the folder, and no archive.
bool is_part_of(const fs::path& file, const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed) || !fs::exists(file, failed)) return false;
  const fs::path way = fs::relative(file, folder, failed);
  const bool is_inside = !failed && !way.empty() && *way.begin() != "..";
  return is_inside && file.extension() != ".hmap";
}

}  // namespace

void keep_apart(const std::string& option,
                const fs::path& output,
                const std::vector<fs::path>& inputs) {
  if (output.empty()) return;
  if (output == "-") {
    throw CLI::ValidationError(
        option, "'-' names no file, and files are not written to standard output (./- is a file)");
  }
  for (const fs::path& input : inputs) {
    if (input.empty() || !(is_same(output, input) || is_part_of(output, input))) continue;
    throw CLI::ValidationError(option,
                               "would write over what is read: " + printable(output.string()));
  }
}

void keep_out_of_datasets(const std::string& option, const fs::path& output) {
  std::error_code failed;
  if (!fs::is_directory(output, failed)) return;
  const bool is_described = fs::exists(output / "dataset.yaml", failed);
  if (!is_described && !find_layout(output)) return;
  throw CLI::ValidationError(
      option,
      "is the folder of a dataset, where nothing else belongs: " + printable(output.string()));
}

Error with_written(Error error, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    error.what += "; written before that: " + printable(file.string(), 500);
  }
  return error;
}

void keep_suffix(const std::string& option, const fs::path& output, const std::string& suffix) {
  const std::string is = output.extension().string();
  if (is.empty() || is_spelling_of(is, suffix)) return;
  throw CLI::ValidationError(option,
                             "must end in " + suffix + ", is '" + printable(output.string()) + "'");
}

}  // namespace hypermap::app
