// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/result.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ErrorText, NamesFileEntryLineFieldAndRule) {
  const Error error{.code = ErrorCode::kMalformedFile,
                    .what = "ring 2 is not closed, expected the first point again",
                    .file = "a.hmap",
                    .entry = "semantic",
                    .field = "shape",
                    .line = 12};
  EXPECT_EQ(to_string(error),
            "a.hmap!semantic:12: shape: ring 2 is not closed, expected the first point again");
}

TEST(ErrorText, LeavesOutWhatIsEmpty) {
  EXPECT_EQ(to_string(Error{.what = "must be > 0, is -1", .field = "resolution_m"}),
            "resolution_m: must be > 0, is -1");
}

TEST(Printable, EscapesControlCharactersAndInvalidUtf8) {
  EXPECT_EQ(printable("a\nb\x1b[31m\xff\xc3\xa9"), "a\\x0ab\\x1b[31m\\xff\xc3\xa9");
}

TEST(Printable, EscapesControlCharactersBeyondAscii) {
  // U+009B is the control sequence introducer; U+00A0 is a blank.
  EXPECT_EQ(printable("\xc2\x9b\xc2\xa0"), "\\xc2\\x9b\xc2\xa0");
  EXPECT_EQ(printable("a\u202Ecod\u202C"), "a\\xe2\\x80\\xaecod\\xe2\\x80\\xac");
  EXPECT_EQ(printable("\u061C\u2066\u200F\u2028"),
            "\\xd8\\x9c\\xe2\\x81\\xa6\\xe2\\x80\\x8f\\xe2\\x80\\xa8");
  EXPECT_EQ(printable("\u2014\u2070\u0622"), "\u2014\u2070\u0622") << "their neighbours";
}

TEST(Printable, RefusesOverlongFormsAndSurrogates) {
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
}

TEST(Printable, CutsLongTextBetweenCharacters) {
  const std::string cut = printable(std::string(300, 'x'));
  EXPECT_EQ(cut, std::string(200, 'x') + "...");
  EXPECT_EQ(printable("\xc3\xa9\xc3\xa9", 3), "\xc3\xa9...");
}

Result<int> half(int value) {
  if (value % 2 != 0) return fail(ErrorCode::kInvalidArgument, "must be even", "value");
  return value / 2;
}

Result<int> quarter(int value) {
  HYPERMAP_ASSIGN_OR_RETURN(const int once, half(value));
  return half(once);
}

TEST(ResultMacros, HandTheErrorOn) {
  EXPECT_EQ(quarter(8).value(), 2);
  EXPECT_EQ(quarter(6).error().field, "value");
}

}  // namespace
}  // namespace hypermap
