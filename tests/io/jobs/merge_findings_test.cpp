// SPDX-License-Identifier: BSD-3-Clause
#include "merge_findings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

std::string text_of(const std::optional<Finding>& finding) {
  return finding ? to_string(finding->error) : "none";
}

/// A run of `input` over these seconds.
Provenance run_over(const std::string& input, const std::string& hash, int first_s, int last_s) {
  return {.tool = "hypermap",
          .input = input,
          .input_hash = hash,
          .map_from_input = {},
          .first_stamp = Stamp{first_s * 1'000'000'000LL},
          .last_stamp = Stamp{last_s * 1'000'000'000LL}};
}

TEST(MergeFindings, TheFirstOptionOfAssociationThatDiffersIsNamed) {
  MapOptions options;
  options.mapper.objects.association.radius_m = 0.5;
  options.mapper.objects.association.min_gain = 0.0625;
  Provenance run;
  run.options = make_map({{"octree.resolution_m", make_text("0.3")},
                          {"association.radius_m", make_text("0.50")},
                          {"association.min_gain", make_text("0.125")},
                          {"association.max_existence", make_text("7")},
                          {"association.of_another_version", make_text("1")}});
  EXPECT_EQ(text_of(other_association(std::vector{run}, options)),
            "association.min_gain: was 0.125 when the map was made, is 0.0625 now: objects are "
            "joined by other rules");
  EXPECT_EQ(text_of(other_association(std::vector{run, Provenance{}}, options)), "none");
  EXPECT_EQ(text_of(other_association({}, options)), "none");
}

TEST(MergeFindings, RunsOfOneInputAtOneTimeMayBeOfOneRecording) {
  const std::vector<Provenance> whole{run_over("lab", "a", 0, 9)};
  const auto finding = [&](const Provenance& run) {
    return text_of(shared_recording(std::vector{run}, whole, "whole.hmap"));
  };
  EXPECT_EQ(finding(run_over("lab", "b", 9, 12)),
            "has frames of lab of the time of which whole.hmap has some: of one recording they "
            "count twice");
  EXPECT_EQ(finding(run_over("lab", "b", 10, 12)), "none") << "later";
  EXPECT_EQ(finding(run_over("hall", "b", 0, 9)), "none") << "another robot";
  EXPECT_EQ(finding(run_over("lab", "a", 0, 9)), "none") << "refused elsewhere";
  Provenance timeless = run_over("lab", "b", 0, 9);
  timeless.last_stamp.reset();
  EXPECT_EQ(finding(timeless), "none");
}

}  // namespace
}  // namespace hypermap
