// SPDX-License-Identifier: BSD-3-Clause
#include "registration_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hypermap {
namespace {

/// What is nearer ends where depth goes back by this; of what is farther than that, noise tells.
constexpr float kLeastStepM = 0.15F;
constexpr float kFarthestM = 5.0F;
/// Beside what is nearer the sensor loses up to so many pixels.
constexpr int kMostLostPx = 24;
/// Pixels at the image's edge that are left out.
constexpr int kMarginPx = 8;
/// Edges are not counted beyond this: one bright line shall not decide.
constexpr float kStrongestEdge = 3.0F;
/// So many steps are looked up, evenly chosen, and fewer tell nothing.
constexpr std::size_t kMostSteps = 12000;
constexpr std::size_t kLeastSteps = 1000;
/// Another camera explains the images better by both; registered depth agrees by 0.5 and more.
constexpr double kLeastRatio = 1.5;
constexpr double kLeastGain = 0.25;

/// What is searched, by how much at first, and how often that is halved.
constexpr double kLeastScale = 0.8;
constexpr double kMostScale = 1.26;
constexpr double kScaleStep = 0.02;
constexpr double kMostShiftPx = 24.0;
constexpr double kShiftStepPx = 6.0;
constexpr double kBesideStepPxM = 6.0;
constexpr int kHalvings = 4;
constexpr int kMostRounds = 8;

std::vector<float> brightness(const ColorImage& color) {
  std::vector<float> out;
  out.reserve(color.size());
  for (const Rgb8& c : color.pixels()) {
    out.push_back(0.3F * static_cast<float>(c.r) + 0.6F * static_cast<float>(c.g) +
                  0.1F * static_cast<float>(c.b));
  }
  return out;
}

/// Means over seven values with distance `stride`, along one axis; near the ends as given.
std::vector<float> smoothed(const std::vector<float>& values, std::size_t stride) {
  constexpr std::size_t kReach = 3;
  std::vector<float> out = values;
  for (std::size_t i = kReach * stride; i + kReach * stride < values.size(); ++i) {
    float sum = 0.0F;
    for (std::size_t k = 0; k <= 2 * kReach; ++k) sum += values[i + k * stride - kReach * stride];
    out[i] = sum / static_cast<float>(2 * kReach + 1);
  }
  return out;
}

/// Lengths of gradients, capped, less their mean and in their standard deviations.
std::vector<float> edges_of(const ColorImage& color) {
  const auto width = static_cast<std::size_t>(color.width_px());
  const std::vector<float> light = smoothed(smoothed(brightness(color), 1), width);
  std::vector<float> edges(light.size(), 0.0F);
  for (std::size_t i = width; i + width < light.size(); ++i) {
    edges[i] = std::hypot(light[i + 1] - light[i - 1], light[i + width] - light[i - width]);
  }
  const auto standardise = [&] {
    const auto num = static_cast<float>(edges.size());
    const float mean = std::accumulate(edges.begin(), edges.end(), 0.0F) / num;
    const float squares =
        std::inner_product(edges.begin(), edges.end(), edges.begin(), 0.0F) / num - mean * mean;
    const float deviation = std::sqrt(std::max(squares, 1e-6F));
    for (float& edge : edges) edge = std::min((edge - mean) / deviation, kStrongestEdge);
  };
  standardise();
  standardise();
  return edges;
}

}  // namespace

void RegistrationEstimator::add(const DepthImage& depth_m, const ColorImage& color) {
  const auto fits = [&](const auto& image) {
    return image.width_px() == camera_.width_px && image.height_px() == camera_.height_px;
  };
  if (!fits(depth_m) || !fits(color)) return;
  edges_.push_back(edges_of(color));
  find_steps(depth_m, 1, 0);
  find_steps(depth_m, 0, 1);
}

/// Along rows or columns, from each measured pixel to the next one.
void RegistrationEstimator::find_steps(const DepthImage& depth_m, int du, int dv) {
  const auto is_inside = [&](int u, int v) {
    return u >= kMarginPx && v >= kMarginPx && u < depth_m.width_px() - kMarginPx &&
           v < depth_m.height_px() - kMarginPx;
  };
  const auto is_measured_near = [](float z) { return z > 0.0F && z < kFarthestM; };
  for (int v = kMarginPx; v < depth_m.height_px() - kMarginPx; ++v) {
    for (int u = kMarginPx; u < depth_m.width_px() - kMarginPx; ++u) {
      const float here_m = depth_m.at(u, v);
      if (!is_measured_near(here_m)) continue;
      int next = 1;
      while (next < kMostLostPx && is_inside(u + next * du, v + next * dv) &&
             !is_measured_near(depth_m.at(u + next * du, v + next * dv))) {
        ++next;
      }
      if (!is_inside(u + next * du, v + next * dv)) continue;
      const float there_m = depth_m.at(u + next * du, v + next * dv);
      if (!is_measured_near(there_m) || std::abs(there_m - here_m) < kLeastStepM) continue;
      const int at = here_m < there_m ? 0 : next;
      steps_.push_back({static_cast<std::uint32_t>(edges_.size() - 1),
                        static_cast<float>(u + at * du - camera_.cx_px),
                        static_cast<float>(v + at * dv - camera_.cy_px),
                        std::min(here_m, there_m)});
    }
  }
}

