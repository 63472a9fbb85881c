// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/provenance.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const SourceName kProvenanceSource{.file = "a.hmap", .entry = "provenance.yaml"};

Provenance sample_provenance() {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  isometry.translation() = Eigen::Vector3d(0.1, -2.0 / 3.0, 1e-9);
  Provenance provenance;
  provenance.tool = "hypermap 0.1.0";
  provenance.input = "kitchen";
  provenance.input_hash = "xxh3-128:00";
  provenance.options =
      make_map({{"resolution_m", make_number(0.05)}, {"mode", make_text("exact")}});
  provenance.map_from_input = MapFromInput(isometry);
  return provenance;
}

TEST(Provenance, EveryBitSurvives) {
  const std::vector<Provenance> provenance{sample_provenance()};
  const std::string text = write_provenance(provenance).value();
  const auto again = parse_provenance(text, kProvenanceSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_THAT(again->findings, IsEmpty());
  EXPECT_TRUE(again->value == provenance);
  EXPECT_EQ(write_provenance(again->value).value(), text);
}

TEST(Provenance, UnknownKeysAreFindingsAndSurvive) {
  const std::string text =
      write_provenance(std::vector{sample_provenance()}).value() + "operator: jane\n";
  const auto loaded = parse_provenance(text, kProvenanceSource);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->findings.size(), 1U);
  EXPECT_THAT(write_provenance(loaded->value).value(), HasSubstr("operator: jane"));
}

/// As written before runs had a world, a first frame and runs before them.
constexpr const char* kSingleForm =
    "tool: hypermap 0.1.0\ninput: kitchen\ninput_hash: h\n"
    "map_from_input:\n  - [1, 0, 0, 0]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n";

TEST(Provenance, TheSingleFormIsReadAndWrittenAsItWas) {
  const auto loaded = parse_provenance(kSingleForm, kProvenanceSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, IsEmpty());
  ASSERT_THAT(loaded->value, SizeIs(1));
  EXPECT_EQ(loaded->value[0].input, "kitchen");
  EXPECT_EQ(loaded->value[0].world, "");
  EXPECT_EQ(loaded->value[0].next_frame_index, 0U);
  EXPECT_EQ(write_provenance(loaded->value).value(), kSingleForm);
}

