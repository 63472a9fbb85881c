// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_files.hpp"

#include "hypermap/io/dataset/dataset_description.hpp"
#include "images/image_list.hpp"
#include "images/label_images.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <system_error>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLevels = 3;
constexpr int kMostLinks = 40;  ///< As the system follows.
constexpr const char* kTruth = "truth.hmap";

/// Without `./` and doubled separators, which descriptions and lists may have.
std::string plain(const std::string& name) {
  return fs::path(name).lexically_normal().generic_string();
}

bool is_listed(const fs::path& folder, const std::string& list, const std::string& name) {
  const auto files = read_image_list(folder, list);
  const auto is_it = [&](const ListedFile& file) { return plain(file.path) == name; };
  return files && std::ranges::any_of(*files, is_it);
}

/// Whether the file, by its name in the dataset, is one of a pattern, a list, or that list itself.
bool is_of(const fs::path& folder, const std::string& place, const std::string& name) {
  if (place.empty()) return false;
  if (is_pattern(place)) return fits_pattern(name, plain(place));
  return name == plain(place) || is_listed(folder, place, name);
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
  if (is_pattern(dataset.trajectory) && fits_pattern(name, plain(dataset.trajectory))) return true;
  const std::array<std::string, 6> files{"dataset.yaml",
                                         dataset.trajectory,
                                         dataset.intrinsics_file,
                                         dataset.depth_intrinsics_file,
                                         dataset.label_names,
                                         std::string(kLabelTable)};
  if (std::ranges::find(files, name, plain) != files.end()) return true;
  std::error_code failed;
  return name == kTruth && fs::exists(folder / kTruth, failed);
}

bool is_detections_file(const DatasetDescription& dataset, const std::string& name) {
  return std::ranges::find(dataset.detections, name, plain) != dataset.detections.end();
}

/// Where a file of that name is, or would come to be: the last link is followed though nothing is
/// there.
fs::path followed(fs::path place) {
  std::error_code failed;
  for (int link = 0; link < kMostLinks && fs::is_symlink(place, failed); ++link)
    place = place.parent_path() / fs::read_symlink(place, failed);
  fs::path found = fs::weakly_canonical(place, failed);
  return failed ? place : found;
}

/// The place as it is written and as links lead to it: a dataset may have links in it, and links
/// may lead into it.
std::array<fs::path, 2> names_of(const fs::path& place) {
  std::error_code failed;
  const fs::path whole = fs::absolute(place, failed);
  return {whole.lexically_normal(), followed(whole)};
}

/// Calls the visitor with each dataset above the place, the nearest first, and with the place's
/// name in it, until it says that this is the one.
template <class Visitor>
std::optional<DatasetFile> find_above_named(const fs::path& whole, const Visitor& is_the_one) {
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

template <class Visitor>
std::optional<DatasetFile> find_above(const fs::path& place, const Visitor& is_the_one) {
  const auto [written, real] = names_of(place);
  const auto found = find_above_named(written, is_the_one);
  return found || real == written ? found : find_above_named(real, is_the_one);
}

/// Where a description cannot be read, any file may be part of what it describes.
std::optional<DatasetFile> file_of_unreadable(const fs::path& file) {
  std::error_code failed;
  const fs::path whole = followed(fs::absolute(file, failed));
  const bool is_map = whole.extension() == ".hmap" && whole.filename() != kTruth;
  if (is_map || !fs::is_regular_file(whole, failed)) return std::nullopt;
  fs::path folder = whole.parent_path();
  for (int level = 0; level < kMostLevels; ++level) {
    if (fs::exists(folder / "dataset.yaml", failed) && !find_layout(folder))
      return DatasetFile{.folder = folder, .is_detections = false};
    folder = folder.parent_path();
  }
  return std::nullopt;
}

}  // namespace

std::optional<DatasetFile> dataset_file(const fs::path& file) {
  const auto found = find_above(
      file, [](const DatasetDescription& dataset, const std::string& name, DatasetFile& at) {
        at.is_detections = is_detections_file(dataset, name);
        return at.is_detections || is_part_of(at.folder, dataset, name);
      });
  return found ? found : file_of_unreadable(file);
}

std::optional<DatasetFile> dataset_file(const fs::path& file,
                                        const fs::path& folder,
                                        const DatasetDescription& dataset) {
  const auto names = names_of(file);
  const auto folders = names_of(folder);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names[i].lexically_relative(folders[i]).generic_string();
    const bool is_detections = is_detections_file(dataset, name);
    if (is_detections || is_part_of(folder, dataset, name))
      return DatasetFile{.folder = folder, .is_detections = is_detections};
  }
  return std::nullopt;
}

std::optional<fs::path> dataset_with_images_in(const fs::path& folder) {
  const auto is_in = [&](const fs::path& root, const std::string& place, const std::string& name) {
    if (place.empty()) return false;
    if (is_pattern(place)) return fs::path(plain(place)).parent_path().generic_string() == name;
    const auto files = list_files(root, place);
    if (!files) return false;
    return std::ranges::any_of(*files, [&](const ListedFile& file) {
      return fs::path(plain(file.path)).parent_path().generic_string() == name;
    });
  };
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  const auto found = find_above(
      named, [&](const DatasetDescription& dataset, const std::string& name, DatasetFile& at) {
        const auto images = image_places(dataset);
        return std::ranges::any_of(
            images, [&](const auto* place) { return is_in(at.folder, *place, name); });
      });
  if (!found) return std::nullopt;
  return found->folder;
}

}  // namespace hypermap
