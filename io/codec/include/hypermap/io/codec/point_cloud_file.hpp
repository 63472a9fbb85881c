// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Point clouds as other programs keep them: PCD of the Point Cloud Library, and PLY.
///
/// Scope: PCD 0.6 and 0.7 as text, binary and compressed; PLY as text and binary of either byte
/// order, its element `vertex`. Places are the fields x, y, z, labels the field `label`, `class` or
/// `classification`, in any case and with CloudCompare's `scalar_` or without. A sensor's place in
/// the header (VIEWPOINT) says where a cloud was seen from; its points are not moved by it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Points and the number that each bears. Frame and unit: the file's, metres by custom.
struct LabelledPoints {
  /// Of a point whose label is not a number.
  static constexpr std::int64_t kNoLabel = std::numeric_limits<std::int64_t>::min();

  std::vector<Eigen::Vector3f> points = {};
  std::vector<std::int64_t> labels = {};  ///< One a point; empty when the file has no such field.
  /// What labels mean, where comments of a PLY file say it as ours do: `comment label 3 chair`.
  std::map<std::int64_t, std::string> names = {};
  /// Left out: a coordinate that is not finite, as organised clouds have them where nothing was
  /// measured.
  std::size_t num_unmeasured = 0;
  friend bool operator==(const LabelledPoints&, const LabelledPoints&) = default;
};

struct CloudLimits {
  std::uint64_t max_bytes = std::uint64_t{2} << 30U;  ///< Of the file, and of what it unpacks to.
  std::size_t max_points = 100'000'000;
  double max_coordinate = 1e6;  ///< Of what is finite.
};

/// Told by its first line. Errors: kMalformedFile naming field and, in text, the line: a header or
/// data that are not as above, fewer data than the header says, a label that is no whole number, a
/// coordinate beyond the limit; kUnsupported for a version, a form of data or a kind of file that
/// is not read; kLimit. Nothing is kept for what the file does not hold.
[[nodiscard]] Result<LabelledPoints> parse_point_cloud(std::string_view bytes,
                                                       const SourceName& source,
                                                       const CloudLimits& limits = {});
/// A file on disk. Errors: those above and kIo.
[[nodiscard]] Result<LabelledPoints> read_point_cloud(const std::filesystem::path& path,
                                                      const CloudLimits& limits = {});

}  // namespace hypermap
