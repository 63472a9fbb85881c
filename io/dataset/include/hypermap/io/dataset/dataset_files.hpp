// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which files a dataset consists of, so that nothing else takes their place.
#pragma once

#include <filesystem>
#include <optional>

namespace hypermap {

struct DatasetDescription;

/// A file that is part of a dataset, or would be if it were there.
struct DatasetFile {
  std::filesystem::path folder;  ///< The dataset's.
  bool is_detections = false;    ///< One of its detections files, which detectors replace.
};

/// The dataset that a file is part of: as its description, a list, an image, poses, intrinsics,
/// names of labels, detections or the truth of a simulation. A name that a pattern of the dataset
/// fits is one of its images. The file is looked for as it is written and as links lead to it.
///
/// Boundary: none where no folder up to three levels above is a dataset, or where its lists cannot
/// be read: who cannot read a dataset cannot say what belongs to it. Below a `dataset.yaml` that
/// cannot be read that is each file that is there, maps aside.
/// Cost: of `find_layout` for each of these folders, and of reading the dataset's lists.
[[nodiscard]] std::optional<DatasetFile> dataset_file(const std::filesystem::path& file);

/// The same of a folder that this description describes, whatever the folder itself says.
[[nodiscard]] std::optional<DatasetFile> dataset_file(const std::filesystem::path& file,
                                                      const std::filesystem::path& folder,
                                                      const DatasetDescription& dataset);

/// The dataset that has images directly in this folder, or would have if they were there; none as
/// above.
[[nodiscard]] std::optional<std::filesystem::path> dataset_with_images_in(
    const std::filesystem::path& folder);

}  // namespace hypermap
