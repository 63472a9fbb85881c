// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/layer_types.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ArchiveLayerTypes, AreTheStrictFormsTwoAndOurs) {
  const LayerRegistry types = archive_layer_types();
  for (const char* name :
       {"OccupancyGridLayer", "SemanticLayer", "GridStackLayer", "SupercellLayer"}) {
    const LayerType* type = types.find(name);
    ASSERT_NE(type, nullptr) << name;
    EXPECT_EQ(type->empty->class_name(), name);
    EXPECT_TRUE(type->load) << name;
  }
  EXPECT_EQ(LayerRegistry().find("GridStackLayer"), nullptr);
}

}  // namespace
}  // namespace hypermap
