// SPDX-License-Identifier: BSD-3-Clause
// Frames of a known place take no memory, nor do moves: every allocation of this program is
// counted.
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

#if !HYPERMAP_THREAD_SANITIZER
namespace {

std::atomic<std::size_t>& num_allocations() {
  static std::atomic<std::size_t> count{0};
  return count;
}

void* counted(std::size_t size, std::size_t alignment) {
  ++num_allocations();
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace hypermap::test {
namespace {

class Allocations : public ::testing::TestWithParam<std::tuple<IntegrationMode, int>> {};
INSTANTIATE_TEST_SUITE_P(All,
                         Allocations,
                         ::testing::Combine(::testing::Values(IntegrationMode::kExact,
                                                              IntegrationMode::kDiscretize,
                                                              IntegrationMode::kProjective),
                                            ::testing::Values(1, 2)));

TEST_P(Allocations, FramesOfAKnownPlaceTakeNoMemory) {
  const auto [mode, num_threads] = GetParam();
  const IntegrationOptions options{mode, 4.0, num_threads};
  const std::vector<LabelledFrame> frames = room_frames(3, 160);
  auto tree = SemanticOctree::create({.resolution_m = 0.05}).value();
  FrameIntegrator integrator;
  const auto integrate_all = [&] {
    const std::size_t before = num_allocations();
    for (const LabelledFrame& labelled : frames) {
      EXPECT_TRUE(integrator.integrate(tree, labelled.frame, labelled.labels, options));
    }
    return num_allocations() - before;
  };
  {
    // One thread does all of it: the others have done nothing before they are watched.
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_GT(integrate_all(), 0U);
    for (int i = 0; i < 20; ++i) integrate_all();  // labels settle
  }
  // Whichever thread does how much from here on.
  for (int i = 0; i < 20; ++i) EXPECT_EQ(integrate_all(), 0U);
}

TEST(Allocations, MovesTakeNoMemory) {
  auto tree = SemanticOctree::create({.resolution_m = 0.05}).value();
  ASSERT_TRUE(tree.set_leaf({.key = {1, 2, 3}, .log_odds = 847}));
  ObjectMap objects;
  FrameIntegrator integrator;
  auto mapper = SemanticMapper::create({}).value();
  const std::size_t before = num_allocations();
  SemanticOctree moved_tree = std::move(tree);
  const SemanticOctree copy = moved_tree;
  tree = std::move(moved_tree);
  ObjectMap moved_objects = std::move(objects);
  objects = std::move(moved_objects);
  FrameIntegrator moved_integrator = std::move(integrator);
  integrator = std::move(moved_integrator);
  SemanticMapper moved_mapper = std::move(mapper);
  mapper = std::move(moved_mapper);
  EXPECT_EQ(num_allocations(), before);
  EXPECT_EQ(copy.num_leaves().occupied, 1U);
}

}  // namespace
}  // namespace hypermap::test
#endif
