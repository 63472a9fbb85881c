// SPDX-License-Identifier: BSD-3-Clause
// Which files a dataset consists of.
#include "hypermap/io/dataset/dataset_files.hpp"

#include "hypermap/io/dataset/dataset_description.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

class DatasetFiles : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text = "") const {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name) << text;
  }
  [[nodiscard]] bool is_part(const std::string& name) const {
    const auto part = dataset_file(root / name);
    return part && part->folder == fs::canonical(root / "set");
  }
  /// In TUM's layout: lists of images, poses, intrinsics.
  void make_tum() const {
    write("set/depth.txt", "1.0 depth/1.png\n");
    write("set/rgb.txt", "1.0 rgb/1.png\n");
    write("set/depth/1.png");
    write("set/rgb/1.png");
    write("set/groundtruth.txt");
    write("set/camera.json", "{}");
  }

  test::TempDir dir;
  fs::path root = dir.path();
};

TEST_F(DatasetFiles, OfListsAreTheListsAndWhatTheyName) {
  make_tum();
  for (const char* name : {"set/depth.txt",
                           "set/rgb.txt",
                           "set/groundtruth.txt",
                           "set/camera.json",
                           "set/depth/1.png",
                           "set/rgb/1.png"}) {
    EXPECT_TRUE(is_part(name)) << name;
  }
  for (const char* name : {"set/depth/2.png",
                           "set/stats.json",
                           "set/map.hmap",
                           "set/map.hmap.checkpoint",
                           "set/maps/plan.png",
                           "set/truth.hmap",
                           "elsewhere.png"}) {
    EXPECT_FALSE(is_part(name)) << name;
  }
  write("set/truth.hmap");
  EXPECT_TRUE(is_part("set/truth.hmap")) << "of a simulation";
}

TEST_F(DatasetFiles, OfPatternsIsWhatFitsThemThereOrNot) {
  write("set/frame-000000.depth.png");
  EXPECT_TRUE(is_part("set/frame-000000.depth.png"));
  EXPECT_TRUE(is_part("set/frame-000001.depth.png")) << "would be the next frame";
  EXPECT_TRUE(is_part("set/frame-000000.pose.txt"));
  EXPECT_FALSE(is_part("set/plan.png"));
  EXPECT_FALSE(is_part("set/below/frame-000000.depth.png"));
}

TEST_F(DatasetFiles, OfADescriptionIsWhatItNames) {
  write("set/dataset.yaml",
        "depth: range/deep/*.png\ndepth_scale: 1000\ntrajectory: poses.txt\n"
        "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\ndetections: [found.json]\n");
  write("set/range/deep/1.png");
  EXPECT_TRUE(is_part("set/dataset.yaml"));
  EXPECT_TRUE(is_part("set/poses.txt"));
  EXPECT_TRUE(is_part("set/range/deep/1.png"));
  EXPECT_FALSE(is_part("set/range/1.png"));
  EXPECT_FALSE(dataset_file(root / "set/poses.txt")->is_detections);
  EXPECT_TRUE(dataset_file(root / "set/found.json")->is_detections);
}

TEST_F(DatasetFiles, LinksAreFollowed) {
  make_tum();
  fs::create_directory_symlink(root / "set/depth", root / "by_folder");
  fs::create_symlink(root / "set/depth/1.png", root / "by_file.png");
  EXPECT_TRUE(is_part("by_folder/1.png"));
  EXPECT_TRUE(is_part("by_file.png"));
}

TEST_F(DatasetFiles, LinksInsideADatasetAreItsFiles) {
  make_tum();
  fs::rename(root / "set/depth", root / "store");
  fs::create_directory_symlink(root / "store", root / "set/depth");
  fs::rename(root / "set/groundtruth.txt", root / "poses");
  fs::create_symlink(root / "poses", root / "set/groundtruth.txt");
  EXPECT_TRUE(dataset_file(root / "set/depth/1.png").has_value());
  EXPECT_TRUE(dataset_file(root / "set/groundtruth.txt").has_value());
  EXPECT_TRUE(dataset_with_images_in(root / "set/depth").has_value());
}

TEST_F(DatasetFiles, ALinkToNothingIsWhatItWouldMake) {
  write("set/frame-000000.depth.png");
  fs::create_symlink(root / "set/frame-000009.depth.png", root / "plan.png");
  EXPECT_TRUE(is_part("plan.png"));
}

TEST_F(DatasetFiles, NamesMayBeWrittenInManyWays) {
  write("set/dataset.yaml",
        "depth: ./range//*.png\ndepth_scale: 1000\ntrajectory: ./poses.txt\n"
        "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\ndetections: [./found.json]\n");
  write("set/range/1.png");
  EXPECT_TRUE(is_part("set/range/1.png"));
  EXPECT_TRUE(is_part("set/poses.txt"));
  EXPECT_TRUE(dataset_file(root / "set/found.json")->is_detections);
  EXPECT_TRUE(dataset_with_images_in(root / "set/range").has_value());
}

TEST_F(DatasetFiles, AFolderMayBeDescribedElsewhere) {
  make_tum();
  write("set/infrared/1.png");
  DatasetDescription other;
  other.depth = "infrared/*.png";
  other.trajectory = "slam.txt";
  EXPECT_FALSE(is_part("set/slam.txt"));
  EXPECT_TRUE(dataset_file(root / "set/slam.txt", root / "set", other).has_value());
  EXPECT_TRUE(dataset_file(root / "set/infrared/1.png", root / "set", other).has_value());
  EXPECT_FALSE(dataset_file(root / "slam.txt", root / "set", other).has_value());
}

TEST_F(DatasetFiles, WhereADescriptionCannotBeReadAllThatIsThereMayBePart) {
  write("set/dataset.yaml", "depth: [1\n");
  write("set/depth/1.png");
  write("set/map.hmap");
  write("set/truth.hmap");
  for (const char* name : {"set/dataset.yaml", "set/depth/1.png", "set/truth.hmap"})
    EXPECT_TRUE(is_part(name)) << name;
  for (const char* name : {"set/map.hmap", "set/depth/2.png"}) EXPECT_FALSE(is_part(name)) << name;
}

TEST_F(DatasetFiles, FoldersInWhichAPatternLooksForImagesAreKnownWhileTheyAreEmpty) {
  write("set/dataset.yaml",
        "depth: depth/*.png\ncolor: ./color/*.pgm\ndepth_scale: 5000\ntrajectory: poses.txt\n"
        "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\n");
  EXPECT_EQ(dataset_with_images_in(root / "set/color"), fs::canonical(root / "set"));
  EXPECT_EQ(dataset_with_images_in(root / "set/color/"), fs::canonical(root / "set"));
  EXPECT_FALSE(dataset_with_images_in(root / "set/colors"));
  EXPECT_FALSE(dataset_with_images_in(root / "set/color/below"));
}

TEST_F(DatasetFiles, FoldersWithImagesAreKnown) {
  make_tum();
  fs::create_directories(root / "set/maps");
  EXPECT_EQ(dataset_with_images_in(root / "set/depth"), fs::canonical(root / "set"));
  EXPECT_FALSE(dataset_with_images_in(root / "set/maps"));
  EXPECT_FALSE(dataset_with_images_in(root));
}

}  // namespace
}  // namespace hypermap
