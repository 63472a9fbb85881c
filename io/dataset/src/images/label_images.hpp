// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Images of class numbers and instances, as ScanNet exports them, made into detections.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/detections_file.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// What the numbers in label images mean.
struct LabelNames {
  std::map<std::uint32_t, std::string> of_number = {};
  /// They were taken for want of others, so a number without a name speaks of another list.
  bool are_assumed = false;
};

/// ScanNet's table of label names, which is taken where no other file is named.
constexpr std::string_view kLabelTable = "scannetv2-labels.combined.tsv";

/// Names from the file `chosen` of the folder; when that is empty from `kLabelTable` in the folder
/// or one of the two above it; else the 40 classes of NYU Depth V2, by their numbers, as an
/// assumption. A file is a table with tabs and the columns `id` and `category`, or has lines
/// `number name`. Errors: kIo; kMalformedFile naming the line.
[[nodiscard]] Result<LabelNames> read_label_names(const std::filesystem::path& folder,
                                                  const std::string& chosen = {});

/// One detection, score 1, with mask for each instance; without an instance image for each
/// connected region of a class. Regions below 64 pixels and numbers without a name are left out.
/// A region whose number has no name among assumed names is an error.
///
/// `labels` and `instances` are files, one of which may be empty; instances alone must be numbered
/// class * 1000 + instance.
/// Errors: those of reading the images; kUnsupported for a number beyond assumed names;
/// kInvalidArgument when their sizes differ or there would be more detections than `limits` allow.
[[nodiscard]] Result<FrameDetections> read_label_detections(const std::filesystem::path& labels,
                                                            const std::filesystem::path& instances,
                                                            const LabelNames& names,
                                                            const DetectionLimits& limits = {});

}  // namespace hypermap
