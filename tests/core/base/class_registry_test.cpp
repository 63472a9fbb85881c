// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_registry.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

TEST(ClassRegistry, NumbersClassesInTheOrderOfFirstMention) {
  ClassRegistry registry;
  EXPECT_EQ(registry.add("chair").value(), ClassId{0});
  EXPECT_EQ(registry.add("cup").value(), ClassId{1});
  EXPECT_EQ(registry.add("chair").value(), ClassId{0});
  EXPECT_EQ(registry.size(), 2U);
  EXPECT_EQ(registry.name(ClassId{1}), "cup");
  EXPECT_FALSE(registry.contains(ClassId{2}));
}

TEST(ClassRegistry, TreatsSpellingsAsOneClassAndShowsTheFirst) {
  ClassRegistry registry;
  const ClassId table = registry.add("Dining Table").value();
  EXPECT_EQ(registry.add("diningtable").value(), table);
  EXPECT_EQ(registry.find("dining-table"), table);
  EXPECT_EQ(registry.name(table), "Dining Table");
  EXPECT_EQ(registry.find("sink"), std::nullopt);
}

TEST(CanonicalClassName, MapsNamesOfCocoToThoseOfVoc) {
  EXPECT_EQ(canonical_class_name("tv"), "tvmonitor");
  EXPECT_EQ(canonical_class_name("Couch"), "sofa");
  EXPECT_EQ(canonical_class_name("potted plant"), "pottedplant");
  EXPECT_EQ(canonical_class_name("motorcycle"), "motorbike");
  EXPECT_EQ(canonical_class_name("airplane"), "aeroplane");
  EXPECT_EQ(canonical_class_name("cell_phone"), "cellphone");
}

TEST(ClassRegistry, KeepsWhateverADetectorSays) {
  ClassRegistry registry;
  const std::string active = "../../etc/passwd\n- evil: true\x1b[31m";
  EXPECT_EQ(registry.name(registry.add(active).value()), active);
}

TEST(ClassRegistry, RefusesWhatIsNoText) {
  ClassRegistry registry;
  EXPECT_EQ(registry.add("").error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(registry.add(std::string("a\0b", 3)).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(registry.add("\xff").error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(registry.add(std::string(257, 'x')).error().code, ErrorCode::kLimit);
  EXPECT_TRUE(registry.add(std::string(256, 'x')).has_value());
  EXPECT_TRUE(registry.add("Stühle").has_value());
  EXPECT_EQ(registry.size(), 2U);
}

TEST(ClassRegistry, ADetectorsListGivesTheIdsOfItsOrder) {
  const std::vector<std::string> names{"cup", "chair", "tv"};
  const ClassRegistry registry = ClassRegistry::from_names(names).value();
  EXPECT_EQ(registry.find("chair"), ClassId{1});
  EXPECT_EQ(registry.find("tvmonitor"), ClassId{2});
}

TEST(ClassRegistry, RefusesAListThatNamesAClassTwice) {
  const std::vector<std::string> names{"sofa", "cup", "couch"};
  const auto error = ClassRegistry::from_names(names).error();
  EXPECT_EQ(error.field, "names[2]");
  EXPECT_EQ(error.what, "must name each class once, couch is that of names[0]");
  EXPECT_EQ(ClassRegistry::from_names(std::vector<std::string>{"a", ""}).error().field, "names[1]");
}

TEST(ClassRegistry, SpellingsFoldWithoutTheWordsOfOtherLists) {
  EXPECT_EQ(folded_class_name("TV-Monitor_2 x"), "tvmonitor2x");
  EXPECT_EQ(folded_class_name("Couch"), "couch");  // canonical: sofa
}

TEST(ClassRegistry, StopsAtItsLimit) {
  ClassRegistry registry;
  for (int i = 0; i < 65535; ++i) ASSERT_TRUE(registry.add("c" + std::to_string(i)).has_value());
  EXPECT_EQ(registry.add("one more").error().code, ErrorCode::kLimit);
  EXPECT_EQ(registry.add("c7").value(), ClassId{7});
}

}  // namespace
}  // namespace hypermap
