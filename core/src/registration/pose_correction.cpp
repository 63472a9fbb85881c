// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/pose_refinement.hpp"
#include "registration/rotation_vector.hpp"

namespace hypermap {

PoseCorrection corrected(PoseCorrection correction,
                         const MapFromCamera& given,
                         const MapFromCamera& used) {
  const Eigen::Isometry3d& before = given.isometry();
  const Eigen::Isometry3d& after = used.isometry();
  correction.outcome = PoseOutcome::kRefined;
  correction.translation_m = (after.translation() - before.translation()).norm();
  correction.rotation_rad = rotation_vector(after.linear() * before.linear().transpose()).norm();
  return correction;
}

std::string_view name_of(PoseOutcome outcome) noexcept {
  switch (outcome) {
    case PoseOutcome::kGiven:
      break;
    case PoseOutcome::kRefined:
      return "refined";
    case PoseOutcome::kTooFewPoints:
      return "too_few_points";
    case PoseOutcome::kAmbiguous:
      return "ambiguous";
    case PoseOutcome::kTooLarge:
      return "too_large";
    case PoseOutcome::kNoBetter:
      return "no_better";
  }
  return "given";
}

}  // namespace hypermap
