// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <system_error>

namespace hypermap::app {
namespace {

namespace fs = std::filesystem;

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

/// Maps are written beside the frames that they are made of.
bool may_be_map(const fs::path& file) {
  return file.extension() == ".hmap" && file.filename() != "truth.hmap";
}

/// A file of a dataset: there, below the folder, and no map.
bool is_part_of(const fs::path& file, const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed) || !fs::exists(file, failed)) return false;
  const fs::path way = fs::relative(file, folder, failed);
  const bool is_inside = !failed && !way.empty() && *way.begin() != "..";
  return is_inside && !may_be_map(file);
}

bool is_dataset(const fs::path& folder) {
  std::error_code failed;
  return fs::exists(folder / "dataset.yaml", failed) || find_layout(folder).has_value();
}

/// The dataset in a subfolder of which the file is; none where it is a new one or a map.
std::optional<fs::path> dataset_above(const fs::path& file) {
  std::error_code failed;
  if (may_be_map(file) || !fs::is_regular_file(file, failed)) return std::nullopt;
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path().parent_path();
  if (!is_dataset(folder)) return std::nullopt;
  return folder;
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
  if (const auto dataset = dataset_above(output)) {
    throw CLI::ValidationError(option,
                               "would write over a file of the dataset " +
                                   printable(dataset->string()) + ": " +
                                   printable(output.string()));
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
  if (!is_dataset(output)) return;
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

bool has_suffix(const fs::path& file, const std::string& suffix) {
  const std::string is = file.extension().string();
  return is.empty() || is_spelling_of(is, suffix);
}

void keep_suffix(const std::string& option, const fs::path& output, const std::string& suffix) {
  if (has_suffix(output, suffix)) return;
  throw CLI::ValidationError(option,
                             "must end in " + suffix + ", is '" + printable(output.string()) + "'");
}

}  // namespace hypermap::app
