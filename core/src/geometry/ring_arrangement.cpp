// SPDX-License-Identifier: BSD-3-Clause
#include "ring_arrangement.hpp"

#include "exact_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kUnset = std::numeric_limits<std::size_t>::max();
constexpr double kRoundingM = 1e-9;
constexpr std::size_t kMaxCrossings = 100'000;
/// A crossing costs as much as this many pairs of edges whose boxes lie apart.
constexpr std::uint64_t kTestsOfCrossing = 500;

/// Gives equal points, after rounding, the same number.
class NodeTable {
 public:
  std::size_t number(const Eigen::Vector2d& point) {
    const std::pair key{std::llround(point.x() / kRoundingM), std::llround(point.y() / kRoundingM)};
    const auto [it, is_new] = number_of_.try_emplace(key, nodes.size());
    if (is_new) nodes.push_back(point);
    return it->second;
  }

  std::vector<Eigen::Vector2d> nodes;

 private:
  std::map<std::pair<long long, long long>, std::size_t> number_of_;
};

/// The places where two segments that meet divide each other.
std::vector<Eigen::Vector2d> common_points(const Eigen::Vector2d& a,
                                           const Eigen::Vector2d& b,
                                           const Eigen::Vector2d& c,
                                           const Eigen::Vector2d& d) {
  std::vector<Eigen::Vector2d> out;
  for (const auto& p : {a, b}) {
    if (segments_intersect(c, d, p, p)) out.push_back(p);
  }
  for (const auto& p : {c, d}) {
    if (segments_intersect(a, b, p, p)) out.push_back(p);
  }
  if (!out.empty() || !segments_intersect(a, b, c, d)) return out;
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = d - c;
  const Eigen::Vector2d w = c - a;
  const double t = (w.x() * v.y() - w.y() * v.x()) / (u.x() * v.y() - u.y() * v.x());
  out.emplace_back(a + std::clamp(t, 0.0, 1.0) * u);
  return out;
}

bool boxes_apart(const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b,
                 const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d) {
  return (a.cwiseMax(b).array() < c.cwiseMin(d).array()).any() ||
         (c.cwiseMax(d).array() < a.cwiseMin(b).array()).any();
}

/// For each edge of the ring its ends and all places where another edge meets it, in their order.
Result<std::vector<Ring>> divided_edges(const Ring& ring, const LoadBudget& budget) {
  const std::size_t n = ring.size();
  const auto end_of = [&](std::size_t i) -> const Eigen::Vector2d& { return ring[(i + 1) % n]; };
  std::vector<Ring> edges(n);
  std::size_t num_crossings = 0;
  for (std::size_t i = 0; i < n; ++i) {
    edges[i].insert(edges[i].end(), {ring[i], end_of(i)});
    const std::size_t before = num_crossings;
    for (std::size_t k = 0; k < i; ++k) {
      if (boxes_apart(ring[i], end_of(i), ring[k], end_of(k))) continue;
      const auto common = common_points(ring[i], end_of(i), ring[k], end_of(k));
      edges[i].insert(edges[i].end(), common.begin(), common.end());
      edges[k].insert(edges[k].end(), common.begin(), common.end());
      const bool neighbours = k + 1 == i || (k == 0 && i == n - 1);
      if (!neighbours && !common.empty() && ++num_crossings > kMaxCrossings) {
        return fail(
            ErrorCode::kLimit,
            "the ring crosses itself more than " + std::to_string(kMaxCrossings) + " times");
      }
    }
    HYPERMAP_TRY(budget.draw_edge_tests(i + kTestsOfCrossing * (num_crossings - before)));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& start = ring[i];
    const Eigen::Vector2d along = end_of(i) - start;
    std::sort(edges[i].begin(), edges[i].end(), [&](const auto& p, const auto& q) {
      return along.dot(p - start) < along.dot(q - start);
    });
  }
  return edges;
}

/// Direction of a half-edge as an angle.
double heading(const std::vector<Eigen::Vector2d>& nodes,
               const std::vector<HalfEdge>& edges,
               std::size_t half_edge) {
  const Eigen::Vector2d way = nodes[edges[twin(half_edge)].from] - nodes[edges[half_edge].from];
  return std::atan2(way.y(), way.x());
}

}  // namespace

Result<RingArrangement> RingArrangement::create(const Ring& ring, const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<Ring> edges, divided_edges(ring, budget));
  NodeTable table;
  std::map<std::pair<std::size_t, std::size_t>, int> net_of_piece;
  for (const Ring& points : edges) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const std::size_t from = table.number(points[i - 1]);
      const std::size_t to = table.number(points[i]);
      if (from == to) continue;
      net_of_piece[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  RingArrangement out;
  out.nodes_ = std::move(table.nodes);
  for (const auto& [ends, net] : net_of_piece) {
    out.half_edges_.push_back({.from = ends.first, .face = kUnset, .net = net});
    out.half_edges_.push_back({.from = ends.second, .face = kUnset, .net = -net});
  }
  out.link_around_nodes();
  out.find_faces();
  out.wind();
  return out;
}

void RingArrangement::link_around_nodes() {
  std::vector<std::vector<std::size_t>> leaving(nodes_.size());
  for (std::size_t h = 0; h < half_edges_.size(); ++h) leaving[half_edges_[h].from].push_back(h);
  for (auto& fan : leaving) {
    std::sort(fan.begin(), fan.end(), [this](std::size_t a, std::size_t b) {
      return heading(nodes_, half_edges_, a) > heading(nodes_, half_edges_, b);
    });
    for (std::size_t i = 0; i < fan.size(); ++i) {
      half_edges_[fan[i]].next_clockwise = fan[(i + 1) % fan.size()];
    }
  }
}

void RingArrangement::find_faces() {
  double lowest_area = std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < half_edges_.size(); ++start) {
    if (half_edges_[start].face != kUnset) continue;
    double area2 = 0.0;
    for (std::size_t h = start; half_edges_[h].face == kUnset;
         h = half_edges_[twin(h)].next_clockwise) {
      half_edges_[h].face = windings_.size();
      const Eigen::Vector2d a = nodes_[half_edges_[h].from] - nodes_[0];
      const Eigen::Vector2d b = nodes_[half_edges_[twin(h)].from] - nodes_[0];
      area2 += a.x() * b.y() - a.y() * b.x();
    }
    // The ring is connected, so that only the face outside is gone around clockwise.
    if (area2 < lowest_area) outside_ = windings_.size();
    lowest_area = std::min(lowest_area, area2);
    windings_.push_back(0);
  }
}

void RingArrangement::wind() {
  std::vector<std::vector<std::size_t>> sides(windings_.size());
  for (std::size_t h = 0; h < half_edges_.size(); ++h) sides[half_edges_[h].face].push_back(h);
  std::vector<bool> known(windings_.size(), false);
  std::vector<std::size_t> open{outside_};
  known[outside_] = true;
  while (!open.empty()) {
    const std::size_t face = open.back();
    open.pop_back();
    for (const std::size_t h : sides[face]) {
      const std::size_t across = half_edges_[twin(h)].face;
      if (known[across]) continue;
      known[across] = true;
      windings_[across] = windings_[face] - half_edges_[h].net;
      open.push_back(across);
    }
  }
}

}  // namespace hypermap
