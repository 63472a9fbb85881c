// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulated_detector.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "simulated_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kDetectionStream = 0x646574656374;  // which numbers: "detect"
constexpr std::uint64_t kFalseAlarmStream = 0x616c61726d;   // "alarm"
constexpr double kSmallestSidePx = 2.0;
constexpr double kMaskShiftBlocks = 0.5;  // standard deviation in each direction
constexpr double kSmallestAlarmPx = 20.0;

/// Classes that detectors take for each other. Pairs that a detector does not know are ignored.
constexpr std::array<std::array<std::string_view, 2>, 5> kSimilar{{{"chair", "sofa"},
                                                                   {"cup", "bottle"},
                                                                   {"tvmonitor", "laptop"},
                                                                   {"diningtable", "desk"},
                                                                   {"table", "desk"}}};

/// A number of events with the given mean: Poisson, by inversion of its distribution.
int poisson(double mean, CounterRng& random) {
  const double u = random.uniform();
  double probability = std::exp(-mean);
  double sum = probability;
  int count = 0;
  while (u > sum && count < 1000) {
    ++count;
    probability *= mean / count;
    sum += probability;
  }
  return count;
}

/// Sorted, inside 0 .. limit and not thinner than two pixels.
std::array<double, 2> clipped_to_image(double low, double high, double limit) {
  if (low > high) std::swap(low, high);
  low = std::clamp(low, 0.0, limit);
  high = std::clamp(high, 0.0, limit);
  if (high - low >= kSmallestSidePx) return {low, high};
  low = std::clamp(0.5 * (low + high - kSmallestSidePx), 0.0, limit - kSmallestSidePx);
  return {low, low + kSmallestSidePx};
}

PixelBox clipped_to_image(const PixelBox& box, double width_px, double height_px) {
  const auto [left, right] = clipped_to_image(box.u_min_px, box.u_max_px, width_px);
  const auto [top, bottom] = clipped_to_image(box.v_min_px, box.v_max_px, height_px);
  return {left, top, right, bottom};
}

PixelBox jittered(const PixelBox& box, double share, CounterRng& random) {
  const double du = share * box.width_px();
  const double dv = share * box.height_px();
  return {box.u_min_px + du * random.normal(),
          box.v_min_px + dv * random.normal(),
          box.u_max_px + du * random.normal(),
          box.v_max_px + dv * random.normal()};
}

/// A box anywhere in the image, its sides between 20 pixels and half of the image's.
PixelBox random_box(double width_px, double height_px, CounterRng& random) {
  const auto side = [&](double limit) {
    const double largest = std::max(kSmallestAlarmPx, 0.5 * limit);
    return kSmallestAlarmPx * std::pow(largest / kSmallestAlarmPx, random.uniform());
  };
  const double half_width = 0.5 * side(width_px);
  const double half_height = 0.5 * side(height_px);
  const double u = random.uniform(0.0, width_px);
  const double v = random.uniform(0.0, height_px);
  return {u - half_width, v - half_height, u + half_width, v + half_height};
}

MaskError random_mask_error(int width_px, int height_px, CounterRng& random) {
  const double block_px = std::max(1.0, mask_cell_px(width_px, height_px));
  const auto shift_px = [&] {
    return static_cast<int>(std::lround(kMaskShiftBlocks * block_px * random.normal()));
  };
  const int du_px = shift_px();
  return {.block_px = static_cast<int>(std::lround(block_px)), .du_px = du_px, .dv_px = shift_px()};
}

}  // namespace

SimulatedDetectorOptions worse_detector(SimulatedDetectorOptions usual) {
  constexpr double kFurtherMissed = 0.35;
  usual.miss_rate += kFurtherMissed * (1.0 - usual.miss_rate);
  usual.false_alarms_per_frame += 1.0;
  usual.box_jitter = 0.08;
  return usual;
}

std::vector<VisibleObject> visible_objects(const Image<ObjectId>& instances,
                                           std::span<const std::string_view> class_names) {
  std::vector<VisibleObject> all(class_names.size());
  for (int v = 0; v < instances.height_px(); ++v) {
    for (int u = 0; u < instances.width_px(); ++u) {
      const ObjectId id = instances.at(u, v);
      if (id == kNoObject) continue;
      VisibleObject& object = all[id.value - 1];
      PixelBox& box = object.box_px;
      if (object.visible_px++ == 0) box = {u + 0.0, v + 0.0, u + 1.0, v + 1.0};
      box.u_min_px = std::min(box.u_min_px, u + 0.0);
      box.u_max_px = std::max(box.u_max_px, u + 1.0);
      box.v_max_px = v + 1.0;  // rows come from above
      object.id = id;
      object.class_name = class_names[id.value - 1];
    }
  }
  std::erase_if(all, [](const VisibleObject& object) { return object.visible_px == 0; });
  return all;
}

Result<SimulatedDetector> SimulatedDetector::create(const SimulatedDetectorOptions& options,
                                                    ClassRegistry& registry,
                                                    std::uint64_t seed) {
  HYPERMAP_TRY(validate(options));
  SimulatedDetector detector;
  detector.options_ = options;
  detector.seed_ = seed;
  for (const std::string& name :
       options.class_names.empty() ? coco_class_names() : options.class_names) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, registry.add(name));
    if (std::ranges::find(detector.known_, id, &Known::id) == detector.known_.end())
      detector.known_.push_back({id, canonical_class_name(name), {}});
  }
  std::ranges::sort(detector.known_, {}, &Known::id);
  for (const auto& [one, other] : kSimilar) {
    const auto a = detector.position_of(one);
    const auto b = detector.position_of(other);
    if (!a || !b) continue;
    detector.known_[*a].similar.push_back(*b);
    detector.known_[*b].similar.push_back(*a);
  }
  return detector;
}

