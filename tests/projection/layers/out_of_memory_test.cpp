// SPDX-License-Identifier: BSD-3-Clause
// Memory ends within the edits of a semantic layer: a program of its own.
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"
#include "support/allocation_faults.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

#if !HYPERMAP_THREAD_SANITIZER
namespace hypermap {
namespace {

using test::AllocationFaults;
using test::MemoryLoss;

SemanticObject square(std::uint64_t id, double x, double y) {
  const std::string name = id % 2 == 0 ? "a class with a name beyond any small text" : "chair";
  return {.id = id,
          .name = name,
          .parts = {make_polygon({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}).value()}};
}

/// Enough for a tree of three levels.
SemanticLayer many_squares() {
  SemanticLayer layer;
  for (std::uint64_t id = 0; id < 400; ++id) {
    const auto place = static_cast<double>(id);
    EXPECT_TRUE(layer.add(square(2 * id, 1.5 * place, -place)));
  }
  return layer;
}

/// The ids that a layer finds at each of its own objects, and by name.
std::vector<std::vector<std::uint64_t>> found_in(const SemanticLayer& layer) {
  std::vector<std::vector<std::uint64_t>> found{layer.of_class("chair")};
  found.push_back(layer.of_class(layer.objects().front().name));
  for (const SemanticObject& object : layer.objects()) found.push_back(layer.in(object.parts[0]));
  return found;
}

using Edit = std::function<bool(SemanticLayer&)>;

class EditWithoutMemory : public testing::TestWithParam<std::pair<const char*, Edit>> {};

TEST_P(EditWithoutMemory, IsDoneWholeOrNotAtAll) {
  const Edit& edit = GetParam().second;
  const SemanticLayer before = many_squares();
  SemanticLayer after = before;
  ASSERT_TRUE(edit(after));
  int num_failed = 0;
  for (const MemoryLoss loss : {MemoryLoss::kOnce, MemoryLoss::kFromThen}) {
    bool happened = true;
    for (long granted = 0; happened; ++granted) {
      SemanticLayer layer = before;
      bool done = false;
      {
        const AllocationFaults faults(granted, loss);
        try {
          done = edit(layer);
        } catch (const std::bad_alloc&) {
          ++num_failed;
        }
        happened = faults.happened();
      }
      const SemanticLayer& expected = done ? after : before;
      ASSERT_EQ(layer, expected) << "after " << granted << " allocations";
      ASSERT_EQ(found_in(layer), found_in(expected)) << "after " << granted << " allocations";
      // The next edit finds everything in order, and the copy of what is left too.
      SemanticLayer copy = layer;
      ASSERT_EQ(found_in(copy), found_in(expected));
      if (!done) {
        ASSERT_TRUE(edit(copy));
      }
      ASSERT_EQ(found_in(copy), found_in(after)) << "after " << granted << " allocations";
    }
  }
  EXPECT_GT(num_failed, 0);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    EditWithoutMemory,
    testing::Values(
        std::pair<const char*, Edit>{
            "Add", [](SemanticLayer& layer) { return layer.add(square(31, 20, -10)).has_value(); }},
        std::pair<const char*, Edit>{
            "Replace",
            [](SemanticLayer& layer) { return layer.replace(square(40, 300, -300)).has_value(); }},
        std::pair<const char*, Edit>{"Erase", [](SemanticLayer& layer) { return layer.erase(40); }},
        std::pair<const char*, Edit>{"Apply",
                                     [](SemanticLayer& layer) {
                                       return layer
                                           .apply({.to_number = {square(0, 20, -10)},
                                                   .to_modify = {{.id = 44, .name = "chair"}},
                                                   .to_delete = {40}})
                                           .has_value();
                                     }}),
    [](const auto& edit) { return edit.param.first; });

}  // namespace
}  // namespace hypermap
#endif
