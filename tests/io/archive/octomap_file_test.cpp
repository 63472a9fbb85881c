// SPDX-License-Identifier: BSD-3-Clause
// Long because: each kind of tree, and each fault of the format, is a file in bytes.
#include "hypermap/io/archive/octomap_file.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const SourceName kOctomapSource{.file = "map"};

std::string header(const std::string& id, std::size_t size, const std::string& res = "0.05") {
  return "# Octomap OcTree file\nid " + id + "\nsize " + std::to_string(size) + "\nres " + res +
         "\ndata\n";
}

template <class T>
std::string raw(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

std::string node(float log_odds, unsigned children) {
  return raw(log_odds) + raw(static_cast<std::uint8_t>(children));
}

std::string octomap_error(const std::string& bytes, const SourceName& source = kOctomapSource) {
  const auto tree = parse_octomap(bytes, source);
  return tree ? "no error" : to_string(tree.error());
}

/// OctoMap's leaves as ours. Its iterators go in Morton order too.
template <class Tree>
std::vector<OctomapLeaf> leaves_of(const Tree& tree) {
  std::vector<OctomapLeaf> leaves;
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    const auto depth = static_cast<std::uint8_t>(it.getDepth());
    const octomap::OcTreeKey key = it.getIndexKey();
    leaves.push_back(
        {.key = {key[0], key[1], key[2]}, .depth = depth, .log_odds = it->getLogOdds()});
  }
  return leaves;
}

/// A tree of ours with leaves of random sizes, made by splitting cubes.
OctomapTree random_tree(unsigned seed, OctomapKind kind) {
  std::mt19937 engine(seed);
  OctomapTree tree{.kind = kind, .resolution_m = 0.1};
  std::vector<std::pair<std::uint64_t, int>> cubes{{0, 0}};
  while (!cubes.empty()) {
    const auto [code, depth] = cubes.back();
    cubes.pop_back();
    const bool split = depth < 16 && (depth < 2 || engine() % 8 < 3) && tree.leaves.size() < 500;
    if (split) {
      const std::uint64_t stride = std::uint64_t{1} << (3 * (15 - depth));
      for (std::uint64_t i = 8; i-- > 0;)
        if (engine() % 4 != 0 || i == 0) cubes.emplace_back(code + i * stride, depth + 1);
      continue;
    }
    OctomapLeaf leaf{
        .key = VoxelKey::from_morton(code),
        .depth = static_cast<std::uint8_t>(depth),
        .log_odds = static_cast<float>(
            from_milli(static_cast<MilliLogOdds>(static_cast<int>(engine() % 5511) - 2000))
                .value())};
    if (kind == OctomapKind::kSemantic && engine() % 2 == 0) {
      leaf.label = static_cast<std::uint32_t>(tree.labels.size());
      VoxelLabel label;
      label.object_votes = 1;
      label.object = ObjectId{static_cast<std::uint32_t>(1 + engine() % 9)};
      label.classes[0] = {.class_id = static_cast<std::uint16_t>(engine() % 80), .log_odds = 1234};
      tree.labels.push_back(label);
    }
    if (kind == OctomapKind::kColor)
      tree.colors.push_back({.r = static_cast<std::uint8_t>(engine() & 0xff), .g = 7, .b = 9});
    tree.leaves.push_back(leaf);
  }
  return tree;
}

std::unique_ptr<octomap::AbstractOcTree> read_by_octomap(const std::string& bytes) {
  std::istringstream stream(bytes);
  return std::unique_ptr<octomap::AbstractOcTree>(octomap::AbstractOcTree::read(stream));
}

TEST(OctomapFile, ReadsAHandMadeTree) {
  // Root with child 1 (upper x), a leaf: depth 1, keys from x = 32768.
  const auto tree =
      parse_octomap(header("OcTree", 2) + node(0.85F, 0b10) + node(0.85F, 0), kOctomapSource);
  ASSERT_TRUE(tree) << to_string(tree.error());
  EXPECT_THAT(tree->findings, IsEmpty());
  EXPECT_EQ(tree->value.resolution_m, 0.05);
  ASSERT_EQ(tree->value.leaves.size(), 1U);
  EXPECT_EQ(tree->value.leaves[0],
            (OctomapLeaf{.key = {32768, 0, 0}, .depth = 1, .log_odds = 0.85F}));
}

TEST(OctomapFile, AnEmptyTreeAndARootAloneAreRead) {
  const auto empty = parse_octomap(header("OcTree", 0), kOctomapSource);
  ASSERT_TRUE(empty);
  EXPECT_THAT(empty->value.leaves, IsEmpty());
  const auto root = parse_octomap(header("OcTree", 1) + node(1.0F, 0), kOctomapSource);
  ASSERT_TRUE(root);
  ASSERT_EQ(root->value.leaves.size(), 1U);
  EXPECT_EQ(root->value.leaves[0].depth, 0);
}

