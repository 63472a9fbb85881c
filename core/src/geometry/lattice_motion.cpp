// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/lattice_motion.hpp"

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

/// Of a rotation matrix, and in radians: less moves no cell.
constexpr double kNoTurn = 1e-9;
constexpr double kQuarter = std::numbers::pi / 2.0;

/// What is less than this beyond a half counts as the half: motion and motion back have other
/// rounding errors.
constexpr double kTie = 1e-6;

/// To the nearest whole number, of a half to the one nearer to 0: the same number both ways.
double rounded(double value) {
  return std::copysign(std::floor(std::abs(value) + 0.5 - kTie), value);
}

bool is_upright(const Eigen::Matrix3d& rotation) {
  return std::abs(rotation(0, 2)) <= kNoTurn && std::abs(rotation(1, 2)) <= kNoTurn &&
         std::abs(rotation(2, 0)) <= kNoTurn && std::abs(rotation(2, 1)) <= kNoTurn &&
         rotation(2, 2) > 0.0;
}

/// The point of the plane that a turn by `angle_rad` and then this shift leave in place.
Eigen::Vector2d fixed_point(double angle_rad, const Eigen::Vector2d& shift) {
  const Eigen::Vector2d across(-shift.y(), shift.x());
  return 0.5 * (shift + across / std::tan(0.5 * angle_rad));
}

Eigen::Vector2d turned_back(const Eigen::Vector2d& v, int quarters) {
  Eigen::Vector2d out = v;
  for (int i = 0; i < quarters; ++i) out = Eigen::Vector2d(out.y(), -out.x());
  return out;
}

}  // namespace

std::optional<LatticeMotion> LatticeMotion::of(const Eigen::Isometry3d& new_from_old) {
  const Eigen::Matrix3d rotation = new_from_old.linear();
  if (!is_upright(rotation)) return std::nullopt;
  const double yaw_rad = std::atan2(rotation(1, 0), rotation(0, 0));
  const double quarters = std::round(yaw_rad / kQuarter);
  const double rest_rad = yaw_rad - quarters * kQuarter;
  LatticeMotion motion;
  motion.quarters_ = (static_cast<int>(quarters) + 4) % 4;
  motion.quarters_first_ = quarters < 0.0;
  motion.shift_.z() = rounded(new_from_old.translation().z());
  const Eigen::Vector2d shift = new_from_old.translation().head<2>();
  const Eigen::Vector2d before_quarters =
      motion.quarters_first_ ? shift : turned_back(shift, motion.quarters_);
  if (std::abs(rest_rad) <= kNoTurn) {
    motion.shift_.x() = rounded(before_quarters.x());
    motion.shift_.y() = rounded(before_quarters.y());
    return motion;
  }
  motion.shear_x_ = -std::tan(0.5 * rest_rad);
  motion.shear_y_ = std::sin(rest_rad);
  motion.fixed_ = fixed_point(rest_rad, before_quarters);
  return motion;
}

Eigen::Vector3d LatticeMotion::operator()(const Eigen::Vector3d& centre) const noexcept {
  Eigen::Vector3d moved = centre;
  if (quarters_first_) turn_quarters(moved);
  shear(moved);
  moved += shift_;
  if (!quarters_first_) turn_quarters(moved);
  return moved;
}

void LatticeMotion::turn_quarters(Eigen::Vector3d& centre) const noexcept {
  for (int i = 0; i < quarters_; ++i) {
    centre.head<2>() = Eigen::Vector2d(-centre.y(), centre.x());
  }
}

void LatticeMotion::shear(Eigen::Vector3d& centre) const noexcept {
  centre.x() += rounded(shear_x_ * (centre.y() - fixed_.y()));
  centre.y() += rounded(shear_y_ * (centre.x() - fixed_.x()));
  centre.x() += rounded(shear_x_ * (centre.y() - fixed_.y()));
}

}  // namespace hypermap
