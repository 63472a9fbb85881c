// SPDX-License-Identifier: BSD-3-Clause
#include "superpixel_methods.hpp"

#include "cpu_time.hpp"
#include "hypermap/projection/supercells/supercells.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/lsc.hpp>
#include <opencv2/ximgproc/seeds.hpp>
#include <opencv2/ximgproc/slic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hypermap::test {

struct StackImages::Pixels {
  cv::Mat rgb;
  cv::Mat lab;
  [[nodiscard]] const cv::Mat& of(const MethodSettings& settings) const {
    return settings.in_lab ? lab : rgb;
  }
};

namespace {

constexpr double kSameCount = 0.05;

std::vector<std::int32_t> labels_in(const cv::Mat& labels) {
  return {labels.begin<std::int32_t>(), labels.end<std::int32_t>()};
}

std::vector<std::int32_t> run_sevds(const MethodSettings& settings,
                                    const MethodSize& size,
                                    const GridStack& stack,
                                    bool cell_weighted) {
  return extract_supercells(stack,
                            {.num_levels = size.edge,
                             .num_bins = settings.bins,
                             .contour_weight = settings.smoothness,
                             .cell_weighted = cell_weighted,
                             .max_passes = settings.passes})
      .value()
      .labels;
}

std::vector<std::int32_t> run_seeds(const MethodSettings& settings,
                                    const MethodSize& size,
                                    const cv::Mat& image) {
  const int across = image.cols / size.edge;
  auto seeds = cv::ximgproc::createSuperpixelSEEDS(image.cols,
                                                   image.rows,
                                                   image.channels(),
                                                   across * across,
                                                   size.num_levels,
                                                   static_cast<int>(settings.smoothness),
                                                   settings.bins,
                                                   settings.flag);
  seeds->iterate(image, settings.passes);
  cv::Mat labels;
  seeds->getLabels(labels);
  return labels_in(labels);
}

std::vector<std::int32_t> run_slic(const MethodSettings& settings,
                                   const MethodSize& size,
                                   const cv::Mat& image,
                                   int algorithm) {
  auto slic = cv::ximgproc::createSuperpixelSLIC(
      image, algorithm, size.edge, static_cast<float>(settings.smoothness));
  slic->iterate(settings.passes);
  slic->enforceLabelConnectivity(size.min_element);
  cv::Mat labels;
  slic->getLabels(labels);
  return labels_in(labels);
}

std::vector<std::int32_t> run_lsc(const MethodSettings& settings,
                                  const MethodSize& size,
                                  const cv::Mat& image) {
  auto lsc =
      cv::ximgproc::createSuperpixelLSC(image, size.edge, static_cast<float>(settings.smoothness));
  lsc->iterate(settings.passes);
  lsc->enforceLabelConnectivity(size.min_element);
  cv::Mat labels;
  lsc->getLabels(labels);
  return labels_in(labels);
}

bool is_ours(Method method) {
  return method <= Method::kCellWeighted;
}

constexpr int kMostTries = 8;

/// The size to begin with.
MethodSize first_size(Method method, int level) {
  if (is_ours(method)) return {.edge = level};
  if (method == Method::kSeeds) return {.edge = 1 << level, .num_levels = std::max(level, 2)};
  return {.edge = 1 << level, .min_element = 25};
}

/// The size to try after one that gave `ratio` times as many segments as there should be: of other
/// regions, or, where only a fraction of a cell is missing, of other small parts.
MethodSize next_size(Method method, const MethodSize& size, double ratio) {
  MethodSize next = size;
  next.edge = std::max(static_cast<int>(std::lround(size.edge * std::sqrt(ratio))), 2);
  if (next.edge != size.edge) return next;
  if (method == Method::kSeeds) {
    next.edge += ratio > 1.0 ? 1 : -1;
  } else {
    next.min_element = ratio > 1.0 ? size.min_element + 15 : size.min_element / 2;
  }
  return next;
}

}  // namespace

std::string_view name_of(Method method) {
  constexpr std::array<std::string_view, 7> kNames{
      "SEVDS", "SEVDS, any K", "cell-weighted", "SEEDS", "SLIC", "SLICO", "LSC"};
  return kNames[static_cast<std::size_t>(method)];
}

std::string text_of(const MethodSettings& settings) {
  std::string text;
  if (settings.bins > 0) text += "bins " + std::to_string(settings.bins) + ", ";
  text += "smoothness " + cv::format("%g", settings.smoothness) + ", passes " +
          std::to_string(settings.passes);
  if (settings.in_lab) text += ", Lab";
  if (settings.flag) text += ", double step";
  return text;
}