TEST(OctomapFile, TheBitsOfABinaryNodeAreThoseOfOctomap) {
  // Children 0 free (01), 1 occupied (10), others unknown: 0b1001.
  const std::string bytes =
      "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n" + std::string("\x09\0", 2);
  const auto tree = parse_octomap(bytes, kOctomapSource);
  ASSERT_TRUE(tree) << to_string(tree.error());
  ASSERT_EQ(tree->value.leaves.size(), 2U);
  EXPECT_LT(tree->value.leaves[0].log_odds, 0.0F);
  EXPECT_GT(tree->value.leaves[1].log_odds, 0.0F);
}

/// A file of ours as one without the line of its checksum.
std::string without_checksum(std::string file) {
  const std::size_t start = file.find("# crc32 ");
  return file.erase(start, file.find('\n', start) + 1 - start);
}

TEST(OctomapFile, ACutAnywhereIsAnErrorThatNamesTheNode) {
  const std::string checked = write_octomap(random_tree(1, OctomapKind::kOccupancy)).value();
  const std::string unchecked = without_checksum(checked);
  ASSERT_TRUE(parse_octomap(unchecked, kOctomapSource));
  for (const std::string& bytes : {checked, unchecked})
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_FALSE(parse_octomap(bytes.substr(0, length), kOctomapSource)) << length;
  EXPECT_THAT(octomap_error(header("OcTree", 2) + node(1.0F, 1) + "ab"),
              HasSubstr("octree: unexpected end of data at node 1"));
}

TEST(OctomapFile, AFlippedBitNeverCrashesAndNeverGivesInvalidLeaves) {
  for (const OctomapKind kind :
       {OctomapKind::kOccupancy, OctomapKind::kColor, OctomapKind::kSemantic}) {
    const std::string bytes = without_checksum(write_octomap(random_tree(2, kind)).value());
    for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 29) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << (bit % 8));
      const auto tree = parse_octomap(flipped, kOctomapSource);
      if (tree) {
        EXPECT_TRUE(validate(tree->value)) << bit;
      }
    }
  }
}

TEST(OctomapFile, NoBitOfAFileOfOursChangesUnnoticed) {
  const OctomapTree tree = random_tree(3, OctomapKind::kOccupancy);
  for (const std::string& bytes :
       {write_octomap(tree).value(), write_octomap_binary(tree).value()}) {
    const std::size_t word = bytes.find("crc32");
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      // Without this word the line is any comment; the tree is what it was.
      if (bit / 8 >= word && bit / 8 < word + 5) continue;
      std::string changed = bytes;
      changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ 1 << (bit % 8));
      EXPECT_FALSE(parse_octomap(changed, kOctomapSource)) << bit;
    }
  }
}

TEST(OctomapFile, AChecksumIsThatOfAllOtherBytes) {
  // CRC-32 of "# Octomap OcTree file\nid OcTree\nsize 0\nres 0.05\ndata\n", by Python's zlib.
  const std::string keys = "id OcTree\nsize 0\nres 0.05\ndata\n";
  const std::string first = "# Octomap OcTree file\n";
  EXPECT_EQ(octomap_error(first + "# crc32 2171fade\n" + keys), "no error");
  EXPECT_THAT(octomap_error(first + "# crc32 00000000\n" + keys),
              HasSubstr("map: crc32: is '# crc32 00000000', that of the file is 2171fade"));
  EXPECT_THAT(octomap_error(first + "# crc32 2171fade\n# crc32 2171fade\n" + keys),
              HasSubstr("crc32: is given twice"));
}

TEST(OctomapFile, BytesAfterTheTreeAndWrongSizesAreErrors) {
  const std::string nodes = node(1.0F, 1) + node(1.0F, 0);
  EXPECT_THAT(octomap_error(header("OcTree", 2) + nodes + "x"), HasSubstr("1 bytes follow"));
  EXPECT_THAT(octomap_error(header("OcTree", 1) + nodes), HasSubstr("size: says 1 nodes"));
  EXPECT_THAT(octomap_error(header("OcTree", 3) + nodes),
              HasSubstr("size: says 3 nodes, the tree has 2"));
  EXPECT_THAT(octomap_error(header("OcTree", 0) + nodes), HasSubstr("size: is 0, yet data follow"));
  EXPECT_THAT(octomap_error(header("OcTree", std::size_t{1} << 40) + nodes),
              HasSubstr("the limit is"));
}

