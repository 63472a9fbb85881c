// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of a class are right when the surest choose first.
#pragma once

#include "hypermap/core/evaluation/run_rates.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {

/// What a pair costs by a criterion, 0 at best; kForbiddenPair when it must not be made, as when
/// the class of the object is none of the truth's.
[[nodiscard]] double pair_cost(const RatedObject& object,
                               const RatedTruth& truth,
                               MatchCriterion criterion);

/// Indices of objects and of truths that may be paired.
struct MatchSides {
  std::vector<std::size_t> objects;
  std::vector<std::size_t> truths;
};

/// Pairs (object, truth), one to one: as many as possible, then at the least sum of costs.
/// The order of either side changes nothing, but among equal places. Cost: O(n^3); O(m) for one
/// object.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> best_matches(
    const RatedRun& run, const MatchSides& sides, MatchCriterion criterion);

/// What takes part in the ranking of a class.
struct RankedSides {
  std::vector<std::size_t> objects;         ///< Of the class.
  std::vector<std::size_t> guests;          ///< Of other classes that truths of it have as well.
  std::vector<std::size_t> truths;          ///< Counted by the class.
  std::vector<std::size_t> foreign_truths;  ///< Counted by another that have this one as well.
};

/// The ranked predictions of one class, in falling order of confidence; see run_rates. A guest is
/// right or left out; so is an object of the class at a foreign truth, which ranks it as a guest.
/// Requires: confidences of all objects of `sides`.
[[nodiscard]] std::vector<Prediction> ranked_predictions(const RatedRun& run,
                                                         const RankedSides& sides,
                                                         MatchCriterion criterion);

}  // namespace hypermap
