// SPDX-License-Identifier: BSD-3-Clause
#include "area_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

constexpr int kMaxParameters = 8;
constexpr double kMinCommonCells = 50.0;
constexpr double kLeastVariance = 1e-9;  // below, an image says the same everywhere
using Parameters = Eigen::Matrix<double, kMaxParameters, 1>;
using Normal = Eigen::Matrix<double, kMaxParameters, kMaxParameters>;

int num_parameters(RegistrationKind kind) {
  switch (kind) {
    case RegistrationKind::kRigid:
      return 3;
    case RegistrationKind::kSimilarity:
      return 4;
    case RegistrationKind::kHomography:
      break;
  }
  return kMaxParameters;
}

/// Directions in which a homography can change at the identity: two shifts, turn, scale, two
/// shears, two tilts.
std::array<Eigen::Matrix3d, kMaxParameters> generators() {
  std::array<Eigen::Matrix3d, kMaxParameters> all;
  all.fill(Eigen::Matrix3d::Zero());
  all[0](0, 2) = all[1](1, 2) = 1.0;
  all[2](0, 1) = -1.0;
  all[2](1, 0) = 1.0;
  all[3](0, 0) = all[3](1, 1) = 1.0;
  all[4](0, 0) = 1.0;
  all[4](1, 1) = -1.0;
  all[5](0, 1) = all[5](1, 0) = 1.0;
  all[6](2, 0) = all[7](2, 1) = 1.0;
  return all;
}

/// A small change that keeps the kind.
Eigen::Matrix3d step_of(const Parameters& step, RegistrationKind kind) {
  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  if (kind == RegistrationKind::kHomography) {
    const auto basis = generators();
    for (int i = 0; i < kMaxParameters; ++i) change += step[i] * basis[static_cast<std::size_t>(i)];
    return change;
  }
  const double scale = kind == RegistrationKind::kSimilarity ? std::exp(step[3]) : 1.0;
  change.topLeftCorner<2, 2>() = scale * Eigen::Rotation2Dd(step[2]).toRotationMatrix();
  change.topRightCorner<2, 1>() = step.head<2>();
  return change;
}

/// From (column, row) to the middle of the image, in halves of its diagonal.
Eigen::Matrix3d centred(const GridImage& image) {
  const double half = 0.5 * std::hypot(image.cols(), image.rows());
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity() / half;
  matrix.topRightCorner<2, 1>() =
      -0.5 / half * Eigen::Vector2d(image.cols() - 1.0, image.rows() - 1.0);
  matrix(2, 2) = 1.0;
  return matrix;
}

