// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points that planes are tried on.
#pragma once

#include "plane_test.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Points side by side, so that a plane is tested against several of them at once.
class PlanePoints {
 public:
  void add(const Eigen::Vector3f& point, float noise_m) {
    x_.push_back(point.x());
    y_.push_back(point.y());
    z_.push_back(point.z());
    noise_m_.push_back(noise_m);
  }
  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] Eigen::Vector3f operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  [[nodiscard]] bool lies_on(const PlaneTest& test, std::size_t i) const {
    return test.holds(x_[i], y_[i], z_[i], noise_m_[i]);
  }
  /// How many of [begin, end) lie on the plane.
  [[nodiscard]] std::size_t count(const PlaneTest& test, std::size_t begin, std::size_t end) const {
    std::int32_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += lies_on(test, i) ? 1 : 0;
    return static_cast<std::size_t>(count);
  }
  void erase_on(const PlaneTest& test) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (lies_on(test, i)) continue;
      for (auto* values : {&x_, &y_, &z_, &noise_m_}) (*values)[kept] = (*values)[i];
      ++kept;
    }
    for (auto* values : {&x_, &y_, &z_, &noise_m_}) values->resize(kept);
  }

 private:
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<float> noise_m_;
};

}  // namespace hypermap
