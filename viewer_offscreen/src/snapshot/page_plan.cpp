// SPDX-License-Identifier: BSD-3-Clause
#include "page_style.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace hypermap {
namespace {

constexpr double kMarginPx = 22.0;
constexpr double kMaxNamePx = 190.0;

}  // namespace

LegendColumns measure(const TextPainter& text, const Legend& legend, const Look& look) {
  LegendColumns columns;
  columns.number_px.resize(legend.columns.size());
  for (std::size_t i = 0; i < legend.columns.size(); ++i) {
    columns.number_px[i] = text.width_px(legend.columns[i], look.heading());
  }
  for (const LegendRow& row : legend.rows) {
    columns.name_px = std::max(columns.name_px, text.width_px(row.name, look.row()));
    for (std::size_t i = 0; i < std::min(row.numbers.size(), columns.number_px.size()); ++i) {
      columns.number_px[i] =
          std::max(columns.number_px[i], text.width_px(row.numbers[i], look.row()));
    }
  }
  columns.name_px = std::min(columns.name_px, look.px(kMaxNamePx));
  return columns;
}

PagePlan plan_page(const TextPainter& text,
                   const Annotations& annotations,
                   const SnapshotOptions& options) {
  const double width_px = options.width_px;
  const double height_px = options.height_px;
  PagePlan plan;
  plan.scene_fills_page = std::holds_alternative<PoseView>(options.view);
  plan.scale = std::clamp(std::min(width_px / 1280.0, height_px / 720.0), 0.6, 6.0);
  const Look look{plan.scale};
  const double margin = look.px(kMarginPx);
  plan.canvas = {0.0, 0.0, width_px, height_px};
  plan.title = {margin,
                look.px(14.0),
                0.0,
                look.px(50.0 + kNotePx * static_cast<double>(annotations.notes.size()))};
  plan.foot = {margin, height_px - look.px(72.0), look.px(kScaleBarPx + 100.0), look.px(56.0)};
  const double top = plan.title.y_px + plan.title.height_px;
  double right = width_px - margin;
  if (!annotations.legend.rows.empty()) {
    const LegendColumns columns = measure(text, annotations.legend, look);
    const double width = columns.total_px(look) + look.px(24.0);
    const double head_rows = annotations.legend.columns.empty() ? 0.0 : 1.0;
    const double room = (height_px - 2.0 * margin - look.px(20.0)) / look.px(kRowPx) - head_rows;
    const auto all = annotations.legend.rows.size();
    const auto fitting = static_cast<std::size_t>(std::max(1.0, std::floor(room)));
    plan.num_legend_rows = all <= fitting ? all : fitting - 1;
    const double rows = static_cast<double>(std::min(all, fitting)) + head_rows;
    plan.legend = {right - width, margin, width, rows * look.px(kRowPx) + look.px(16.0)};
    right -= width + look.px(10.0);
  }
  double title_px = std::max(text.width_px(annotations.title, look.title()),
                             text.width_px(annotations.subtitle, look.small()));
  for (const std::string& note : annotations.notes)
    title_px = std::max(title_px, text.width_px(note, look.small()));
  plan.title.width_px = std::clamp(title_px + 1.0, 1.0, std::max(1.0, right - margin));
  plan.content = {margin,
                  top + look.px(10.0),
                  std::max(16.0, right - margin),
                  std::max(16.0, plan.foot.y_px - top - look.px(14.0))};
  return plan;
}

}  // namespace hypermap
