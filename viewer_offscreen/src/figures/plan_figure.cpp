// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/plan_figure.hpp"

#include "figure_page.hpp"
#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"
#include "plan_layout.hpp"
#include "plan_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kLegendPx = 92;
constexpr double kPlanScaleBarPx = 200.0;
constexpr double kGridLinePx = 90.0;  // at most from one to the next
constexpr double kMarkPx = 9.0;
constexpr Rgb8 kTruthBlue{0, 90, 181};
constexpr Rgb8 kMapOrange{240, 160, 40};
constexpr Rgb8 kMapEdge{176, 100, 0};
constexpr Rgb8 kMatchGreen{20, 130, 60};
constexpr Rgb8 kWrongRed{205, 30, 30};
constexpr Rgb8 kApartGrey{130, 136, 145};
constexpr Rgb8 kPlanGrid{232, 235, 239};

/// The picture while it is made.
class PlanPage {
 public:
  PlanPage(const TextPainter& text, const PlanLayout& view)
      : text_(text),
        view_(view),
        image_(kPlanPageWidthPx,
               kPlanPageTopPx + static_cast<int>(std::ceil(view.height_px())) + kLegendPx,
               kFigurePaper) {}

  void draw_grid() {
    const double step_m = round_length_m(kGridLinePx / view_.px_per_m);
    const Eigen::Vector2d low = view_.bounds.min();
    const Eigen::Vector2d high = view_.bounds.max();
    for (double x = std::ceil(low.x() / step_m) * step_m; x <= high.x(); x += step_m)
      line({x, low.y()}, {x, high.y()}, 1.0, kPlanGrid);
    for (double y = std::ceil(low.y() / step_m) * step_m; y <= high.y(); y += step_m)
      line({low.x(), y}, {high.x(), y}, 1.0, kPlanGrid);
  }

  void draw_shapes(const ComparedPlan& plan) {
    for (const ComparedShape& object : plan.objects) {
      fill_shape(image_, in_px(object.footprint), kMapOrange, 0.45);
      stroke_shape(image_, in_px(object.footprint), 1.5, kMapEdge, StrokeStyle::kSolid);
    }
    for (const ComparedShape& truth : plan.truths) {
      const bool counts = truth.fate != ComparedFate::kApart;
      stroke_shape(image_,
                   in_px(truth.footprint),
                   2.5,
                   kTruthBlue,
                   counts ? StrokeStyle::kSolid : StrokeStyle::kDashed);
    }
  }

  void draw_marks(const ComparedPlan& plan) {
    for (const ComparedShape& truth : plan.truths) {
      const Eigen::Vector2d at = view_.to_px(truth.centroid);
      if (truth.partner) match_mark(at, view_.to_px(plan.objects[*truth.partner].centroid));
      if (truth.fate == ComparedFate::kMissed) cross_mark(at);
    }
    for (const ComparedShape& object : plan.objects) {
      const Eigen::Vector2d at = view_.to_px(object.centroid);
      if (object.fate == ComparedFate::kFalse) ring_mark(at, kWrongRed);
      if (object.fate == ComparedFate::kDuplicate) ring_mark(at, kApartGrey);
    }
  }

  /// What is wrong gets its label first, so that it has one.
  void draw_labels(const ComparedPlan& plan) {
    std::vector<PlanLabel> labels;
    for (const bool wrong : {true, false}) {
      for (const auto* shapes : {&plan.truths, &plan.objects}) {
        const bool is_map = shapes == &plan.objects;
        for (const ComparedShape& shape : *shapes) {
          const bool is_wrong =
              shape.fate == ComparedFate::kMissed || shape.fate == ComparedFate::kFalse;
          const bool has_label_at_truth = is_map && shape.fate == ComparedFate::kMatched;
          if (is_wrong == wrong && !has_label_at_truth) labels.push_back(label_of(shape, is_map));
        }
      }
    }
    write_labels(labels);
  }

