// SPDX-License-Identifier: BSD-3-Clause
// What a dataset was asked for and does not have is said, by the name under which it was asked for.
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "io/dataset/opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace hypermap {
namespace {

using test::opened;
using test::SyntheticDataset;
using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::Not;

class DatasetFindings : public ::testing::Test {
 protected:
  /// All that is said of the dataset when it is opened, a line each.
  [[nodiscard]] std::string said(const DatasetOptions& options = {}) const {
    ClassRegistry registry;
    const auto reader = opened(dataset_.folder, registry, options);
    std::string text;
    for (const Finding& finding : reader->summary().findings) {
      text.append(to_string(finding.error)).append("\n");
    }
    return text;
  }
  /// The description with a line in place of the one of that key; without it when empty.
  void describe(const std::string& key, const std::string& line) const {
    std::ifstream file(dataset_.folder / "dataset.yaml");
    std::string text;
    for (std::string old; std::getline(file, old);) {
      text.append(old.starts_with(key + ":") ? line : old).append("\n");
    }
    write_text(dataset_.folder / "dataset.yaml", text);
  }

  TempDir dir_;
  SyntheticDataset dataset_ = test::write_described(dir_ / "data");
};

TEST_F(DatasetFindings, NothingIsSaidOfADatasetThatHasAll) {
  EXPECT_EQ(said(), "");
}

TEST_F(DatasetFindings, DetectionsOfAnotherSequenceAreNamedByFileAndImage) {
  write_text(dir_ / "other.jsonl", test::chair_in("kitchen.png") + test::chair_in("hall.png"));
  EXPECT_THAT(said({.detections = {dir_ / "other.jsonl"}}),
              HasSubstr("other.jsonl: image: none of the 2 images that it speaks of is one of the "
                        "dataset's, such as kitchen.png"));
  write_text(dir_ / "some.jsonl", test::chair_in("kitchen.png") + test::chair_in("c/0002_c.pgm"));
  EXPECT_EQ(said({.detections = {dir_ / "some.jsonl"}}), "");
}

TEST_F(DatasetFindings, ColourThatIsNamedAndNotThereIsSaid) {
  describe("color", "color: colour/*_c.pgm");
  EXPECT_THAT(said(), HasSubstr("color: no file is named colour/*_c.pgm"));
  describe("color", "");
  EXPECT_EQ(said(), "");
}

TEST_F(DatasetFindings, ALayoutWithoutColourIsNoFinding) {
  const SyntheticDataset seven = test::write_7scenes(dir_ / "seven");
  for (const auto& entry : std::filesystem::directory_iterator(seven.folder)) {
    if (entry.path().string().ends_with("color.pgm")) std::filesystem::remove(entry);
  }
  ClassRegistry registry;
  EXPECT_TRUE(opened(seven.folder, registry)->summary().findings.empty());
}

TEST_F(DatasetFindings, PosesWithStampsForImagesWithNumbersAreExplainedByThePairing) {
  describe("pair_by", "");
  const std::string text = said();
  EXPECT_THAT(text, HasSubstr("p.txt: pair_by: images have numbers, poses stamps"));
  ClassRegistry registry;
  const auto frame = opened(dataset_.folder, registry)->read(0);
  ASSERT_FALSE(frame);
  EXPECT_THAT(to_string(frame.error()), HasSubstr("`pair_by: order` or `pair_by: number`"));
  EXPECT_THAT(to_string(frame.error()), Not(HasSubstr("within")));
}

}  // namespace
}  // namespace hypermap
