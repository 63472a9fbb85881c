// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/preset_name.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace hypermap {
namespace {

TEST(PresetName, NamesStandInTheOrderOfTheEnumerators) {
  const auto names = preset_names();
  EXPECT_EQ(std::vector<std::string_view>(names.begin(), names.end()),
            (std::vector<std::string_view>{"default", "smap", "hypermap"}));
  EXPECT_EQ(to_string(PresetName::kDefault), "default");
  EXPECT_EQ(to_string(PresetName::kSmap), "smap");
  EXPECT_EQ(to_string(PresetName::kHypermap), "hypermap");
}

TEST(PresetName, EveryNameIsFoundAgain) {
  for (const std::string_view name : preset_names()) {
    const auto preset = preset_of(name);
    ASSERT_TRUE(preset) << name;
    EXPECT_EQ(to_string(*preset), name);
  }
  for (const char* text : {"", "Default", "smap ", "hyper"}) EXPECT_FALSE(preset_of(text)) << text;
}

}  // namespace
}  // namespace hypermap