TEST(OctomapFile, ATreeDeeperThanSixteenIsAnError) {
  std::string nodes;
  for (int depth = 0; depth <= 16; ++depth) nodes += node(1.0F, 0xff);
  EXPECT_THAT(octomap_error(header("OcTree", 100) + nodes), HasSubstr("tree deeper than 16"));
  std::string codes(std::size_t{2000}, '\xff');
  EXPECT_THAT(
      octomap_error("# Octomap OcTree binary file\nid OcTree\nsize 99999\nres 0.1\ndata\n" + codes),
      HasSubstr("tree deeper than 16"));
}

TEST(OctomapFile, HeaderFieldsAreJudgedByName) {
  const std::string data = node(1.0F, 0);
  for (const char* res :
       {"0", "-0.05", "nan", "inf", "1e300", "1e-310", "0,05", "text", "", "0x1p-4"})
    EXPECT_THAT(octomap_error(header("OcTree", 1, res) + data), HasSubstr("res: ")) << res;
  EXPECT_THAT(octomap_error("# Octomap OcTree file\nsize 1\nres 1\ndata\n" + data),
              HasSubstr("id: is missing"));
  EXPECT_THAT(octomap_error("# Octomap OcTree file\nid OcTree\nres 1\ndata\n" + data),
              HasSubstr("size: is missing"));
  EXPECT_THAT(octomap_error(header("CountingOcTree", 1) + data),
              HasSubstr("id: is 'CountingOcTree'"));
  EXPECT_THAT(octomap_error(header(std::string(50000, 'x'), 1) + data),
              HasSubstr("id: has 50000 bytes"));
  EXPECT_THAT(octomap_error("# Octomap OcTree file\r\nid OcTree\r\n"), HasSubstr("CRLF"));
  EXPECT_THAT(octomap_error("# Octomap OcTree file\n" + std::string(1 << 20, '#')),
              HasSubstr("no line 'data'"));
  EXPECT_THAT(octomap_error("P5 2 2 255"), HasSubstr("not an OctoMap file"));
}

TEST(OctomapFile, UnknownHeaderKeysAreFindings) {
  const auto tree =
      parse_octomap("# Octomap OcTree file\n# note\nid OcTree\nframe odom\nsize 0\nres 0.1\ndata\n",
                    kOctomapSource);
  ASSERT_TRUE(tree);
  ASSERT_EQ(tree->findings.size(), 1U);
  EXPECT_THAT(tree->findings[0].error.what, HasSubstr("'frame'"));
  EXPECT_EQ(tree->findings[0].error.file, "map");
}

TEST(OctomapFile, LogOddsMustBeFiniteAndWithinSixteenBits) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 1e30F, -33.0F})
    EXPECT_THAT(octomap_error(header("OcTree", 2) + node(1.0F, 1) + node(bad, 0)),
                HasSubstr("at node 1"));
}

TEST(OctomapFile, StaleInnerNodesAreComputedAnewAndCounted) {
  const auto tree = parse_octomap(
      header("OcTree", 3) + node(0.1F, 1) + node(2.0F, 1) + node(-1.0F, 0), kOctomapSource);
  ASSERT_TRUE(tree);
  ASSERT_EQ(tree->findings.size(), 1U);
  EXPECT_THAT(tree->findings[0].error.what, HasSubstr("2 inner nodes disagree"));
}

TEST(OctomapFile, TheNameMustAgreeWithTheContent) {
  const std::string bytes = header("OcTree", 1) + node(1.0F, 0);
  EXPECT_THAT(octomap_error(bytes, {.file = "map.bt"}), HasSubstr("an .ot file named .bt"));
  EXPECT_THAT(octomap_error(bytes, {.file = "a.hmap", .entry = "octree.bt"}),
              HasSubstr("named .bt"));
  EXPECT_EQ(octomap_error(bytes, {.file = "map.ot"}), "no error");
}

TEST(OctomapFile, WhatIsWrittenIsReadBackExactly) {
  for (const OctomapKind kind :
       {OctomapKind::kOccupancy, OctomapKind::kColor, OctomapKind::kSemantic})
    for (unsigned seed = 0; seed < 20; ++seed) {
      const OctomapTree tree = random_tree(seed, kind);
      const auto bytes = write_octomap(tree);
      ASSERT_TRUE(bytes) << to_string(bytes.error());
      const auto again = parse_octomap(*bytes, kOctomapSource);
      ASSERT_TRUE(again) << to_string(again.error());
      EXPECT_THAT(again->findings, IsEmpty());
      EXPECT_EQ(again->value, tree);
    }
}

