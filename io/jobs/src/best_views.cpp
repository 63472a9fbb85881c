// SPDX-License-Identifier: BSD-3-Clause
#include "best_views.hpp"

#include "hypermap/io/codec/jpeg_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr int kViewQuality = 85;

/// Pixels [begin, end) of one side.
struct PixelSpan {
  int begin = 0;
  int end = 0;
  [[nodiscard]] int length() const noexcept { return std::max(0, end - begin); }
};

/// Of edges of a box, in an image of `size_px` pixels.
PixelSpan pixels_between(double min_px, double max_px, int size_px) {
  const auto limit = static_cast<double>(size_px);
  return {static_cast<int>(std::floor(std::clamp(min_px, 0.0, limit))),
          static_cast<int>(std::ceil(std::clamp(max_px, 0.0, limit)))};
}

/// The `i`-th of `count` parts of the span, none of them empty. Requires: count <= length.
PixelSpan part_of(const PixelSpan& span, int i, int count) {
  const auto edge = [&](int k) {
    return span.begin + static_cast<int>(std::int64_t{k} * span.length() / count);
  };
  return {edge(i), edge(i + 1)};
}

Rgb8 mean_color(const ColorImage& image, const PixelSpan& columns, const PixelSpan& rows) {
  std::array<std::uint32_t, 3> sums{};
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = columns.begin; u < columns.end; ++u) {
      const Rgb8& pixel = image.at(u, v);
      sums[0] += pixel.r;
      sums[1] += pixel.g;
      sums[2] += pixel.b;
    }
  }
  const auto count = static_cast<std::uint32_t>(columns.length() * rows.length());
  const auto mean = [count](std::uint32_t sum) {
    return static_cast<std::uint8_t>((sum + count / 2U) / count);
  };
  return {mean(sums[0]), mean(sums[1]), mean(sums[2])};
}

bool is_better(const ObjectView& a, const ObjectView& b) {
  return a.quality != b.quality ? a.quality > b.quality : a.frame_index < b.frame_index;
}

}  // namespace

ColorImage thumbnail(const ColorImage& image, const PixelBox& box_px, int max_side_px) {
  const PixelSpan columns = pixels_between(box_px.u_min_px, box_px.u_max_px, image.width_px());
  const PixelSpan rows = pixels_between(box_px.v_min_px, box_px.v_max_px, image.height_px());
  if (columns.length() == 0 || rows.length() == 0) return {};
  const int longest = std::max(columns.length(), rows.length());
  const auto shortened = [&](int side_px) {
    if (longest <= max_side_px) return side_px;
    return std::max(1, static_cast<int>(std::int64_t{side_px} * max_side_px / longest));
  };
  ColorImage out(shortened(columns.length()), shortened(rows.length()));
  for (int v = 0; v < out.height_px(); ++v) {
    const PixelSpan rows_of_pixel = part_of(rows, v, out.height_px());
    for (int u = 0; u < out.width_px(); ++u) {
      out.at(u, v) = mean_color(image, part_of(columns, u, out.width_px()), rows_of_pixel);
    }
  }
  return out;
}

Result<std::string> view_jpeg(const ColorImage& image, const PixelBox& box_px) {
  std::string jpeg;
  for (int max_side_px = kMaxViewSidePx; max_side_px > 0; max_side_px /= 2) {
    HYPERMAP_ASSIGN_OR_RETURN(jpeg,
                              encode_jpeg(thumbnail(image, box_px, max_side_px), kViewQuality));
    if (jpeg.size() <= kMaxViewBytes) break;
  }
  return jpeg;
}

void BestViews::merge(const ObjectMerge& merge) {
  auto gone = views_.extract(merge.from);
  if (gone.empty()) return;
  const auto [kept, is_new] = views_.try_emplace(merge.into, gone.mapped());
  if (!is_new && is_better(gone.mapped(), kept->second)) kept->second = std::move(gone.mapped());
}

void BestViews::follow(const FrameReport& report, const ObjectMap& objects) {
  for (const ObjectMerge& one : report.merged) merge(one);
  if (report.num_removed == 0) return;
  std::erase_if(views_, [&](const auto& one) { return !objects.contains(one.first); });
}

Result<void> BestViews::add(const RgbdFrame& frame, const FrameReport& report) {
  if (frame.color.empty()) return {};
  saw_color_ = true;
  for (const DetectedObject& seen : report.detected) {
    ObjectView view{.quality = static_cast<double>(seen.num_pixels) * seen.score.value(),
                    .frame_index = frame.index,
                    .jpeg = {}};
    const auto known = views_.find(seen.id);
    if (!(view.quality > 0.0) || (known != views_.end() && !is_better(view, known->second))) {
      continue;
    }
    HYPERMAP_ASSIGN_OR_RETURN(view.jpeg, view_jpeg(frame.color, seen.box_px));
    views_.insert_or_assign(seen.id, std::move(view));
  }
  return {};
}

}  // namespace hypermap
