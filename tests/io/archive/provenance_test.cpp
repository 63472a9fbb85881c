// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/provenance.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

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
  const Provenance provenance = sample_provenance();
  const std::string text = write_provenance(provenance).value();
  const auto again = parse_provenance(text, kProvenanceSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_THAT(again->findings, IsEmpty());
  EXPECT_TRUE(again->value == provenance);
  EXPECT_EQ(write_provenance(again->value).value(), text);
}

TEST(Provenance, UnknownKeysAreFindingsAndSurvive) {
  const std::string text = write_provenance(sample_provenance()).value() + "operator: jane\n";
  const auto loaded = parse_provenance(text, kProvenanceSource);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->findings.size(), 1U);
  EXPECT_THAT(write_provenance(loaded->value).value(), HasSubstr("operator: jane"));
}

TEST(Provenance, AMatrixThatIsNoRigidTransformIsRefusedBothWays) {
  Provenance provenance = sample_provenance();
  Eigen::Isometry3d stretched = Eigen::Isometry3d::Identity();
  stretched.linear() *= 2.0;
  provenance.map_from_input = MapFromInput(stretched);
  EXPECT_FALSE(write_provenance(provenance));
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
