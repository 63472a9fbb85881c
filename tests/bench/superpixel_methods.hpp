// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Supercells beside the superpixel methods that [sogm] compares them with, all asked alike: by how
/// many segments there should be.
///
/// Source: [sogm] IV. Theirs are those of OpenCV's ximgproc.
#pragma once

#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/supercells/segmentation_metrics.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::test {

enum class Method : std::uint8_t {
  kSevds,         ///< As printed, with K = 16.
  kSevdsAnyBins,  ///< As printed, with the K that is best.
  kCellWeighted,  ///< Ours.
  kSeeds,
  kSlic,
  kSlico,
  kLsc
};

inline constexpr Method kMethods[] = {Method::kSevds,
                                      Method::kSevdsAnyBins,
                                      Method::kCellWeighted,
                                      Method::kSeeds,
                                      Method::kSlic,
                                      Method::kSlico,
                                      Method::kLsc};
[[nodiscard]] std::string_view name_of(Method method);

/// What can be set of a method beside the number of segments; each uses what it has.
struct MethodSettings {
  int bins = 0;             ///< Of histograms: SEVDS, SEEDS.
  double smoothness = 0.0;  ///< gamma of SEVDS, prior of SEEDS, ruler of SLIC, ratio of LSC.
  int passes = 0;           ///< Most passes, or iterations.
  bool in_lab = false;      ///< Layers taken for RGB and turned into Lab; not of SEVDS.
  bool flag = false;        ///< Of SEEDS: double_step.
};
[[nodiscard]] std::string text_of(const MethodSettings& settings);

/// Those that are tried when a method's parameters are optimised.
[[nodiscard]] std::vector<MethodSettings> settings_to_try(Method method);

/// A stack of three layers as an image for methods that want one.
class StackImages {
 public:
  explicit StackImages(const GridStack& stack);
  ~StackImages();
  StackImages(StackImages&&) noexcept;
  StackImages& operator=(StackImages&&) = delete;
  StackImages(const StackImages&) = delete;
  StackImages& operator=(const StackImages&) = delete;

  struct Pixels;
  [[nodiscard]] const Pixels& pixels() const noexcept { return *pixels_; }

 private:
  std::unique_ptr<Pixels> pixels_;
};

/// The size at which a method makes about so many segments.
struct MethodSize {
  int edge = 0;         ///< Of a region; 2^edge for SEVDS.
  int min_element = 0;  ///< Per cent of a region below which a part is given to a neighbour.
  int num_levels = 0;   ///< Of SEEDS.
};

/// Labels as the method gives them.
struct MethodRun {
  std::vector<std::int32_t> labels;
  double seconds = 0.0;  ///< Of processor time, from image to labels.
};

[[nodiscard]] MethodRun run_method(Method method,
                                   const MethodSettings& settings,
                                   const MethodSize& size,
                                   const GridStack& stack,
                                   const StackImages& images);

/// What a method makes when it shall make as many connected segments as SEVDS of 2^level, within 5
/// per cent.
struct MatchedRun {
  CellSegmentation segmentation;
  double seconds = 0.0;  ///< Of the run that matched.
};
/// None when no size gives as many.
[[nodiscard]] std::optional<MatchedRun> run_matched(Method method,
                                                    const MethodSettings& settings,
                                                    int level,
                                                    const GridStack& stack,
                                                    const StackImages& images);

}  // namespace hypermap::test
