// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which class an object or voxel is, as evidence accumulates over frames and detectors.
///
/// Source: [smap] L. Frota Fernandes, "SMAP", MSc dissertation, Univ. Coimbra, 2023, section 3.5.3.
/// Erratum: the text uses a prior of 0.5 (table D.2 prints 1). With N classes a detector that knows
/// nothing says 1/N for each, which under 0.5 drives every class down; the prior here is 1/N.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What happens to a class whose log-odds would pass the upper bound.
enum class Saturation {
  /// Each class stops at the bound. Source: [smap] 3.5.3. A class that is often a little likely
  /// (the sofa of a chair: 0.15 where 1/80 is nothing) reaches the bound too, and ties.
  kClamp,
  /// All classes are lowered by the excess of the best, so that their differences stay.
  kShift,
};

/// How the probability of a class is read from what was observed; see class_distribution(Object).
enum class ClassTempering {
  /// From the sum of the log-odds: each observation is independent. Source: [smap] Eq. (3.18).
  kNone,
  /// From how often each class was named in each view. Ours: frames of one view err alike.
  kViews,
};

struct ClassBeliefOptions {
  /// Evidence saturates here, so a wrong belief can still be overturned.
  LogOdds max_log_odds{10.0};
  /// Lower bound.
  LogOdds min_log_odds{-10.0};
  /// Deviation: the sources clamp; test ASimilarClassNeverCatchesUpWhenTheBeliefShifts.
  Saturation saturation = Saturation::kShift;
  /// Deviation: the sources read the sum.
  ClassTempering tempering = ClassTempering::kViews;

  friend bool operator==(const ClassBeliefOptions&, const ClassBeliefOptions&) = default;
};

/// Errors: kInvalidArgument when min_log_odds >= max_log_odds or one is not finite.
[[nodiscard]] Result<void> validate(const ClassBeliefOptions& options);
[[nodiscard]] const OptionTable& option_table(const ClassBeliefOptions& options);

/// One class and the belief in it.
struct ClassLogOdds {
  ClassId id;
  LogOdds log_odds;
  friend bool operator==(const ClassLogOdds&, const ClassLogOdds&) = default;
};

/// Accumulated belief over an open set of classes.
///
/// A value: copy it, compare it, keep it in a vector. Classes may appear at any time; a class
/// never mentioned has l = 0. Memory: O(classes seen), not O(known).
class ClassBelief {
 public:
  ClassBelief() = default;  ///< Nothing observed, default options.

  /// Errors: as validate(options).
  [[nodiscard]] static Result<ClassBelief> create(const ClassBeliefOptions& options);

  /// Restores a stored belief. Errors: as validate(options); kInvalidArgument when `entries` are
  /// not in ascending order of distinct ids or one is not within the bounds.
  [[nodiscard]] static Result<ClassBelief> from_entries(const ClassBeliefOptions& options,
                                                        std::vector<ClassLogOdds> entries);

  /// Adds one independent observation: l += scale (logit(p) - logit(prior)), then saturates.
  ///
  /// Source: [smap] Eq. (3.18) in log-odds; with `prior` = 0.5 it is Eq. (3.19). `prior` is 1/N,
  /// N = classes of the combined set now; older evidence is never rescaled.
  /// `scale` in [0, 1] weakens an observation made under partial occlusion (section 3.5.5).
  /// Boundary: logit(p) is held within the bounds, so that p = 1 cannot write infinity.
  /// Requires: prior in (0, 1). Cost: O(entries + evidence log evidence).
  void observe(std::span<const ClassEvidence> evidence, Probability prior, double scale = 1.0);

  /// Lowers every class by `decay` (an absence says nothing about which class it was).
  /// Source: [smap] figure 3.23, step 8. Requires: decay >= 0.
  void weaken(LogOdds decay);

  /// Adds the evidence of another belief about the same object, times `scale` in [0, 1].
  void merge(const ClassBelief& other, double scale = 1.0);

  /// Belief that the object is of class `id`; l = 0 if the class was never observed.
  [[nodiscard]] LogOdds log_odds(ClassId id) const;
  /// The most believed class; the lowest id of equals. None when nothing was observed.
  [[nodiscard]] std::optional<ClassLogOdds> best() const;
  /// The belief as one distribution over the classes seen: p_c proportional to e^l_c, sums to 1.
  [[nodiscard]] std::vector<ClassEvidence> distribution() const;

  /// In ascending order of ids.
  [[nodiscard]] std::span<const ClassLogOdds> entries() const noexcept { return entries_; }
  [[nodiscard]] const ClassBeliefOptions& options() const noexcept { return options_; }
  friend bool operator==(const ClassBelief&, const ClassBelief&) = default;

 private:
  /// The belief in `id`, which starts at 0.
  LogOdds& entry(ClassId id);
  void saturate();

  ClassBeliefOptions options_;
  std::vector<ClassLogOdds> entries_;
};

}  // namespace hypermap
