// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "targets.hpp"

#include <cmath>

namespace hypermap::fuzz {

void fuzz_places(std::string_view bytes) {
  const auto rules = read_place_rules(file_of(bytes, "places.yaml"));
  if (!rules) return;
  const auto classifier = BelongingsClassifier::create(*rules);
  ClassAmounts everything;
  for (const auto& [name, weights] : rules->belongings) everything[name] = 1.0;
  const PlaceBelief belief = require(classifier, "what was read are rules").classify(everything);
  require(belief.size() == rules->places.size(), "each place has its probability");
  double sum = 0.0;
  for (const PlaceProbability& one : belief) sum += one.probability;
  require(std::abs(sum - 1.0) < 1e-9, "they sum to 1");
}

}  // namespace hypermap::fuzz