/// Three runs, each told from the others by all that a run has.
std::vector<Provenance> three_runs() {
  std::vector<Provenance> runs;
  for (int i = 0; i < 3; ++i) {
    Provenance run = sample_provenance();
    run.input = "run " + std::to_string(i);
    run.world = i == 1 ? "" : "house " + std::to_string(i);
    run.first_frame_hash = "xxh3-128:" + std::to_string(i);
    run.next_frame_index = std::uint64_t{1'000'000'000'000'000} * static_cast<std::uint64_t>(i + 1);
    run.session = i == 1 ? "" : "Tag " + std::to_string(i);
    run.first_stamp = Stamp{i == 1 ? std::numeric_limits<std::int64_t>::min() : i};
    if (i != 1) run.last_stamp = Stamp{std::numeric_limits<std::int64_t>::max()};
    runs.push_back(std::move(run));
  }
  return runs;
}

TEST(Provenance, AllRunsSurviveOldestFirst) {
  const std::vector<Provenance> runs = three_runs();
  const std::string text = write_provenance(runs).value();
  const auto loaded = parse_provenance(text, kProvenanceSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, IsEmpty());
  EXPECT_TRUE(loaded->value == runs);
  EXPECT_EQ(write_provenance(loaded->value).value(), text);
}

TEST(Provenance, EachKeyOfARunCounts) {
  const Provenance run = three_runs()[0];
  Provenance other = run;
  other.world = "garden";
  EXPECT_FALSE(other == run);
  other = run;
  other.first_frame_hash = "xxh3-128:9";
  EXPECT_FALSE(other == run);
  other = run;
  other.next_frame_index += 1;
  EXPECT_FALSE(other == run);
  other = run;
  other.session = "Tag 9";
  EXPECT_FALSE(other == run);
  other = run;
  other.first_stamp = Stamp{9};
  EXPECT_FALSE(other == run);
  other = run;
  other.last_stamp = std::nullopt;
  EXPECT_FALSE(other == run);
}

TEST(Provenance, ASessionHasANameForPeople) {
  for (const char* name : {"morning", "2026-11-25, hall B", "7b", "K\u00FCche"}) {
    EXPECT_TRUE(check_session_name(name)) << name;
  }
  for (const std::string& name : {std::string(),
                                  std::string("12"),
                                  std::string(" a"),
                                  std::string("a "),
                                  std::string("a\nb"),
                                  std::string("\xff"),
                                  std::string(101, 'a')}) {
    const auto refused = check_session_name(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().field, "session");
    std::vector<Provenance> runs{sample_provenance()};
    runs[0].session = name;
    EXPECT_EQ(write_provenance(runs).has_value(), name.empty()) << name;
  }
}

TEST(Provenance, UnknownKeysOfEarlierRunsSurvive) {
  std::vector<Provenance> runs = three_runs();
  runs[0].extra = make_map({{"operator", make_text("jane")}});
  const auto loaded = parse_provenance(write_provenance(runs).value(), kProvenanceSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_THAT(to_string(loaded->findings[0].error), HasSubstr("earlier[0].operator"));
  EXPECT_TRUE(loaded->value == runs);
}

TEST(Provenance, RunsAreLimitedBothWays) {
  std::vector<Provenance> runs(kMaxRuns, sample_provenance());
  const std::string text = write_provenance(runs).value();
  EXPECT_TRUE(parse_provenance(text, kProvenanceSource));
  runs.push_back(sample_provenance());
  EXPECT_FALSE(write_provenance(runs));
  std::string more = std::string(kSingleForm) + "earlier:\n";
  for (std::size_t i = 0; i < kMaxRuns; ++i) more += "  - {}\n";
  const auto loaded = parse_provenance(more, kProvenanceSource);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::kLimit);
  EXPECT_THAT(to_string(loaded.error()), HasSubstr("earlier: 256 runs are more than the limit"));
}

TEST(Provenance, AnEarlierRunIsReadAsStrictlyAsTheNewest) {
  const auto refused = [](const std::string& more) {
    const auto loaded = parse_provenance(std::string(kSingleForm) + more, kProvenanceSource);
    return loaded ? "" : to_string(loaded.error());
  };
  EXPECT_THAT(refused("earlier: [{tool: t}]\n"), HasSubstr("earlier[0].input: the key is missing"));
  EXPECT_THAT(refused("earlier: 3\n"), HasSubstr("earlier"));
  EXPECT_THAT(refused("next_frame_index: -1\n"), HasSubstr("next_frame_index"));
  EXPECT_THAT(refused("next_frame_index: 4611686018427387905\n"), HasSubstr("next_frame_index"));
  EXPECT_THAT(refused("session: \"12\"\n"), HasSubstr("session"));
  EXPECT_THAT(refused("session: [a]\n"), HasSubstr("session"));
  EXPECT_THAT(refused("first_stamp_ns: 1.5\n"), HasSubstr("first_stamp_ns"));
  EXPECT_THAT(refused("last_stamp_ns: 9223372036854775808\n"), HasSubstr("last_stamp_ns"));
}

TEST(Provenance, AMatrixThatIsNoRigidTransformIsRefusedBothWays) {
  Provenance provenance = sample_provenance();
  Eigen::Isometry3d stretched = Eigen::Isometry3d::Identity();
  stretched.linear() *= 2.0;
  provenance.map_from_input = MapFromInput(stretched);
  EXPECT_FALSE(write_provenance(std::vector{provenance}));
  const auto loaded = parse_provenance(
      "tool: t\ninput: i\ninput_hash: h\nmap_from_input: [[2, 0, 0, 0], [0, 1, 0, 0], "
      "[0, 0, 1, 0], [0, 0, 0, 1]]\n",
      kProvenanceSource);
  ASSERT_FALSE(loaded);
  EXPECT_THAT(to_string(loaded.error()), HasSubstr("map_from_input"));
}

TEST(InputHash, IsThatOfXxh3AndTellsPiecesApart) {
  // xxh3 of nothing is a known constant: XXH3_128bits("") = 99aa06d3014798d8 6001c324468d497f.
  EXPECT_EQ(InputHash().text(), "xxh3-128:99aa06d3014798d86001c324468d497f");
  const auto hash_of = [](std::initializer_list<std::string_view> pieces) {
    InputHash hash;
    for (const std::string_view piece : pieces) hash.add(piece);
    return hash.text();
  };
  EXPECT_EQ(hash_of({"ab", "c"}), hash_of({"ab", "c"}));
  EXPECT_NE(hash_of({"ab", "c"}), hash_of({"a", "bc"}));
  EXPECT_NE(hash_of({}), hash_of({""}));
}

}  // namespace
}  // namespace hypermap