std::optional<std::size_t> SimulatedDetector::position_of(std::string_view class_name) const {
  const auto found = std::ranges::find(known_, canonical_class_name(class_name), &Known::canonical);
  if (found == known_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - known_.begin());
}

bool SimulatedDetector::knows_class(std::string_view class_name) const {
  return position_of(class_name).has_value();
}

bool SimulatedDetector::is_visible(const VisibleObject& object) const {
  return object.visible_px >= options_.min_visible_px &&
         object.unhidden_share >= options_.min_unhidden_share;
}

std::vector<ClassEvidence> SimulatedDetector::class_vector(std::size_t named, double weight) const {
  const std::vector<std::size_t>& similar = known_[named].similar;
  const double to_similar =
      options_.noisy && !similar.empty() ? options_.similar_weight * weight : 0.0;
  const std::size_t num_others = known_.size() - 1 - (to_similar > 0.0 ? similar.size() : 0);
  const double rest = num_others == 0 ? 0.0 : (1.0 - weight) / static_cast<double>(num_others);
  std::vector<double> shares(known_.size(), rest);
  shares[named] = num_others == 0 ? 1.0 - to_similar : weight - to_similar;
  for (const std::size_t other : similar) {
    if (to_similar > 0.0) shares[other] = to_similar / static_cast<double>(similar.size());
  }
  std::vector<ClassEvidence> scores;
  for (std::size_t i = 0; i < known_.size(); ++i)
    scores.push_back({known_[i].id, Probability(std::clamp(shares[i], 0.0, 1.0))});
  return scores;
}

std::optional<Detection> SimulatedDetector::detect_one(const VisibleObject& object,
                                                       const Image<ObjectId>& instances,
                                                       std::uint64_t frame) const {
  const auto truth = position_of(object.class_name);
  if (!truth || !is_visible(object)) return std::nullopt;
  CounterRng random(seed_, kDetectionStream, frame, object.id.value);
  Detection detection;
  detection.box_px = object.box_px;
  std::size_t named = *truth;
  double weight = options_.perfect_probability;
  if (options_.noisy) {
    if (random.chance(options_.miss_rate)) return std::nullopt;
    weight = random.uniform(options_.min_score, options_.max_score);
    if (random.chance(options_.wrong_class_rate)) named = wrong_class(*truth, random);
    detection.box_px = clipped_to_image(jittered(object.box_px, options_.box_jitter, random),
                                        instances.width_px(),
                                        instances.height_px());
  }
  detection.score = Probability(weight);
  detection.class_scores = class_vector(named, weight);
  if (options_.masks) {
    detection.mask =
        options_.noisy
            ? network_mask(instances,
                           object.id,
                           detection.box_px,
                           random_mask_error(instances.width_px(), instances.height_px(), random))
            : exact_mask(instances, object.id);
    if (bounds_of(*detection.mask).empty()) detection.mask.reset();
  }
  return detection;
}

bool SimulatedDetector::names_rightly(const Detection& detection,
                                      const VisibleObject& object) const {
  const auto best = best_class(detection.class_scores);
  return best && best->id == known_[*position_of(object.class_name)].id;
}

std::size_t SimulatedDetector::wrong_class(std::size_t truth, CounterRng& random) const {
  const std::vector<std::size_t>& similar = known_[truth].similar;
  if (!similar.empty()) return similar[random.below(static_cast<std::uint32_t>(similar.size()))];
  if (known_.size() == 1) return truth;
  const std::size_t other = random.below(static_cast<std::uint32_t>(known_.size() - 1));
  return other < truth ? other : other + 1;
}

Detection SimulatedDetector::false_alarm(const Image<ObjectId>& instances,
                                         CounterRng& random) const {
  const double width_px = instances.width_px();
  const double height_px = instances.height_px();
  const double weight = random.uniform(options_.min_score, options_.max_score);
  Detection detection;
  detection.box_px = clipped_to_image(random_box(width_px, height_px, random), width_px, height_px);
  detection.class_scores =
      class_vector(random.below(static_cast<std::uint32_t>(known_.size())), weight);
  detection.score = Probability(weight);
  return detection;
}

SimulatedDetections SimulatedDetector::detect(std::span<const VisibleObject> objects,
                                              const Image<ObjectId>& instances,
                                              std::uint64_t frame) const {
  SimulatedDetections said;
  for (const VisibleObject& object : objects) {
    auto detection = detect_one(object, instances, frame);
    if (!detection) continue;
    if (names_rightly(*detection, object)) said.named_rightly.push_back(object.id);
    said.detections.push_back(*std::move(detection));
  }
  if (!options_.noisy) return said;
  CounterRng random(seed_, kFalseAlarmStream, frame);
  const int num_false_alarms = poisson(options_.false_alarms_per_frame, random);
  for (int i = 0; i < num_false_alarms; ++i)
    said.detections.push_back(false_alarm(instances, random));
  return said;
}

}  // namespace hypermap