  void draw_legend(const ComparedPlan& plan) {
    const auto of_truths = [&](ComparedFate fate) { return num_of(plan.truths, fate); };
    const auto of_objects = [&](ComparedFate fate) { return num_of(plan.objects, fate); };
    double x = kPlanPageMarginPx;
    const double first = image_.height_px() - kLegendPx + 34.0;
    x = legend_entry(x, first, "true object", plan.truths.size(), [&](const Eigen::Vector2d& at) {
      stroke_shape(image_, swatch(at), 2.5, kTruthBlue, StrokeStyle::kSolid);
    });
    x = legend_entry(
        x, first, "not counted", of_truths(ComparedFate::kApart), [&](const Eigen::Vector2d& at) {
          stroke_shape(image_, swatch(at), 2.5, kTruthBlue, StrokeStyle::kDashed);
        });
    legend_entry(
        x, first, "object of the map", plan.objects.size(), [&](const Eigen::Vector2d& at) {
          fill_shape(image_, swatch(at), kMapOrange, 0.45);
          stroke_shape(image_, swatch(at), 1.5, kMapEdge, StrokeStyle::kSolid);
        });
    x = kPlanPageMarginPx;
    const double second = first + 34.0;
    x = legend_entry(
        x, second, "matched", of_truths(ComparedFate::kMatched), [&](const Eigen::Vector2d& at) {
          match_mark(at - Eigen::Vector2d(9, 0), at + Eigen::Vector2d(9, 0));
        });
    x = legend_entry(
        x, second, "missed", of_truths(ComparedFate::kMissed), [&](const Eigen::Vector2d& at) {
          cross_mark(at);
        });
    x = legend_entry(
        x, second, "false", of_objects(ComparedFate::kFalse), [&](const Eigen::Vector2d& at) {
          ring_mark(at, kWrongRed);
        });
    legend_entry(x,
                 second,
                 "duplicate",
                 of_objects(ComparedFate::kDuplicate),
                 [&](const Eigen::Vector2d& at) { ring_mark(at, kApartGrey); });
  }

  void draw_scale_bar() {
    const double length_m = round_length_m(kPlanScaleBarPx / view_.px_per_m);
    const double length_px = length_m * view_.px_per_m;
    const Eigen::Vector2d right(kPlanPageWidthPx - kPlanPageMarginPx, image_.height_px() - 26.0);
    const Eigen::Vector2d left = right - Eigen::Vector2d(length_px, 0);
    const Eigen::Vector2d tick(0, 6);
    draw_line(image_, left, right, 2.0, kFigureInk);
    draw_line(image_, left - tick, left + tick, 2.0, kFigureInk);
    draw_line(image_, right - tick, right + tick, 2.0, kFigureInk);
    const TextStyle style{.height_px = 15, .color = kFigureInk};
    text_.write(image_, length_text(length_m), left.x() + 8.0, left.y() - 9.0, style);
  }

  void write_title(const std::string& title, const ComparedPlan& plan) {
    const TextStyle bold{.height_px = 20, .color = kFigureInk, .weight = FontWeight::kBold};
    const double room_px = kPlanPageWidthPx - 2.0 * kPlanPageMarginPx;
    text_.write(image_, text_.fitted(title, bold, room_px), kPlanPageMarginPx, 30.0, bold);
    if (!plan.truths.empty() || !plan.objects.empty()) return;
    const TextStyle style{.height_px = 16, .color = kApartGrey};
    text_.write(image_, "neither has an object", kPlanPageMarginPx, 56.0, style);
  }

  ColorImage take() { return std::move(image_); }

 private:
  struct PlanLabel {
    std::string text;
    TextStyle style;
    LabelRequest request;
  };

