// SPDX-License-Identifier: BSD-3-Clause
#include "content_hash.hpp"

#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

class HashedFolder : public testing::Test {
 protected:
  void SetUp() override {
    test::write_text(data() / "depth/1.pgm", "one");
    test::write_text(data() / "poses.txt", "0 0 0");
    before_ = hash();
  }
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }
  [[nodiscard]] std::string hash(const std::vector<fs::path>& left_out = {}) const {
    const auto hashed = folder_hash(data(), left_out);
    EXPECT_TRUE(hashed) << to_string(hashed.error());
    return hashed.value_or("");
  }

  test::TempDir folder_;
  std::string before_;
};

TEST_F(HashedFolder, IsTheSameWhereverItLies) {
  const fs::path copy = folder_.path() / "elsewhere";
  fs::copy(data(), copy, fs::copy_options::recursive);
  EXPECT_EQ(folder_hash(copy).value(), before_);
}

TEST_F(HashedFolder, IsAnotherWithOtherBytesOrNames) {
  test::write_text(data() / "poses.txt", "0 0 1");
  EXPECT_NE(hash(), before_);
  test::write_text(data() / "poses.txt", "0 0 0");
  EXPECT_EQ(hash(), before_);
  fs::rename(data() / "poses.txt", data() / "pose.txt");
  EXPECT_NE(hash(), before_);
}

TEST_F(HashedFolder, IsAnotherWithOneFileMoreUnlessThatIsLeftOut) {
  test::write_text(data() / "out/map.hmap", "map");
  EXPECT_NE(hash(), before_);
  EXPECT_EQ(hash({data() / "out"}), before_);
  EXPECT_EQ(hash({data() / "out/map.hmap"}), before_);
  EXPECT_NE(hash({data() / "absent"}), before_);
}

TEST_F(HashedFolder, FollowsLinksAndEndsInOnesOwnFolder) {
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::rename(data() / "depth", elsewhere);
  fs::create_directory_symlink(elsewhere, data() / "depth");
  EXPECT_EQ(hash(), before_);
  fs::create_directory_symlink(data(), data() / "round");
  EXPECT_EQ(hash(), before_);
}

TEST_F(HashedFolder, ThatIsNotThereIsAnError) {
  const auto absent = folder_hash(folder_.path() / "absent");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kIo);
  EXPECT_EQ(absent.error().file, (folder_.path() / "absent").string());
}

TEST_F(HashedFolder, EndsWhenAskedTo) {
  const auto ended = folder_hash(data(), {}, [] { return true; });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::kInterrupted);
}

TEST(ContentHash, IsThatOfTheBytes) {
  const test::TempDir folder;
  const std::string long_text((std::size_t{1} << 20U) + 1, 'x');
  test::write_text(folder / "a", long_text);
  test::write_text(folder / "b", long_text);
  test::write_text(folder / "c", long_text.substr(1));
  EXPECT_EQ(content_hash(folder / "a").value(), content_hash(folder / "b").value());
  EXPECT_NE(content_hash(folder / "a").value(), content_hash(folder / "c").value());
}

}  // namespace
}  // namespace hypermap
