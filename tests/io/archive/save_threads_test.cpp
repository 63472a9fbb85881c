// SPDX-License-Identifier: BSD-3-Clause
// How many threads save a map, and that its bytes do not tell.
#include "hypermap/io/archive/map_archive.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// More objects than are made at a time, each with cells of its own, besides all that an archive
/// can hold.
MapArchive archive_of_many_objects() {
  constexpr int kNumObjects = 700;
  std::mt19937 engine(29);
  std::uniform_real_distribution<float> metres(-1.0F, 1.0F);
  MapArchive archive = test::sample_archive();
  for (int i = 1; i < kNumObjects; ++i) {
    Object object = test::sample_object();
    std::vector<Eigen::Vector3f> points;
    points.reserve(30);
    for (int k = 0; k < 30; ++k) points.emplace_back(metres(engine), metres(engine), 0.5F);
    object.points.observe(points);
    archive.objects.add(std::move(object));
  }
  return archive;
}

std::size_t num_threads_of_process() {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                    std::filesystem::directory_iterator()));
}

std::string saved_by(const MapArchive& archive, int num_threads) {
  const test::TempDir folder;
  const std::filesystem::path file = folder.path() / "map.hmap";
  const auto saved = save_archive(archive, file, {.num_threads = num_threads});
  EXPECT_TRUE(saved) << to_string(saved.error());
  return test::files_below(folder.path()).at("map.hmap");
}

// The first one: afterwards idle threads may be left over.
TEST(SaveThreads, OneIsThatOfTheCallerAlone) {
  const MapArchive archive = archive_of_many_objects();
  const std::size_t before = num_threads_of_process();
  (void)saved_by(archive, 1);
  EXPECT_EQ(num_threads_of_process(), before);
}

TEST(SaveThreads, TheBytesAreTheSameAtAnyNumber) {
  const MapArchive archive = archive_of_many_objects();
  const std::string expected = saved_by(archive, 1);
  EXPECT_GT(expected.size(), 10'000U);
  for (const int num_threads : {0, 5}) EXPECT_EQ(saved_by(archive, num_threads), expected);
  EXPECT_EQ(write_archive(archive).value(), expected);
}

}  // namespace
}  // namespace hypermap