TEST(OctomapFile, EveryStepOfOurLogOddsSurvivesTheFloat) {
  for (int milli = -32767; milli <= 32767; ++milli) {
    const auto step = static_cast<MilliLogOdds>(milli);
    const auto stored = static_cast<float>(from_milli(step).value());
    ASSERT_EQ(to_milli(LogOdds(static_cast<double>(stored))), step);
  }
}

TEST(OctomapFile, OctomapReadsTheSameLeavesFromWhatWeWrite) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const OctomapTree plain = random_tree(seed, OctomapKind::kOccupancy);
    const auto tree = read_by_octomap(write_octomap(plain).value());
    const auto* octree = dynamic_cast<octomap::OcTree*>(tree.get());
    ASSERT_NE(octree, nullptr);
    EXPECT_EQ(leaves_of(*octree), plain.leaves);

    const OctomapTree colored = random_tree(seed, OctomapKind::kColor);
    const auto color_tree = read_by_octomap(write_octomap(colored).value());
    auto* color_octree = dynamic_cast<octomap::ColorOcTree*>(color_tree.get());
    ASSERT_NE(color_octree, nullptr);
    EXPECT_EQ(leaves_of(*color_octree), colored.leaves);
  }
}

TEST(OctomapFile, InnerNodesAreThoseThatOctomapWouldCompute) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::string bytes = write_octomap(random_tree(seed, OctomapKind::kColor)).value();
    const auto tree = read_by_octomap(bytes);
    auto* octree = dynamic_cast<octomap::ColorOcTree*>(tree.get());
    ASSERT_NE(octree, nullptr);
    std::ostringstream before;
    octree->writeData(before);
    octree->updateInnerOccupancy();
    std::ostringstream after;
    octree->writeData(after);
    EXPECT_EQ(before.str(), after.str());
  }
}

TEST(OctomapFile, BinaryFilesAgreeWithOctomapBothWays) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const OctomapTree plain = random_tree(seed, OctomapKind::kOccupancy);
    const std::string bytes = write_octomap_binary(plain).value();
    octomap::OcTree octree(0.1);
    std::istringstream stream(bytes);
    ASSERT_TRUE(octree.readBinary(stream));
    const auto ours = parse_octomap(bytes, kOctomapSource);
    ASSERT_TRUE(ours) << to_string(ours.error());
    auto theirs = leaves_of(octree);
    ASSERT_EQ(theirs.size(), ours->value.leaves.size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      EXPECT_NEAR(theirs[i].log_odds, ours->value.leaves[i].log_odds, 1e-3F);
      theirs[i].log_odds = ours->value.leaves[i].log_odds;
    }
    EXPECT_EQ(theirs, ours->value.leaves);
    std::ostringstream rewritten;
    ASSERT_TRUE(octree.writeBinaryConst(rewritten));
    const auto back = parse_octomap(rewritten.str(), kOctomapSource);
    ASSERT_TRUE(back) << to_string(back.error());
    EXPECT_EQ(back->value, ours->value);
  }
}

class OctomapFilesOfOthers : public testing::TestWithParam<const char*> {};

TEST_P(OctomapFilesOfOthers, GiveTheSameLeavesAsOctomapsOwnReader) {
  HYPERMAP_REQUIRE_SHARED_DATA(GetParam());
  const auto path = test::shared_data(GetParam());
  const auto ours = read_octomap(path);
  ASSERT_TRUE(ours) << to_string(ours.error());
  EXPECT_THAT(ours->findings, IsEmpty());
  std::unique_ptr<octomap::AbstractOcTree> read;
  if (path.extension() == ".bt") {
    auto binary = std::make_unique<octomap::OcTree>(0.1);
    ASSERT_TRUE(binary->readBinary(path.string()));
    read = std::move(binary);
  } else {
    read.reset(octomap::AbstractOcTree::read(path.string()));
  }
  const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  const octomap::OcTree& octree = *tree;
  EXPECT_EQ(octree.getResolution(), ours->value.resolution_m);
  const auto theirs = leaves_of(octree);
  ASSERT_EQ(theirs.size(), ours->value.leaves.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    ASSERT_EQ(theirs[i].key, ours->value.leaves[i].key);
    ASSERT_EQ(theirs[i].depth, ours->value.leaves[i].depth);
    ASSERT_NEAR(theirs[i].log_odds, ours->value.leaves[i].log_odds, 1e-3F);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         OctomapFilesOfOthers,
                         testing::Values("octomap/velma/map.ot",
                                         "octomap/velma/map.bt",
                                         "octomap/geb079/geb079.bt"));

}  // namespace
}  // namespace hypermap
