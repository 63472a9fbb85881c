// SPDX-License-Identifier: BSD-3-Clause
#include "exact_orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

/// A sum of doubles that do not overlap, smallest first: the exact value of what was added.
class Expansion {
 public:
  void add(double term) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = term + parts_[i];
      const double virtual_part = sum - term;
      parts_[i] = (term - (sum - virtual_part)) + (parts_[i] - virtual_part);
      term = sum;
    }
    parts_[size_++] = term;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  /// The largest part that is not zero decides.
  [[nodiscard]] int sign() const {
    for (std::size_t i = size_; i-- > 0;) {
      if (parts_[i] != 0.0) return parts_[i] > 0.0 ? 1 : -1;
    }
    return 0;
  }

 private:
  std::array<double, 12> parts_{};
  std::size_t size_ = 0;
};

int exact_orientation(const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b,
                      const Eigen::Vector2d& c) {
  Expansion determinant;
  determinant.add_product(a.x(), b.y());
  determinant.add_product(-a.y(), b.x());
  determinant.add_product(b.x(), c.y());
  determinant.add_product(-b.y(), c.x());
  determinant.add_product(c.x(), a.y());
  determinant.add_product(-c.y(), a.x());
  return determinant.sign();
}

/// Requires: p on the line through a and b.
bool lies_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (p.array() >= a.array().min(b.array())).all() &&
         (p.array() <= a.array().max(b.array())).all();
}

}  // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  // Shewchuk's bound for this expression: (3 + 16 eps) eps of the sum of magnitudes.
  constexpr double kBound = 3.3306690738754716e-16;
  if (std::abs(determinant) > kBound * (std::abs(left) + std::abs(right))) {
    return determinant > 0.0 ? 1 : -1;
  }
  return exact_orientation(a, b, c);
}

bool segments_intersect(const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b,
                        const Eigen::Vector2d& c,
                        const Eigen::Vector2d& d) {
  const int abc = orientation(a, b, c);
  const int abd = orientation(a, b, d);
  const int cda = orientation(c, d, a);
  const int cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && lies_between(a, b, c)) || (abd == 0 && lies_between(a, b, d)) ||
         (cda == 0 && lies_between(c, d, a)) || (cdb == 0 && lies_between(c, d, b));
}

}  // namespace hypermap
