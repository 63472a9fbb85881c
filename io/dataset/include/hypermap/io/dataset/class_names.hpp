// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the class outputs of a network are called.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

/// COCO's 80 classes in the order of its networks, with the VOC spelling where VOC has the class:
/// diningtable, tvmonitor, sofa, pottedplant, motorbike, aeroplane.
[[nodiscard]] std::vector<std::string> coco_class_names();

/// One name a line; empty lines at the end are dropped.
/// Errors: kIo; kLimit (65,535 names of 256 bytes); kMalformedFile for an empty or repeated name.
[[nodiscard]] Result<std::vector<std::string>> read_class_names(const std::filesystem::path& path);

}  // namespace hypermap
