// SPDX-License-Identifier: BSD-3-Clause
// Clouds, whose headers may promise what is not there.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/label_names_file.hpp"
#include "hypermap/io/codec/point_cloud_file.hpp"
#include "targets.hpp"

#include <algorithm>

namespace hypermap::fuzz {

void fuzz_cloud(std::string_view bytes) {
  (void)parse_label_names(bytes, kFuzzSource);
  const auto cloud = parse_point_cloud(bytes, kFuzzSource);
  if (!cloud) return;
  require(cloud->labels.empty() || cloud->labels.size() == cloud->points.size(),
          "every point has a label, or none");
  const double limit = CloudLimits{}.max_coordinate * 1.001;
  require(std::ranges::all_of(cloud->points,
                              [&](const Eigen::Vector3f& point) {
                                return point.allFinite() &&
                                       static_cast<double>(point.cwiseAbs().maxCoeff()) <= limit;
                              }),
          "points are finite and within the limit");
}

}  // namespace hypermap::fuzz