std::vector<MethodSettings> settings_to_try(Method method) {
  std::vector<MethodSettings> all;
  const auto add = [&](const std::vector<int>& bins,
                       const std::vector<double>& smoothness,
                       const std::vector<int>& passes) {
    for (const int k : bins) {
      for (const double s : smoothness) {
        for (const int p : passes) all.push_back({.bins = k, .smoothness = s, .passes = p});
      }
    }
  };
  const auto also_with = [&](bool MethodSettings::*flag) {
    const std::vector<MethodSettings> before = all;
    for (MethodSettings settings : before) {
      settings.*flag = true;
      all.push_back(settings);
    }
  };
  switch (method) {
    case Method::kSevds:
      add({16}, {0.0, 1e-4, 1e-3}, {4, 10});
      break;
    case Method::kSevdsAnyBins:
      add({2, 4, 8}, {0.0, 1e-4, 1e-3}, {4, 10});
      break;
    case Method::kCellWeighted:
      add({16, 64, 256}, {0.0, 1e-4, 1e-3}, {4, 10});
      break;
    case Method::kSeeds:
      add({3, 5, 8}, {0.0, 2.0, 3.0}, {4, 10});
      also_with(&MethodSettings::flag);
      break;
    case Method::kSlic:
      add({0}, {10.0, 20.0, 40.0}, {10});
      also_with(&MethodSettings::in_lab);
      break;
    case Method::kSlico:
      add({0}, {10.0}, {10});
      also_with(&MethodSettings::in_lab);
      break;
    case Method::kLsc:
      add({0}, {0.03, 0.05, 0.075}, {10});
      also_with(&MethodSettings::in_lab);
      break;
  }
  return all;
}

StackImages::StackImages(const GridStack& stack) : pixels_(std::make_unique<Pixels>()) {
  pixels_->rgb = cv::Mat(stack.geometry().rows, stack.geometry().cols, CV_8UC3);
  std::size_t channel = 0;
  for (const auto& [name, grid] : stack.layers()) {
    auto* values = pixels_->rgb.ptr<std::uint8_t>();
    for (std::size_t i = 0; i < grid.cells().size(); ++i) {
      const double p = from_steps(grid.cells()[i]).probability().value();
      values[3 * i + channel] = static_cast<std::uint8_t>(std::lround(255.0 * p));
    }
    ++channel;
  }
  cv::cvtColor(pixels_->rgb, pixels_->lab, cv::COLOR_BGR2Lab);
}

StackImages::~StackImages() = default;
StackImages::StackImages(StackImages&&) noexcept = default;

MethodRun run_method(Method method,
                     const MethodSettings& settings,
                     const MethodSize& size,
                     const GridStack& stack,
                     const StackImages& images) {
  const cv::Mat& image = images.pixels().of(settings);
  MethodRun run;
  run.seconds = cpu_time_of([&] {
    switch (method) {
      case Method::kSevds:
      case Method::kSevdsAnyBins:
        run.labels = run_sevds(settings, size, stack, false);
        break;
      case Method::kCellWeighted:
        run.labels = run_sevds(settings, size, stack, true);
        break;
      case Method::kSeeds:
        run.labels = run_seeds(settings, size, image);
        break;
      case Method::kSlic:
        run.labels = run_slic(settings, size, image, cv::ximgproc::SLIC);
        break;
      case Method::kSlico:
        run.labels = run_slic(settings, size, image, cv::ximgproc::SLICO);
        break;
      case Method::kLsc:
        run.labels = run_lsc(settings, size, image);
        break;
    }
  });
  return run;
}

std::optional<MatchedRun> run_matched(Method method,
                                      const MethodSettings& settings,
                                      int level,
                                      const GridStack& stack,
                                      const StackImages& images) {
  const int cols = stack.geometry().cols;
  const int rows = stack.geometry().rows;
  const double wanted = static_cast<double>(cols >> level) * (rows >> level);
  MethodSize size = first_size(method, level);
  for (int i = 0; i < kMostTries; ++i) {
    const MethodRun run = run_method(method, settings, size, stack, images);
    CellSegmentation found = connected_segments(cols, rows, run.labels);
    if (std::abs(found.count - wanted) <= kSameCount * wanted) {
      return MatchedRun{std::move(found), run.seconds};
    }
    if (is_ours(method)) break;
    size = next_size(method, size, found.count / wanted);
  }
  return std::nullopt;
}

}  // namespace hypermap::test