/// Where a cell of the moving image falls in the fixed one, when both know what is there.
std::optional<Eigen::Vector2d> common_place(const GridImage& fixed,
                                            const Eigen::Vector3d& in_fixed) {
  constexpr double kAllKnown = 0.999;
  if (!(in_fixed.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d place = in_fixed.hnormalized();
  if (!is_inside(fixed.known, place)) return std::nullopt;
  if (sampled(fixed.known, place).value < kAllKnown) return std::nullopt;
  return place;
}

/// What moving and fixed image say of the cells that both know.
struct CommonValues {
  double num_known = 0.0;  ///< Cells that the moving image knows.
  double num_common = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();        ///< Of moving, of fixed.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of both.
};

CommonValues common_values(const GridImage& moving,
                           const GridImage& fixed,
                           const Eigen::Matrix3d& fixed_from_moving) {
  CommonValues common;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  for (int row = 0; row < moving.rows(); ++row) {
    for (int col = 0; col < moving.cols(); ++col) {
      if (moving.known(row, col) == 0.0F) continue;
      common.num_known += 1.0;
      const auto place = common_place(fixed, fixed_from_moving * Eigen::Vector3d(col, row, 1.0));
      if (!place) continue;
      const Eigen::Vector2d pair(static_cast<double>(moving.value(row, col)),
                                 sampled(fixed.value, *place).value);
      common.num_common += 1.0;
      sum += pair;
      products += pair * pair.transpose();
    }
  }
  if (common.num_common == 0.0) return common;
  common.mean = sum / common.num_common;
  common.covariance = products / common.num_common - common.mean * common.mean.transpose();
  return common;
}

/// How much surer the fixed image is than the moving one: it says about gain * moving + offset.
struct Sureness {
  double gain = 1.0;
  double offset = 0.0;
};

/// By mean and spread, not by regression: of noise, and where the placement is still wrong, that
/// gives a gain near zero, by which the flattest place would be the best. Boundary: the identity
/// where an image says the same everywhere.
Sureness sureness_of(const CommonValues& common) {
  const Eigen::Vector2d variance = common.covariance.diagonal();
  if (!(variance.minCoeff() > kLeastVariance)) return {};
  const double gain = std::sqrt(variance.y() / variance.x());
  return {gain, common.mean.y() - gain * common.mean.x()};
}

struct NormalEquations {
  Normal matrix = Normal::Zero();
  Parameters vector = Parameters::Zero();
  double num_cells = 0.0;
};

/// Of the differences fixed - moving, by the parameters of step_of behind the placement.
NormalEquations equations_at(const GridImage& moving,
                             const GridImage& fixed,
                             const Eigen::Matrix3d& fixed_from_centred,
                             int num_used) {
  const auto basis = generators();
  const Eigen::Matrix3d centred_from_cells = centred(moving);
  const Sureness as_sure =
      sureness_of(common_values(moving, fixed, fixed_from_centred * centred_from_cells));
  NormalEquations sums;
  for (int row = 0; row < moving.rows(); ++row) {
    for (int col = 0; col < moving.cols(); ++col) {
      if (moving.known(row, col) == 0.0F) continue;
      const Eigen::Vector3d from = centred_from_cells * Eigen::Vector3d(col, row, 1.0);
      const Eigen::Vector3d to = fixed_from_centred * from;
      const auto place = common_place(fixed, to);
      if (!place) continue;
      const PlaneSample there = sampled(fixed.value, *place);
      const double wanted =
          as_sure.gain * static_cast<double>(moving.value(row, col)) + as_sure.offset;
      const double difference = there.value - wanted;
      Parameters slope = Parameters::Zero();
      for (int i = 0; i < num_used; ++i) {
        const Eigen::Vector3d change =
            fixed_from_centred * (basis[static_cast<std::size_t>(i)] * from);
        slope[i] = there.slope.dot(change.head<2>() - *place * change.z()) / to.z();
      }
      sums.matrix += slope * slope.transpose();
      sums.vector += slope * difference;
      sums.num_cells += 1.0;
    }
  }
  return sums;
}

/// None where the common cells do not say which way.
std::optional<Parameters> best_step(const NormalEquations& sums, int num_used) {
  if (sums.num_cells < kMinCommonCells) return std::nullopt;
  constexpr double kDamping = 1e-4;
  Normal matrix = sums.matrix;
  const double mean = matrix.diagonal().sum() / num_used;
  if (!(mean > 0.0)) return std::nullopt;
  for (int i = 0; i < kMaxParameters; ++i) matrix(i, i) += i < num_used ? kDamping * mean : 1.0;
  const Parameters step = -matrix.ldlt().solve(sums.vector);
  constexpr double kMaxStep = 0.2;  // of half the image's diagonal
  if (!step.allFinite()) return std::nullopt;
  const double largest = step.cwiseAbs().maxCoeff();
  return largest > kMaxStep ? Parameters(step * (kMaxStep / largest)) : step;
}

Eigen::Matrix3d descended(const GridImage& moving,
                          const GridImage& fixed,
                          const Eigen::Matrix3d& start,
                          RegistrationKind kind) {
  constexpr int kMaxRounds = 20;
  const double enough = 1e-3 / std::hypot(moving.cols(), moving.rows());  // 1/2000 of a cell
  const Eigen::Matrix3d centred_from_cells = centred(moving);
  Eigen::Matrix3d placement = start * centred_from_cells.inverse();
  for (int round = 0; round < kMaxRounds; ++round) {
    const int num_used = num_parameters(kind);
    const auto step = best_step(equations_at(moving, fixed, placement, num_used), num_used);
    if (!step) break;
    placement = placement * step_of(*step, kind);
    if (step->cwiseAbs().maxCoeff() < enough) break;
  }
  const Eigen::Matrix3d result = placement * centred_from_cells;
  const bool is_good = result.allFinite() && std::abs(result(2, 2)) > 0.0;
  return is_good ? Eigen::Matrix3d(result / result(2, 2)) : start;
}

}  // namespace

AreaAgreement agreement_of(const GridImage& moving,
                           const GridImage& fixed,
                           const Eigen::Matrix3d& fixed_from_moving) {
  const GridImage soft_moving = smoothed(moving, 1.0);
  const GridImage soft_fixed = smoothed(fixed, 1.0);
  const CommonValues common = common_values(soft_moving, soft_fixed, fixed_from_moving);
  if (common.num_common == 0.0) return {};
  const Eigen::Matrix2d& covariance = common.covariance;
  const double scale = std::sqrt(covariance(0, 0) * covariance(1, 1));
  const double agreement = scale > kLeastVariance ? covariance(0, 1) / scale : 0.0;
  return {common.num_common / common.num_known, agreement};
}

Eigen::Matrix3d aligned_by_area(const GridImage& moving,
                                const GridImage& fixed,
                                const Eigen::Matrix3d& start,
                                RegistrationKind kind) {
  Eigen::Matrix3d placement = start;
  for (const double sigma_cells : {3.0, 1.5, 0.8}) {
    placement =
        descended(smoothed(moving, sigma_cells), smoothed(fixed, sigma_cells), placement, kind);
  }
  return placement;
}

}  // namespace hypermap
