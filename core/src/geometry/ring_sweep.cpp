// SPDX-License-Identifier: BSD-3-Clause
#include "ring_sweep.hpp"

#include "exact_orientation.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

namespace hypermap {
namespace {

/// Left to right, on a vertical line from below: a sweep line that leans by an infinitesimal angle.
bool comes_before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

struct Edge {
  std::size_t from = 0;  ///< The end that the sweep meets first: a position in `points`.
  std::size_t to = 0;
};

/// A corner and the two edges that meet in it.
struct Corner {
  std::size_t point = 0;
  std::size_t edge_in = 0;
  std::size_t edge_out = 0;
};

/// The edges of all rings in one list.
struct EdgeSoup {
  std::vector<Eigen::Vector2d> points;
  std::vector<Edge> edges;
  std::vector<Corner> corners;  ///< In the order in which the sweep meets them.

  explicit EdgeSoup(std::span<const Ring> rings) {
    for (const Ring& ring : rings) append(ring);
    std::sort(corners.begin(), corners.end(), [this](const Corner& a, const Corner& b) {
      return comes_before(points[a.point], points[b.point]);
    });
  }

  void append(const Ring& ring) {
    const std::size_t first = points.size();
    points.insert(points.end(), ring.begin(), ring.end());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t here = first + i;
      const std::size_t next = first + (i + 1) % ring.size();
      const bool forward = comes_before(points[here], points[next]);
      edges.push_back(forward ? Edge{here, next} : Edge{next, here});
      corners.push_back({here, first + (i + ring.size() - 1) % ring.size(), here});
    }
  }
};

/// Which of two edges that the sweep line meets lies lower. Exact as long as no two of them cross.
struct LiesLower {
  const EdgeSoup* soup;

  bool operator()(std::size_t a, std::size_t b) const {
    if (a == b) return false;
    const Edge& edge_a = soup->edges[a];
    const Edge& edge_b = soup->edges[b];
    if (comes_before(soup->points[edge_b.from], soup->points[edge_a.from])) {
      return side_of(edge_b, edge_a) < 0;
    }
    return side_of(edge_a, edge_b) > 0;
  }

  /// Where `later` starts relative to `earlier`; edges of one corner are ordered by their other
  /// ends.
  [[nodiscard]] int side_of(const Edge& earlier, const Edge& later) const {
    const auto& points = soup->points;
    const Eigen::Vector2d& from = points[earlier.from];
    const Eigen::Vector2d& to = points[earlier.to];
    const int start = orientation(from, to, points[later.from]);
    return start != 0 ? start : orientation(from, to, points[later.to]);
  }
};

class Sweep {
 public:
  explicit Sweep(std::span<const Ring> rings) : soup_(rings), active_(LiesLower{&soup_}) {
    position_.resize(soup_.edges.size());
  }

  std::optional<Eigen::Vector2d> run() {
    if (auto repeated = repeated_corner()) return repeated;
    for (const Corner& corner : soup_.corners) {
      const bool ok = leave(corner, corner.edge_in) && leave(corner, corner.edge_out) &&
                      enter(corner, corner.edge_in) && enter(corner, corner.edge_out);
      if (!ok) return soup_.points[corner.point];
    }
    return std::nullopt;
  }

 private:
  using Active = std::set<std::size_t, LiesLower>;

  [[nodiscard]] std::optional<Eigen::Vector2d> repeated_corner() const {
    for (std::size_t i = 1; i < soup_.corners.size(); ++i) {
      const Eigen::Vector2d& point = soup_.points[soup_.corners[i].point];
      if (point == soup_.points[soup_.corners[i - 1].point]) return point;
    }
    return std::nullopt;
  }

  /// Takes an edge out that ends here; false when its neighbours, now beside each other, meet.
  bool leave(const Corner& corner, std::size_t edge) {
    if (soup_.edges[edge].to != corner.point) return true;
    const auto next = active_.erase(position_[edge]);
    return next == active_.end() || next == active_.begin() || apart(*std::prev(next), *next);
  }

  /// Puts an edge in that begins here; false when it meets one beside it.
  bool enter(const Corner& corner, std::size_t edge) {
    if (soup_.edges[edge].from != corner.point) return true;
    const auto [here, is_new] = active_.insert(edge);
    if (!is_new) return false;  // on the same line as another one
    position_[edge] = here;
    if (here != active_.begin() && !apart(*std::prev(here), edge)) return false;
    return std::next(here) == active_.end() || apart(edge, *std::next(here));
  }

  /// True when two edges have nothing in common but a corner that belongs to both.
  [[nodiscard]] bool apart(std::size_t a, std::size_t b) const {
    const Edge& p = soup_.edges[a];
    const Edge& q = soup_.edges[b];
    const auto& points = soup_.points;
    if (p.from == q.from) return orientation(points[p.from], points[p.to], points[q.to]) != 0;
    if (p.to == q.to) return orientation(points[p.to], points[p.from], points[q.from]) != 0;
    if (p.from == q.to || p.to == q.from) return true;  // one ends where the other begins
    return !segments_intersect(points[p.from], points[p.to], points[q.from], points[q.to]);
  }

  EdgeSoup soup_;
  Active active_;
  std::vector<Active::iterator> position_;
};

}  // namespace

std::optional<Eigen::Vector2d> first_intersection(std::span<const Ring> rings) {
  return Sweep(rings).run();
}

}  // namespace hypermap
