// SPDX-License-Identifier: BSD-3-Clause
#include "shell/shell_words.hpp"

#include <gmock/gmock.h>

#include <random>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ShellWords, AreSeparatedByBlanksAndKeptByQuotes) {
  EXPECT_THAT(split_shell_line("getCoords  semantic\t'a b'").value(),
              ElementsAre("getCoords", "semantic", "a b"));
  EXPECT_THAT(split_shell_line(R"(a\ b "c \"d\" \\" 'e\')").value(),
              ElementsAre("a b", R"(c "d" \)", R"(e\)"));
  EXPECT_THAT(split_shell_line("a'b c'd \"\"").value(), ElementsAre("ab cd", ""));
  EXPECT_THAT(split_shell_line("load a#b # a comment 'x").value(), ElementsAre("load", "a#b"));
  EXPECT_THAT(split_shell_line("").value(), IsEmpty());
  EXPECT_THAT(split_shell_line("  # nothing").value(), IsEmpty());
}

TEST(ShellWords, RefuseWhatIsNotEnded) {
  EXPECT_THAT(split_shell_line("a 'b").error().what, HasSubstr("quote '"));
  EXPECT_THAT(split_shell_line("a \"b\\\"").error().what, HasSubstr("quote \""));
  EXPECT_THAT(split_shell_line("a\\").error().what, HasSubstr("backslash"));
  EXPECT_THAT(split_shell_line(std::string("a\0b", 3)).error().what, HasSubstr("column 2"));
}

TEST(ShellWords, ReadAsThemselvesOnceEscaped) {
  constexpr std::string_view kAlphabet = "ab '\"\\#\t";
  std::mt19937 random(7);
  for (int turn = 0; turn < 2000; ++turn) {
    std::string text;
    for (unsigned length = 1 + random() % 8U; length > 0; --length)
      text += kAlphabet[random() % kAlphabet.size()];
    for (const char quote : {'\0', '\'', '"'}) {
      const std::string mark = quote == '\0' ? "" : std::string(1, quote);
      std::string line = "load ";
      line.append(mark).append(escaped(text, quote)).append(mark);
      const auto words = split_shell_line(line);
      ASSERT_TRUE(words) << line;
      EXPECT_THAT(*words, ElementsAre("load", text)) << line;
    }
  }
}

TEST(ShellWords, TellTheWordAtTheCursor) {
  const OpenShellLine line = split_open_line("load 'a b");
  EXPECT_THAT(line.words, ElementsAre("load"));
  EXPECT_EQ(line.open, "a b");
  EXPECT_EQ(line.quote, '\'');
  EXPECT_EQ(split_open_line("load ").open, "");
  EXPECT_THAT(split_open_line("load ").words, ElementsAre("load"));
  EXPECT_TRUE(split_open_line("load # a").is_comment);
}

}  // namespace
}  // namespace hypermap::app
