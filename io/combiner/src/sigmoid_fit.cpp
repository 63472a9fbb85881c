// SPDX-License-Identifier: BSD-3-Clause
#include "sigmoid_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

struct Targets {
  double positive = 1.0;
  double negative = 0.0;
};

/// log(1 + exp(x)) without overflow.
double softplus(double x) {
  return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x)));
}

double cross_entropy(std::span<const double> distances,
                     std::span<const bool> are_positive,
                     const Targets& targets,
                     const Sigmoid& sigmoid) {
  double sum = 0.0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double target = are_positive[i] ? targets.positive : targets.negative;
    const double log_odds = sigmoid.slope * distances[i] + sigmoid.offset;
    sum += softplus(log_odds) - target * log_odds;
  }
  return sum;
}

/// Newton's step, the matrix kept regular by a small ridge.
Sigmoid newton_step(std::span<const double> distances,
                    std::span<const bool> are_positive,
                    const Targets& targets,
                    const Sigmoid& sigmoid) {
  constexpr double kRidge = 1e-10;
  double h_ss = kRidge;
  double h_oo = kRidge;
  double h_so = 0.0;
  double g_s = 0.0;
  double g_o = 0.0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double target = are_positive[i] ? targets.positive : targets.negative;
    const double p = 1.0 / (1.0 + std::exp(-(sigmoid.slope * distances[i] + sigmoid.offset)));
    const double curvature = p * (1.0 - p);
    h_ss += curvature * distances[i] * distances[i];
    h_so += curvature * distances[i];
    h_oo += curvature;
    g_s += (p - target) * distances[i];
    g_o += p - target;
  }
  const double determinant = h_ss * h_oo - h_so * h_so;
  return {.slope = -(h_oo * g_s - h_so * g_o) / determinant,
          .offset = -(h_ss * g_o - h_so * g_s) / determinant};
}

}  // namespace

Sigmoid fit_sigmoid(std::span<const double> distances, std::span<const bool> are_positive) {
  constexpr int kMaxSteps = 100;
  constexpr double kSmallestShare = 1e-10;
  constexpr double kSmallestGain = 1e-12;
  const auto num_positive = static_cast<double>(std::ranges::count(are_positive, true));
  const double num_negative = static_cast<double>(are_positive.size()) - num_positive;
  const Targets targets{.positive = (num_positive + 1.0) / (num_positive + 2.0),
                        .negative = 1.0 / (num_negative + 2.0)};
  Sigmoid best{.slope = 0.0, .offset = std::log((num_positive + 1.0) / (num_negative + 1.0))};
  double loss = cross_entropy(distances, are_positive, targets, best);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Sigmoid direction = newton_step(distances, are_positive, targets, best);
    double share = 1.0;
    double gain = 0.0;
    while (share > kSmallestShare) {
      const Sigmoid next{.slope = best.slope + share * direction.slope,
                         .offset = best.offset + share * direction.offset};
      const double next_loss = cross_entropy(distances, are_positive, targets, next);
      if (next_loss < loss) {
        gain = loss - next_loss;
        best = next;
        loss = next_loss;
        break;
      }
      share /= 2.0;
    }
    if (gain <= kSmallestGain * (1.0 + loss)) break;
  }
  return best;
}

}  // namespace hypermap
