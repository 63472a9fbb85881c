// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_files.hpp"

#include "hypermap/io/dataset/dataset_description.hpp"
#include "images/image_list.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLevels = 3;
constexpr const char* kTruth = "truth.hmap";

bool is_listed(const fs::path& folder, const std::string& list, const std::string& name) {
  const auto files = read_image_list(folder, list);
  return files && std::ranges::find(*files, name, &ListedFile::path) != files->end();
}

/// Whether the file, by its name in the dataset, is one of a pattern, a list, or that list itself.
bool is_of(const fs::path& folder, const std::string& place, const std::string& name) {
  if (place.empty()) return false;
  if (is_pattern(place)) return fits_pattern(name, place);
  return name == place || is_listed(folder, place, name);
}

std::array<const std::string*, 4> image_places(const DatasetDescription& dataset) {
  return {&dataset.depth, &dataset.color, &dataset.labels, &dataset.instances};
}

bool is_part_of(const fs::path& folder,
                const DatasetDescription& dataset,
                const std::string& name) {
  const auto images = image_places(dataset);
  if (std::ranges::any_of(images, [&](const auto* place) { return is_of(folder, *place, name); }))
    return true;
  if (is_pattern(dataset.trajectory) && fits_pattern(name, dataset.trajectory)) return true;
  const std::array<std::string, 5> files{"dataset.yaml",
                                         dataset.trajectory,
                                         dataset.intrinsics_file,
                                         dataset.depth_intrinsics_file,
                                         dataset.label_names};
  if (std::ranges::find(files, name) != files.end()) return true;
  std::error_code failed;
  return name == kTruth && fs::exists(folder / kTruth, failed);
}

/// Calls the visitor with each dataset above the place, the nearest first, and with the place's
/// name in it, until it says that this is the one.
template <class Visitor>
std::optional<DatasetFile> find_above(const fs::path& place, const Visitor& is_the_one) {
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(place, failed);
  if (failed) return std::nullopt;
  fs::path folder = whole.parent_path();
  for (int level = 0; level < kMostLevels && folder != folder.parent_path(); ++level) {
    if (const auto dataset = find_layout(folder)) {
      DatasetFile found{.folder = folder, .is_detections = false};
      if (is_the_one(dataset->value, whole.lexically_relative(folder).generic_string(), found))
        return found;
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

}  // namespace

std::optional<DatasetFile> dataset_file(const fs::path& file) {
  return find_above(
      file, [](const DatasetDescription& dataset, const std::string& name, DatasetFile& found) {
        found.is_detections =
            std::ranges::find(dataset.detections, name) != dataset.detections.end();
        return found.is_detections || is_part_of(found.folder, dataset, name);
      });
}

std::optional<fs::path> dataset_with_images_in(const fs::path& folder) {
  const auto is_in = [&](const fs::path& root, const std::string& place, const std::string& name) {
    if (place.empty()) return false;
    const auto files = list_files(root, place);
    if (!files) return false;
    return std::ranges::any_of(*files, [&](const ListedFile& file) {
      return fs::path(file.path).parent_path().generic_string() == name;
    });
  };
  const auto found = find_above(
      folder, [&](const DatasetDescription& dataset, const std::string& name, DatasetFile& at) {
        const auto images = image_places(dataset);
        return std::ranges::any_of(
            images, [&](const auto* place) { return is_in(at.folder, *place, name); });
      });
  if (!found) return std::nullopt;
  return found->folder;
}

}  // namespace hypermap
