// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/dataset_files.hpp"

#include <CLI/App.hpp>

#include <system_error>

namespace hypermap::app {
namespace {

namespace fs = std::filesystem;

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  return fs::absolute(a, ignored).lexically_normal() == fs::absolute(b, ignored).lexically_normal();
}

bool is_dataset(const fs::path& folder) {
  std::error_code failed;
  return fs::exists(folder / "dataset.yaml", failed) || find_layout(folder).has_value();
}

/// Of a folder that is read by a description that lies elsewhere and is read, too.
std::optional<DatasetFile> described_file(const fs::path& output,
                                          const std::vector<fs::path>& inputs) {
  std::error_code failed;
  for (const fs::path& input : inputs) {
    const bool may_describe = is_spelling_of(input.extension().string(), ".yaml");
    if (!may_describe || !fs::is_regular_file(input, failed)) continue;
    const auto description = read_dataset_description(input);
    if (!description) continue;
    for (const fs::path& folder : inputs) {
      if (!fs::is_directory(folder, failed)) continue;
      if (auto part = dataset_file(output, folder, description->value)) return part;
    }
  }
  return std::nullopt;
}

/// In a folder that is read and does not say what belongs to it: what is there and no map, which
/// are written beside the frames that they are made of.
bool may_be_part_of(const fs::path& file, const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed) || !fs::exists(file, failed)) return false;
  const fs::path way = fs::relative(file, folder, failed);
  const bool is_inside = !failed && !way.empty() && *way.begin() != "..";
  return is_inside && !find_layout(folder) && !is_spelling_of(file.extension().string(), ".hmap");
}

std::optional<std::string> fault_of(const std::optional<DatasetFile>& part,
                                    const fs::path& output,
                                    MayReplace may) {
  if (!part || (part->is_detections && may == MayReplace::kDetections)) return std::nullopt;
  std::error_code failed;
  const std::string rule = fs::exists(output, failed) ? "would write over a file of the dataset "
                                                      : "would be read as a file of the dataset ";
  return rule + printable(part->folder.string()) + ": " + printable(output.string());
}

}  // namespace

std::optional<std::string> dataset_fault(const fs::path& output, MayReplace may) {
  return fault_of(dataset_file(output), output, may);
}

void keep_apart(const std::string& option,
                const fs::path& output,
                const std::vector<fs::path>& inputs,
                MayReplace may) {
  if (output.empty()) return;
  if (output == "-") {
    throw CLI::ValidationError(
        option, "'-' names no file, and files are not written to standard output (./- is a file)");
  }
  if (const auto fault = dataset_fault(output, may)) throw CLI::ValidationError(option, *fault);
  if (const auto fault = fault_of(described_file(output, inputs), output, may))
    throw CLI::ValidationError(option, *fault);
  for (const fs::path& input : inputs) {
    if (input.empty() || !(is_same(output, input) || may_be_part_of(output, input))) continue;
    throw CLI::ValidationError(option,
                               "would write over what is read: " + printable(output.string()));
  }
}

void keep_unlike(const std::string& option,
                 const fs::path& output,
                 const std::vector<fs::path>& others) {
  for (const fs::path& other : others) {
    if (output.empty() || other.empty() || !is_same(output, other)) continue;
    throw CLI::ValidationError(option,
                               "is the name of another output: " + printable(output.string()));
  }
}

void keep_out_of_datasets(const std::string& option, const fs::path& output) {
  if (!is_dataset(output) && !dataset_with_images_in(output)) return;
  throw CLI::ValidationError(
      option,
      "is a folder of a dataset, where nothing else belongs: " + printable(output.string()));
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
