// SPDX-License-Identifier: BSD-3-Clause
// Memory ends at the allocations of loading and saving: a program of its own.
#include "hypermap/io/archive/map_archive.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/allocation_faults.hpp"
#include "support/files_below.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <new>
#include <optional>

#if !HYPERMAP_THREAD_SANITIZER
namespace hypermap {
namespace {

using test::AllocationFaults;
using test::MemoryLoss;
using test::sample_archive;
using test::TempDir;

class ArchiveWithoutMemory : public ::testing::TestWithParam<MemoryLoss> {
 protected:
  /// What `call` gives when memory ends at the allocation after `granted`; nothing when not even
  /// the error finds room, which an error that is told once always does.
  template <class Call>
  auto attempt(long granted, Call call) {
    std::optional<decltype(call())> result;
    const AllocationFaults faults(granted, GetParam());
    try {
      result.emplace(call());
    } catch (const std::bad_alloc&) {
      EXPECT_EQ(GetParam(), MemoryLoss::kFromThen) << "after " << granted << " allocations";
    }
    happened_ = faults.happened();
    return result;
  }

  [[nodiscard]] bool happened() const { return happened_; }

  /// The next number of allocations that are granted: all of the first, then fewer and fewer.
  static long next(long granted) { return granted + 1 + granted / (test::kSanitized ? 12 : 32); }

 private:
  bool happened_ = true;
};
INSTANTIATE_TEST_SUITE_P(All,
                         ArchiveWithoutMemory,
                         ::testing::Values(MemoryLoss::kOnce, MemoryLoss::kFromThen));

TEST_P(ArchiveWithoutMemory, LoadsWholeOrNotAtAll) {
  const TempDir dir;
  const MapArchive expected = sample_archive();
  const std::filesystem::path path = dir / "a.hmap";
  const LayerRegistry layers;
  ASSERT_TRUE(save_archive(expected, path));
  std::size_t num_refused = 0;
  for (long granted = 0; happened(); granted = next(granted)) {
    const auto loaded = attempt(granted, [&] { return load_archive(path, {}, layers); });
    if (loaded && *loaded) {
      ASSERT_TRUE((*loaded)->value == expected) << "after " << granted << " allocations";
      continue;
    }
    ++num_refused;
    if (loaded) {
      ASSERT_EQ(loaded->error().code, ErrorCode::kOutOfMemory)
          << "after " << granted << " allocations: " << to_string(loaded->error());
    }
  }
  EXPECT_GE(num_refused, 50U);
}

TEST_P(ArchiveWithoutMemory, SavesWholeOrNotAtAll) {
  const TempDir dir;
  MapArchive old = sample_archive();
  old.classes = {};
  old.objects = {};
  old.octree.reset();
  const std::filesystem::path path = dir / "a.hmap";
  const SaveOptions options;
  ASSERT_TRUE(save_archive(old, path));
  const std::string old_bytes = test::files_below(dir.path()).at("a.hmap");
  const MapArchive archive = sample_archive();
  const std::string new_bytes = write_archive(archive).value();
  std::size_t num_refused = 0;
  for (long granted = 0; happened(); granted = next(granted)) {
    test::write_text(path, old_bytes);
    const auto saved = attempt(granted, [&] { return save_archive(archive, path, options); });
    const std::string bytes = test::files_below(dir.path()).at("a.hmap");
    ASSERT_TRUE(bytes == old_bytes || bytes == new_bytes) << "after " << granted << " allocations";
    ASSERT_EQ(test::files_below(dir.path()).size(), 1U) << "after " << granted << " allocations";
    if (saved && *saved) {
      ASSERT_TRUE(bytes == new_bytes) << "after " << granted << " allocations";
      continue;
    }
    ++num_refused;
    if (saved) {
      ASSERT_EQ(saved->error().code, ErrorCode::kOutOfMemory)
          << "after " << granted << " allocations: " << to_string(saved->error());
      ASSERT_EQ(saved->error().what.starts_with("replaced"), bytes == new_bytes)
          << "after " << granted << " allocations: " << to_string(saved->error());
    }
  }
  EXPECT_GE(num_refused, 50U);
}

}  // namespace
}  // namespace hypermap
#endif
