// SPDX-License-Identifier: BSD-3-Clause
#include "shell/shell_completion.hpp"

#include "shell/shell_commands.hpp"
#include "shell/shell_history.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string inserted(std::vector<std::string> candidates, std::string open, char quote = '\0') {
  return insertion_of(
      {.open = std::move(open), .quote = quote, .candidates = std::move(candidates)});
}

TEST(ShellInsertion, GoesOnAsFarAsAllCandidatesAgree) {
  EXPECT_EQ(inserted({"getCoords", "getCoordsArea"}, "getC"), "oords");
  EXPECT_EQ(inserted({"getCoords", "getCoordsArea"}, "getCoords"), "");
  EXPECT_EQ(inserted({"office chair"}, "off"), "ice\\ chair ");
  EXPECT_EQ(inserted({"office chair"}, "off", '"'), "ice chair\" ");
  EXPECT_EQ(inserted({"a folder/"}, "a"), "\\ folder/") << "more may follow";
  EXPECT_EQ(inserted({}, "x"), "");
}

TEST(ShellCompletion, KnowsCommandsAndFiles) {
  const test::TempDir folder;
  std::ofstream(folder.path() / "a.hmap") << "x";
  std::ofstream(folder.path() / ".hidden") << "x";
  const ShellSession session{ArchiveLimits{}};
  EXPECT_THAT(complete(session, "getInt").candidates,
              ElementsAre("getInt", "getIntCoords", "getIntCoordsArea", "getInts"));
  EXPECT_THAT(complete(session, "help wh").candidates, ElementsAre("why", "whyNot"));
  const std::string begin = folder.path().string() + "/";
  EXPECT_THAT(complete(session, "load " + begin).candidates, ElementsAre(begin + "a.hmap"));
  EXPECT_THAT(complete(session, "load " + begin + ".").candidates, ElementsAre(begin + ".hidden"));
  EXPECT_THAT(complete(session, "load /no/such/folder/").candidates, IsEmpty());
  EXPECT_THAT(complete(session, "getLayerCount ").candidates, IsEmpty());
  EXPECT_THAT(complete(session, "nonsense ").candidates, IsEmpty());
  EXPECT_THAT(complete(session, "# ge").candidates, IsEmpty());
}

TEST(ShellCommands, AreAllThoseOfTheText) {
  std::vector<std::string_view> names;
  for (const ShellCommand& command : shell_commands()) names.push_back(command.name);
  // [hypermap] table 2.
  for (const char* name : {"help",
                           "load",
                           "loadConfig",
                           "save",
                           "getString",
                           "getStrings",
                           "getCoords",
                           "getCoordsArea",
                           "republish",
                           "exit",
                           "clear",
                           "getLayerCount"}) {
    EXPECT_THAT(names, Contains(name));
  }
  for (const ShellCommand& command : shell_commands()) {
    EXPECT_LE(command.min_words, command.max_words) << command.name;
    EXPECT_NE(command.run, nullptr) << command.name;
    EXPECT_EQ(find_shell_command(command.name).value(), &command);
  }
}

TEST(ShellHistory, KeepsTheNewestLinesThatCanBeTyped) {
  const test::TempDir folder;
  const auto file = folder.path() / "state" / "history";
  EXPECT_THAT(read_history(file), IsEmpty());
  const std::vector<std::string> lines{"layers", "a\x01", std::string(5000, 'x'), "", "exit"};
  ASSERT_TRUE(append_history(file, lines));
  EXPECT_THAT(read_history(file), ElementsAre("layers", "exit"));
  ASSERT_TRUE(append_history(file, std::vector<std::string>(kMaxHistoryLines - 1, "again")));
  const auto kept = read_history(file);
  ASSERT_EQ(kept.size(), kMaxHistoryLines);
  EXPECT_EQ(kept[0], "exit");
  EXPECT_EQ(kept[1], "again");
}

}  // namespace
}  // namespace hypermap::app