double RegistrationEstimator::agreement(const std::vector<Step>& steps, const Shift& shift) const {
  const auto scale = static_cast<float>(shift.scale);
  const auto beside = static_cast<float>(shift.beside_px_m);
  const auto centre_u = static_cast<float>(camera_.cx_px + shift.right_px + 0.5);
  const auto centre_v = static_cast<float>(camera_.cy_px + shift.down_px + 0.5);
  const auto width = static_cast<float>(camera_.width_px);
  const auto height = static_cast<float>(camera_.height_px);
  double sum = 0.0;
  std::size_t num = 0;
  for (const Step& step : steps) {
    const float u = centre_u + scale * step.u_px + beside / step.depth_m;
    const float v = centre_v + scale * step.v_px;
    if (!(u >= 0.0F && v >= 0.0F && u < width && v < height)) continue;
    const std::size_t pixel =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width_px) +
        static_cast<std::size_t>(u);
    sum += static_cast<double>(edges_[step.frame][pixel]);
    ++num;
  }
  return num >= kLeastSteps / 2 ? sum / static_cast<double>(num) : 0.0;
}

RegistrationEstimator::Shift RegistrationEstimator::plus(const Shift& shift,
                                                         const Shift& move,
                                                         double factor) {
  return {.scale = shift.scale + factor * move.scale,
          .right_px = shift.right_px + factor * move.right_px,
          .down_px = shift.down_px + factor * move.down_px,
          .beside_px_m = shift.beside_px_m + factor * move.beside_px_m};
}

RegistrationEstimator::Shift RegistrationEstimator::coarse_shift(
    const std::vector<Step>& steps) const {
  Shift best;
  double most = agreement(steps, best);
  for (double scale = kLeastScale; scale <= kMostScale; scale += kScaleStep) {
    for (double right = -kMostShiftPx; right <= kMostShiftPx; right += kShiftStepPx) {
      for (double down = -kMostShiftPx; down <= kMostShiftPx; down += kShiftStepPx) {
        const Shift shift{.scale = scale, .right_px = right, .down_px = down};
        const double value = agreement(steps, shift);
        if (value <= most) continue;
        best = shift;
        most = value;
      }
    }
  }
  return best;
}

/// One kind of move after the other, smaller and smaller. To move the camera aside takes its centre
/// along, so that things at the mean depth stay where they are.
RegistrationEstimator::Shift RegistrationEstimator::refined_shift(const std::vector<Step>& steps,
                                                                  Shift shift) const {
  double inverse_depth = 0.0;
  for (const Step& step : steps) inverse_depth += 1.0 / static_cast<double>(step.depth_m);
  inverse_depth /= static_cast<double>(steps.size());
  const std::array<Shift, 4> moves{
      {{.scale = kScaleStep / 2.0},
       {.scale = 0.0, .right_px = kShiftStepPx / 2.0},
       {.scale = 0.0, .down_px = kShiftStepPx / 2.0},
       {.scale = 0.0, .right_px = -kBesideStepPxM * inverse_depth, .beside_px_m = kBesideStepPxM}}};
  double most = agreement(steps, shift);
  const auto try_move = [&](const Shift& move, double factor) {
    const Shift moved = plus(shift, move, factor);
    const double value = agreement(steps, moved);
    if (value <= most) return false;
    shift = moved;
    most = value;
    return true;
  };
  double factor = 1.0;
  for (int halving = 0; halving <= kHalvings; ++halving, factor /= 2.0) {
    bool improves = true;
    for (int round = 0; improves && round < kMostRounds; ++round) {
      improves = false;
      for (const Shift& move : moves) {
        improves = try_move(move, factor) || try_move(move, -factor) || improves;
      }
    }
  }
  return shift;
}

std::optional<RegistrationEstimate> RegistrationEstimator::estimate() const {
  if (steps_.size() < kLeastSteps) return std::nullopt;
  const std::size_t num = std::min(steps_.size(), kMostSteps);
  std::vector<Step> steps;
  steps.reserve(num);
  for (std::size_t i = 0; i < num; ++i) steps.push_back(steps_[i * steps_.size() / num]);
  const Shift shift = refined_shift(steps, coarse_shift(steps));
  RegistrationEstimate out;
  out.agreement_as_is = agreement(steps, Shift{});
  out.agreement = agreement(steps, shift);
  out.color_camera = camera_;
  out.color_camera.fx_px *= shift.scale;
  out.color_camera.fy_px *= shift.scale;
  out.color_camera.cx_px += shift.right_px;
  out.color_camera.cy_px += shift.down_px;
  out.color_from_depth.translation().x() = shift.beside_px_m / out.color_camera.fx_px;
  const bool is_better = out.agreement >= kLeastRatio * out.agreement_as_is &&
                         out.agreement >= out.agreement_as_is + kLeastGain;
  return is_better ? std::optional(out) : std::nullopt;
}

}  // namespace hypermap
