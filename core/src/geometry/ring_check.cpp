// SPDX-License-Identifier: BSD-3-Clause
#include "ring_check.hpp"

#include "exact_orientation.hpp"
#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace hypermap {
namespace {

bool is_usable(const Eigen::Vector2d& p) {
  // Written so that NaN is not usable.
  return std::abs(p.x()) <= kMaxCoordinateM && std::abs(p.y()) <= kMaxCoordinateM;
}

std::size_t num_distinct(const Ring& ring) {
  std::set<std::pair<double, double>> seen;
  for (const Eigen::Vector2d& p : ring) {
    seen.emplace(p.x(), p.y());
    if (seen.size() >= 3) break;
  }
  return seen.size();
}

bool turns_back(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return orientation(a, b, c) == 0 && (b - a).dot(c - b) < 0.0;
}

}  // namespace

std::string point_text(const Eigen::Vector2d& point) {
  return "(" + number_text(point.x()) + ", " + number_text(point.y()) + ")";
}

double signed_area_m2(const Ring& ring) {
  double area2 = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i] - ring[0];
    const Eigen::Vector2d b = ring[i + 1] - ring[0];
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * area2;
}

bool is_counter_clockwise(const Ring& ring) {
  // The leftmost corner, the lowest of several, sticks out.
  const auto corner = std::min_element(ring.begin(), ring.end(), [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const auto& before = corner == ring.begin() ? ring.back() : *(corner - 1);
  const auto& after = corner + 1 == ring.end() ? ring.front() : *(corner + 1);
  return orientation(before, *corner, after) > 0;
}

namespace {

/// Finite, without repeated consecutive points.
Result<Ring> usable_ring(Ring ring) {
  const auto bad = std::find_if_not(ring.begin(), ring.end(), is_usable);
  if (bad != ring.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "point " + std::to_string(bad - ring.begin()) + " is " + point_text(*bad) +
                    ", expected finite coordinates within 1e6 m");
  }
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

Result<void> check_num_distinct(const Ring& ring) {
  const std::size_t count = num_distinct(ring);
  if (count >= 3) return {};
  return fail(ErrorCode::kInvalidArgument,
              "has " + std::to_string(count) + " distinct points, expected 3 or more");
}

/// Appends a point; the last ones that it would make the tip of a spike go.
void push_without_spikes(Ring& way, const Eigen::Vector2d& next) {
  while (way.size() > 1 && turns_back(way[way.size() - 2], way.back(), next)) way.pop_back();
  if (way.empty() || way.back() != next) way.push_back(next);
}

/// A way without spikes, closed: those about its end go.
Ring closed_without_spikes(const Ring& way) {
  auto first = way.begin();
  auto last = way.end();
  while (last - first >= 3) {
    if (*first == *(last - 1) || turns_back(*(last - 2), *(last - 1), *first)) {
      --last;
    } else if (turns_back(*(last - 1), *first, *(first + 1))) {
      ++first;
    } else {
      break;
    }
  }
  return {first, last};
}

}  // namespace

Result<Ring> cleaned_ring(Ring ring) {
  HYPERMAP_ASSIGN_OR_RETURN(ring, usable_ring(std::move(ring)));
  HYPERMAP_TRY(check_num_distinct(ring));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& tip = ring[(i + 1) % ring.size()];
    if (turns_back(ring[i], tip, ring[(i + 2) % ring.size()])) {
      return fail(ErrorCode::kInvalidArgument, "has a spike at " + point_text(tip));
    }
  }
  return ring;
}

Result<SpikeFreeRing> without_spikes(Ring ring) {
  HYPERMAP_ASSIGN_OR_RETURN(const Ring usable, usable_ring(std::move(ring)));
  Ring way;
  way.reserve(usable.size());
  for (const Eigen::Vector2d& point : usable) push_without_spikes(way, point);
  SpikeFreeRing result{closed_without_spikes(way), false};
  result.had_spikes = result.ring.size() < usable.size();
  HYPERMAP_TRY(check_num_distinct(result.ring));
  return result;
}

}  // namespace hypermap
