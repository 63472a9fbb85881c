// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which detectors spoke to a map: their names, and what each is.
///
/// Source: [smap] 4.2, the perception server, which knows a detector again that comes back.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// What a detector says of itself. Only the name is needed: what is empty is not stated.
struct DetectorDescription {
  std::string name;               ///< Unique in a map: "yolo of the robot".
  std::string type = {};          ///< What it gives: "detection", "segmentation", "labels".
  std::string architecture = {};  ///< Of its network: "YOLOX".
  /// What it can name, in its own order; empty: not stated.
  std::vector<std::string> classes = {};
  friend bool operator==(const DetectorDescription&, const DetectorDescription&) = default;
};

/// Errors: kInvalidArgument naming the field: a name that is empty, a text that is no UTF-8 or
/// holds control characters, a class that is none or is there in two spellings; kLimit for texts
/// over 256 bytes and more than 65,535 classes.
[[nodiscard]] Result<void> validate(const DetectorDescription& description);

/// Detectors and their ids 0, 1, 2, ... in the order of their first appearance. A value.
class DetectorRegistry {
 public:
  /// Detectors of a map at most.
  static constexpr std::size_t kMaxDetectors = 1024;

  /// The id of the detector. One that was known by its name is the same, and what it states now and
  /// did not state before is kept: it may begin as a name alone.
  ///
  /// Errors: those of validate; kInvalidArgument naming both when a detector of that name is known
  /// that states another type or architecture or other classes (order and spellings do not count);
  /// kLimit. On an error nothing changes.
  [[nodiscard]] Result<DetectorId> add(const DetectorDescription& description);

  /// A new detector of which nothing but its file is known: its name is `name`, with a number
  /// behind it where this one is in `taken` ("detections", "detections 2"). Errors: those of add.
  [[nodiscard]] Result<DetectorId> add_unnamed(std::string_view name,
                                               std::span<const DetectorId> taken);

  [[nodiscard]] std::optional<DetectorId> find(std::string_view name) const;
  [[nodiscard]] bool contains(DetectorId id) const noexcept { return id.value < detectors_.size(); }
  /// Requires: contains(id).
  [[nodiscard]] const DetectorDescription& description(DetectorId id) const;
  /// In the order of their ids.
  [[nodiscard]] std::span<const DetectorDescription> detectors() const noexcept {
    return detectors_;
  }
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::size_t size() const noexcept { return detectors_.size(); }
  friend bool operator==(const DetectorRegistry&, const DetectorRegistry&) = default;

 private:
  std::vector<DetectorDescription> detectors_;
};

/// `"yolo" (detection, YOLOX, 80 classes)`; what is not stated is left out.
[[nodiscard]] std::string to_string(const DetectorDescription& description);

}  // namespace hypermap
