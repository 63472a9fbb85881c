// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr double kRingStepPx = 7.0;
constexpr int kPlacesPerRing = 24;

bool inside(const ImageRect& inner, const ImageRect& outer) {
  return inner.x_px >= outer.x_px && inner.y_px >= outer.y_px &&
         inner.x_px + inner.width_px <= outer.x_px + outer.width_px &&
         inner.y_px + inner.height_px <= outer.y_px + outer.height_px;
}

bool holds(const ImageRect& rect, double x_px, double y_px) {
  return inside({x_px, y_px, 0.0, 0.0}, rect);
}

ImageRect grown(const ImageRect& rect, double by_px) {
  return {rect.x_px - by_px,
          rect.y_px - by_px,
          rect.width_px + 2.0 * by_px,
          rect.height_px + 2.0 * by_px};
}

/// The label with the middle of its lower edge moved by (dx, dy) from the anchor.
ImageRect label_at(const LabelRequest& request, double dx_px, double dy_px) {
  return {request.anchor_x_px + dx_px - 0.5 * request.width_px,
          request.anchor_y_px + dy_px - request.height_px,
          request.width_px,
          request.height_px};
}

/// From a point to the nearest point of a rectangle.
double distance_px(const ImageRect& rect, double x_px, double y_px) {
  const double dx = std::max({rect.x_px - x_px, 0.0, x_px - rect.x_px - rect.width_px});
  const double dy = std::max({rect.y_px - y_px, 0.0, y_px - rect.y_px - rect.height_px});
  return std::hypot(dx, dy);
}

/// The canvas with what already stands on it.
class Board {
 public:
  Board(const ImageRect& canvas, std::span<const ImageRect> obstacles, double gap_px)
      : canvas_(canvas), taken_(obstacles.begin(), obstacles.end()), gap_px_(gap_px) {}

  /// The subjects that labels placed from now on keep off.
  void keep_off(std::vector<ImageRect> subjects) { subjects_ = std::move(subjects); }

  [[nodiscard]] bool contains(const LabelRequest& request) const {
    return holds(canvas_, request.anchor_x_px, request.anchor_y_px);
  }
  [[nodiscard]] bool is_free(const ImageRect& rect) const {
    const ImageRect with_gap = grown(rect, gap_px_);
    const auto is_met = [](const ImageRect& one) {
      return [&one](const ImageRect& other) { return overlap(one, other); };
    };
    return inside(rect, canvas_) && std::none_of(taken_.begin(), taken_.end(), is_met(with_gap)) &&
           std::none_of(subjects_.begin(), subjects_.end(), is_met(rect));
  }
  void take(const ImageRect& rect) { taken_.push_back(rect); }

 private:
  ImageRect canvas_;
  std::vector<ImageRect> taken_;
  std::vector<ImageRect> subjects_;
  double gap_px_;
};

/// Tries rings of growing radius, on each from straight up alternately to both sides.
std::optional<ImageRect> find_place(const LabelRequest& request,
                                    const Board& board,
                                    const LabelLayoutOptions& options) {
  const ImageRect above = label_at(request, 0.0, -options.gap_px);
  if (board.is_free(above)) return above;
  // Wide labels are moved farther sideways than up, else they hide what they speak of.
  const double stretch = std::clamp(request.width_px / (2.0 * request.height_px), 1.0, 2.5);
  for (double radius = kRingStepPx; radius <= options.max_distance_px; radius += kRingStepPx) {
    for (int i = 0; i < kPlacesPerRing; ++i) {
      const int step = (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2);
      const double angle = 2.0 * std::numbers::pi * step / kPlacesPerRing;
      const ImageRect place = label_at(
          request, stretch * radius * std::sin(angle), -radius * std::cos(angle) - options.gap_px);
      const double distance = distance_px(place, request.anchor_x_px, request.anchor_y_px);
      if (distance <= options.max_distance_px && board.is_free(place)) return place;
    }
  }
  return std::nullopt;
}

std::vector<ImageRect> subjects_of(std::span<const LabelRequest> requests) {
  std::vector<ImageRect> subjects;
  for (const LabelRequest& request : requests) {
    if (request.subject.width_px > 0.0) subjects.push_back(request.subject);
  }
  return subjects;
}

}  // namespace

bool overlap(const ImageRect& a, const ImageRect& b) {
  return a.x_px < b.x_px + b.width_px && b.x_px < a.x_px + a.width_px &&
         a.y_px < b.y_px + b.height_px && b.y_px < a.y_px + a.height_px;
}

std::vector<PlacedLabel> place_labels(std::span<const LabelRequest> requests,
                                      const ImageRect& canvas,
                                      std::span<const ImageRect> obstacles,
                                      const LabelLayoutOptions& options) {
  Board board(canvas, obstacles, options.gap_px);
  std::vector<PlacedLabel> placed;
  placed.reserve(requests.size());
  const std::vector<ImageRect> subjects = subjects_of(requests);
  for (const LabelRequest& request : requests) {
    board.keep_off(subjects);
    auto place = board.contains(request) ? find_place(request, board, options) : std::nullopt;
    if (!place && board.contains(request)) {
      board.keep_off(subjects_of({&request, 1}));
      place = find_place(request, board, options);
    }
    if (!place) {
      placed.push_back({.rect = {}, .shown = false});
      continue;
    }
    board.take(*place);
    const double away = distance_px(*place, request.anchor_x_px, request.anchor_y_px);
    placed.push_back({.rect = *place, .leader = away > options.leader_from_px});
  }
  return placed;
}

}  // namespace hypermap
