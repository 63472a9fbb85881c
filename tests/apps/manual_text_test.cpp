// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "manual/bash_completion.hpp"
#include "manual/man_page.hpp"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace hypermap::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Roff, PrintsEveryCharacterAsItIs) {
  EXPECT_EQ(roff("plain text, 1.5 m"), "plain text, 1.5 m");
  EXPECT_EQ(roff("--a \"b\" 'c' `d` ^~"), "\\-\\-a \\(dqb\\(dq \\(aqc\\(aq \\(gad\\(ga \\(ha\\(ti");
  EXPECT_EQ(roff(".TH is no macro here, nor .here"), "\\&.TH is no macro here, nor .here");
  EXPECT_EQ(roff("'so"), "\\(aqso") << "at the start of a line ' is a command, too";
  EXPECT_EQ(roff("C:\\n"), "C:\\en");
  EXPECT_EQ(roff("é€"), "\\[u00E9]\\[u20AC]");
  EXPECT_EQ(roff(std::string("\xF0\x9D\x84\x9E")), "\\[u1D11E]");
  EXPECT_EQ(roff(""), "");
}

/// A program with a command that has an option of each kind.
class MadeProgram : public ::testing::Test {
 protected:
  MadeProgram() {
    CLI::App& command = *program_.add_subcommand("draw", "Draws .dots");
    command.add_option("file", file_, "what to draw")->required();
    command.add_option("-c,--colour", colour_, "of ink")
        ->transform(one_of({"red", "dark-blue"}))
        ->capture_default_str();
    auto* thick = command.add_flag("--thick", is_thick_, "lines of 1\\2 mm");
    auto* zigzag = command.add_flag("--zigzag", is_zigzag_, "lines that turn")->excludes(thick);
    command.add_option("--many", many_, "of them")->needs(zigzag)->excludes(thick);
    command.footer("Examples:\n  made draw 'a b'");
  }

  CLI::App program_{"Makes", "made"};
  std::string file_;
  std::string colour_ = "red";
  std::vector<int> many_;
  bool is_thick_ = false;
  bool is_zigzag_ = false;
};

TEST_F(MadeProgram, IsDescribed) {
  const CommandText text = describe(program_);
  ASSERT_EQ(text.commands.size(), 1U);
  const CommandText& draw = text.commands[0];
  EXPECT_EQ(draw.name, "made draw");
  EXPECT_EQ(draw.last_name(), "draw");
  EXPECT_THAT(draw.examples, ElementsAre("made draw 'a b'"));
  ASSERT_EQ(draw.positionals.size(), 1U);
  EXPECT_TRUE(draw.positionals[0].is_required);
  ASSERT_EQ(draw.options.size(), 5U) << "with --help";
  const OptionText& colour = draw.options[1];
  EXPECT_THAT(colour.names, ElementsAre("-c", "--colour"));
  EXPECT_THAT(colour.choices, ElementsAre("red", "dark-blue"));
  EXPECT_EQ(colour.default_value, "red");
  EXPECT_EQ(colour.range, "");
  const OptionText& thick = draw.options[2];
  EXPECT_EQ(thick.value, "");
  EXPECT_THAT(thick.excludes, ElementsAre("--many", "--zigzag")) << "by letters, not by addresses";
  const OptionText& many = draw.options[4];
  EXPECT_TRUE(many.may_be_repeated);
  EXPECT_THAT(many.needs, ElementsAre("--zigzag"));
}

TEST_F(MadeProgram, HasAPageForItselfAndForItsCommand) {
  const ExitStatus statuses[] = {{"0", "done"}};
  const auto pages = man_pages(describe(program_), statuses, "1.2");
  ASSERT_EQ(pages.size(), 2U);
  EXPECT_EQ(pages[0].name, "made.1");
  EXPECT_THAT(pages[0].text, HasSubstr("\\fBmade\\-draw\\fR(1)"));
  EXPECT_EQ(pages[1].name, "made-draw.1");
  EXPECT_THAT(pages[1].text, HasSubstr("\n.SH NAME\nmade\\-draw \\- Draws .dots\n"));
  EXPECT_THAT(pages[1].text, HasSubstr("lines of 1\\e2 mm"));
  EXPECT_THAT(pages[1].text,
              HasSubstr("Needs \\fB\\-\\-zigzag\\fR. Excludes \\fB\\-\\-thick\\fR."));
  EXPECT_THAT(pages[1].text, HasSubstr(".nf\nmade draw \\(aqa b\\(aq\n.fi\n"));
}

TEST_F(MadeProgram, IsCompletedByItsChoicesAndFiles) {
  const std::string script = bash_completion(describe(program_), "1.2");
  EXPECT_THAT(script, HasSubstr("draw:-c | draw:--colour)\n      words='red dark-blue'"));
  EXPECT_THAT(script, HasSubstr("draw:--many)\n      files=yes"));
  EXPECT_THAT(script, Not(HasSubstr("draw:--thick"))) << "a flag has no value";
}

TEST(OneOf, TakesOneNameInAnySpelling) {
  CLI::App program;
  std::string axis;
  CLI::Option* option =
      program.add_option("--axis", axis)->transform(one_of({"x", "-x", "far_left"}));
  EXPECT_THAT(choices_of(*option), ElementsAre("x", "-x", "far_left"));
  EXPECT_THAT(choices_of(*program.add_option("--other", axis)), IsEmpty());
  for (const auto& [said, meant] : std::vector<std::pair<std::string, std::string>>{
           {"X", "x"}, {"-X", "-x"}, {"Far Left", "far_left"}, {"FAR-left", "far_left"}}) {
    program.parse(std::vector<std::string>{said, "--axis"});
    EXPECT_EQ(axis, meant);
  }
  EXPECT_THROW(program.parse(std::vector<std::string>{"_x", "--axis"}), CLI::ValidationError)
      << "x or -x?";
}

}  // namespace
}  // namespace hypermap::app