  [[nodiscard]] PixelShape in_px(const Polygon& polygon) const {
    PixelShape shape;
    const auto add = [&](const Ring& ring) {
      std::vector<Eigen::Vector2d>& points = shape.emplace_back();
      for (const Eigen::Vector2d& point : ring) points.push_back(view_.to_px(point));
    };
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
    return shape;
  }

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width_px, Rgb8 color) {
    draw_line(image_, view_.to_px(from), view_.to_px(to), width_px, color);
  }

  void match_mark(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px) {
    draw_line(image_, from_px, to_px, 2.0, kMatchGreen);
    draw_disc(image_, from_px, 3.5, kTruthBlue);
    draw_disc(image_, to_px, 3.5, kMapEdge);
  }
  void cross_mark(const Eigen::Vector2d& at_px) {
    const Eigen::Vector2d down(kMarkPx, kMarkPx);
    const Eigen::Vector2d up(kMarkPx, -kMarkPx);
    draw_line(image_, at_px - down, at_px + down, 4.0, kWrongRed);
    draw_line(image_, at_px - up, at_px + up, 4.0, kWrongRed);
  }
  void ring_mark(const Eigen::Vector2d& at_px, Rgb8 color) {
    PixelShape ring(1);
    constexpr int kCorners = 48;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kCorners;
      ring[0].push_back(at_px + 1.2 * kMarkPx * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    stroke_shape(image_, ring, 3.5, color, StrokeStyle::kSolid);
  }

  [[nodiscard]] static PixelShape swatch(const Eigen::Vector2d& at) {
    const Eigen::Vector2d x(12, 0);
    const Eigen::Vector2d y(0, 8);
    return {{at - x - y, at + x - y, at + x + y, at - x + y}};
  }

  /// Draws a sign with its meaning and count. Returns where the next one begins.
  template <class Sign>
  double legend_entry(
      double x_px, double y_px, const std::string& meaning, std::size_t count, const Sign& sign) {
    sign(Eigen::Vector2d(x_px + 14.0, y_px - 5.0));
    const TextStyle style{.height_px = 16, .color = kFigureInk};
    const std::string words = meaning + " (" + std::to_string(count) + ")";
    text_.write(image_, words, x_px + 36.0, y_px, style);
    return x_px + 36.0 + text_.width_px(words, style) + 30.0;
  }

  [[nodiscard]] PlanLabel label_of(const ComparedShape& shape, bool is_map) const {
    const bool is_wrong = shape.fate == ComparedFate::kMissed || shape.fate == ComparedFate::kFalse;
    const TextStyle style{.height_px = 14,
                          .color = is_wrong ? kWrongRed
                                   : is_map ? kMapEdge
                                            : kTruthBlue};
    PlanLabel label{.text = printable(shape.class_name, 40) + " " + std::to_string(shape.id),
                    .style = style,
                    .request = {}};
    const Eigen::Vector2d at = view_.to_px(shape.centroid);
    label.request = {.anchor_x_px = at.x(),
                     .anchor_y_px = at.y() - kMarkPx,
                     .width_px = text_.width_px(label.text, style),
                     .height_px = 1.2 * style.height_px};
    return label;
  }

  void write_labels(const std::vector<PlanLabel>& labels) {
    std::vector<LabelRequest> requests;
    std::vector<ImageRect> marks;
    for (const PlanLabel& label : labels) {
      requests.push_back(label.request);
      marks.push_back({label.request.anchor_x_px - kMarkPx,
                       label.request.anchor_y_px,
                       2.0 * kMarkPx,
                       2.0 * kMarkPx});
    }
    const ImageRect canvas{.x_px = 2.0,
                           .y_px = kPlanPageTopPx - 20.0,
                           .width_px = kPlanPageWidthPx - 4.0,
                           .height_px = view_.height_px() + 30.0};
    const auto placed = place_labels(requests, canvas, marks);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (!placed[i].shown) continue;
      const ImageRect& rect = placed[i].rect;
      if (placed[i].leader) {
        draw_line(image_,
                  {labels[i].request.anchor_x_px, labels[i].request.anchor_y_px},
                  {rect.x_px + 0.5 * rect.width_px, rect.y_px + 0.5 * rect.height_px},
                  1.0,
                  labels[i].style.color);
      }
      draw_plate(image_, rect, 3.0, kFigurePaper, 0.75);
      text_.write(
          image_, labels[i].text, rect.x_px, rect.y_px + 0.8 * rect.height_px, labels[i].style);
    }
  }

  const TextPainter& text_;
  const PlanLayout& view_;
  ColorImage image_;
};

}  // namespace

Result<ColorImage> draw_compared_plan(const ComparedPlan& plan,
                                      const std::string& title,
                                      const std::filesystem::path& font_file) {
  HYPERMAP_ASSIGN_OR_RETURN(const TextPainter text, TextPainter::create(font_file));
  const PlanLayout view = plan_layout_of(plan);
  PlanPage page(text, view);
  page.draw_grid();
  page.draw_shapes(plan);
  page.draw_marks(plan);
  page.draw_labels(plan);
  page.draw_legend(plan);
  page.draw_scale_bar();
  page.write_title(title, plan);
  return page.take();
}

}  // namespace hypermap
