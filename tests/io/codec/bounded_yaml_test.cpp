// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_yaml.hpp"

#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <fstream>
#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

const SourceName kSource{.file = "a.hmap", .entry = "map.yaml"};

YamlDocument parsed(const std::string& text) {
  auto document = parse_yaml(text, kSource);
  EXPECT_TRUE(document) << (document ? "" : to_string(document.error()));
  return document ? *document : YamlDocument{};
}

Error refused(const std::string& text, const YamlLimits& limits = {}) {
  const auto document = parse_yaml(text, kSource, limits);
  EXPECT_FALSE(document) << printable(text);
  return document ? Error{} : document.error();
}

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(BoundedYaml, ValuesAreFoundByKeyWithTheirPathAndLine) {
  const YamlDocument document = parsed("layers:\n  - {name: a}\n  - name: b\n    file: x\n");
  const auto layers = document.root().at("layers")->as_list();
  ASSERT_TRUE(layers);
  ASSERT_EQ(layers->size(), 2U);
  const auto file = (*layers)[1].at("file");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->path(), "layers[1].file");
  EXPECT_EQ(file->line(), 4);
  EXPECT_EQ(*file->as_string(), "x");
}

TEST(BoundedYaml, AnErrorNamesFileEntryLineAndField) {
  const YamlDocument document = parsed("a: 1\nresolution: five\n");
  const auto number = document.root().at("resolution")->as_double(1e-6, 1e3);
  ASSERT_FALSE(number);
  EXPECT_EQ(to_string(number.error()),
            "a.hmap!map.yaml:2: resolution: is 'five', expected a finite number from 1e-06 to "
            "1000");
}

TEST(BoundedYaml, AMissingKeyIsNamed) {
  const auto missing = parsed("a: {b: 1}\n").root().at("a")->at("c");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().field, "a.c");
  EXPECT_EQ(missing.error().code, ErrorCode::kMalformedFile);
}

TEST(BoundedYaml, NumbersAreDecimalAndFinite) {
  const auto number = [](const std::string& text) {
    return parsed("[" + text + "]").root().as_list()->front().as_double();
  };
  EXPECT_DOUBLE_EQ(*number("0.05"), 0.05);
  EXPECT_DOUBLE_EQ(*number("+1.5e-3"), 1.5e-3);
  EXPECT_DOUBLE_EQ(*number("-.5"), -0.5);
  EXPECT_DOUBLE_EQ(*number("\"0.25\""), 0.25);
  for (const char* bad : {".nan",
                          "nan",
                          ".inf",
                          "inf",
                          "-.inf",
                          "1e999",
                          "0x10",
                          "1_000",
                          "1:30",
                          "five",
                          "~",
                          "[1]",
                          "\"\"",
                          "1 2",
                          "--1",
                          "+-1"}) {
    EXPECT_FALSE(number(bad)) << bad;
  }
}

TEST(BoundedYaml, ADecimalCommaIsNoNumberInAnyLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "C"}) {
    std::setlocale(LC_NUMERIC, name);  // where it is not installed the plain locale stays
    const YamlDocument document = parsed("a: 0,05\nb: 0.05\n");
    EXPECT_FALSE(document.root().at("a")->as_double());
    EXPECT_DOUBLE_EQ(*document.root().at("b")->as_double(), 0.05);
    EXPECT_EQ(write_yaml(make_list({make_number(0.05)})), "[0.05]\n");
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(BoundedYaml, IntegersAreDecimalWithoutLeadingZero) {
  const auto integer = [](const std::string& text) {
    return parsed("[" + text + "]").root().as_list()->front().as_int(-100, 100);
  };
  EXPECT_EQ(*integer("0"), 0);
  EXPECT_EQ(*integer("-7"), -7);
  EXPECT_EQ(*integer("+7"), 7);
  for (const char* bad :
       {"010", "-01", "1.0", "1e1", "101", "1_0", "0x1", "99999999999999999999"}) {
    EXPECT_FALSE(integer(bad)) << bad;
  }
}

TEST(BoundedYaml, TruthHasSixSpellingsEachAndIsNotInQuotes) {
  const auto truth = [](const std::string& text) {
    return parsed("[" + text + "]").root().as_list()->front().as_bool();
  };
  for (const char* yes : {"true", "True", "TRUE", "yes", "On"}) EXPECT_TRUE(truth(yes).value());
  for (const char* no : {"false", "False", "FALSE", "no", "OFF"}) EXPECT_FALSE(truth(no).value());
  for (const char* bad : {"maybe", "0", "tRUE", "\"true\"", "~", "y"}) EXPECT_FALSE(truth(bad));
}

TEST(BoundedYaml, AListOfNumbersHasTheAskedLength) {
  const YamlDocument document = parsed("origin: [1, 2]\nok: [1, 2, 3]\n");
  EXPECT_EQ(*document.root().at("ok")->as_doubles(3), (std::vector<double>{1, 2, 3}));
  const auto origin = document.root().at("origin")->as_doubles(3);
  ASSERT_FALSE(origin);
  EXPECT_THAT(origin.error().what, HasSubstr("expected 3 numbers"));
}

TEST(BoundedYaml, AKeyMayStandOnlyOnce) {
  const Error error = refused("a: {x: 1,\n x: 2}\n");
  EXPECT_EQ(error.line, 2);
  EXPECT_THAT(to_string(error), HasSubstr("the key x stands twice"));
}

TEST(BoundedYaml, OneDocumentAFile) {
  EXPECT_THAT(refused("a: 1\n---\nb: 2\n").what, HasSubstr("second document"));
  EXPECT_THAT(refused("a: 1\n...\nb: 2\n").what, HasSubstr("second document"));
  EXPECT_EQ(*parsed("---\na: 1\n...\n").root().at("a")->as_int(0, 9), 1);
}

TEST(BoundedYaml, AFileWithoutAValueIsRefused) {
  for (const char* text : {"", "\n\n", "# only a comment\n"}) {
    EXPECT_THAT(refused(text).what, HasSubstr("holds no value"));
  }
}

TEST(BoundedYaml, OnlyUtf8IsRead) {
  EXPECT_EQ(refused("a: 1\nb: \xFF\n").line, 2);
  EXPECT_THAT(refused(std::string("\xFF\xFE", 2) + "a").what, HasSubstr("UTF-16"));
  EXPECT_THAT(refused(std::string("a: b\0c\n", 7)).what, HasSubstr("control character"));
  EXPECT_THAT(refused("a: \xC0\xAF\n").what, HasSubstr("UTF-8"));
  EXPECT_THAT(refused("a: b\x04 c\n").what, HasSubstr("control character"));
  EXPECT_EQ(*parsed("\xEF\xBB\xBF"
                    "a: Stühle\n")
                 .root()
                 .at("a")
                 ->as_string(),
            "Stühle");
}

TEST(BoundedYaml, LineEndsMayBeCrLfButNotLoneCr) {
  EXPECT_EQ(*parsed("a: x\r\nb: y\r\n").root().at("b")->as_string(), "y");
  EXPECT_THAT(refused("a: x\rb: y\n").what, HasSubstr("carriage return"));
}

TEST(BoundedYaml, ABombOfAliasesMeetsItsLimit) {
  std::string bomb = "a0: &a0 [x,x,x,x,x,x,x,x,x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last +
            repeated("," + last, 8) + "]\n";
  }
  const Error error = refused(bomb);
  EXPECT_EQ(error.code, ErrorCode::kLimit);
  EXPECT_THAT(error.what, HasSubstr("aliases"));
}

TEST(BoundedYaml, ALongTextCopiedByManyAliasesMeetsItsLimit) {
  const std::string text = "a: &a \"" + std::string(300'000, 'x') + "\"\nb: [*a,*a,*a,*a]\n";
  EXPECT_EQ(refused(text).code, ErrorCode::kLimit);
}

TEST(BoundedYaml, AnAliasIsACopy) {
  const YamlDocument document = parsed("a: &a [1, 2]\nb: *a\n");
  EXPECT_EQ(document.root().at("a")->value(), document.root().at("b")->value());
}

TEST(BoundedYaml, AnAliasOfNothingIsTakenForTextWithoutQuotes) {
  const Error error = refused("color: rgb\ndepth: *.pgm\n");
  EXPECT_EQ(error.line, 2);
  EXPECT_THAT(error.what, HasSubstr("text that begins with * stands in quotes"));
}

TEST(BoundedYaml, ACycleOfAliasesIsRefused) {
  EXPECT_THAT(refused("a: &a [1, *a]\n").what, HasSubstr("within the value"));
  EXPECT_FALSE(parse_yaml("a: *nowhere\n", kSource));
}

TEST(BoundedYaml, NestingEndsAtItsLimit) {
  EXPECT_TRUE(parse_yaml(repeated("[", 64) + repeated("]", 64), kSource));
  EXPECT_EQ(refused(repeated("[", 65) + repeated("]", 65)).code, ErrorCode::kLimit);
  EXPECT_EQ(refused(repeated("? ", 100'000)).code, ErrorCode::kUnsupported);
  EXPECT_EQ(refused(repeated("- ", 100'000)).code, ErrorCode::kLimit);
  EXPECT_FALSE(parse_yaml(repeated("{a: ", 400'000), kSource));
}

TEST(BoundedYaml, ValuesFlowItemsAndBytesAreLimited) {
  YamlLimits limits;
  limits.max_nodes = 10;
  EXPECT_EQ(refused(repeated("- a\n", 10), limits).code, ErrorCode::kLimit);
  EXPECT_TRUE(parse_yaml(repeated("- a\n", 9), kSource, limits));
  EXPECT_THAT(refused("[" + repeated("x,", 300'000) + "]").what, HasSubstr("flow collection"));
  limits = {};
  limits.max_map_keys = 2;
  EXPECT_TRUE(parse_yaml("a: 1\nb: {a: 1, b: 2}\n", kSource, limits));
  EXPECT_EQ(refused("a: 1\nb: 2\nc: 3\n", limits).code, ErrorCode::kLimit);
  limits = {};
  limits.max_bytes = 4;
  EXPECT_THAT(refused("a: bc", limits).what, HasSubstr("the limit for YAML is 4"));
}

TEST(BoundedYaml, AShapeWithManyCommasIsNoFlowCollection) {
  const std::string shape = repeated("1 2,", 200'000);
  EXPECT_TRUE(parse_yaml("- shape: \"" + shape + "\"\n- shape: \"" + shape + "\"\n", kSource));
}

TEST(BoundedYaml, StrangeKeysAndTagsAreRefused) {
  EXPECT_EQ(refused("[a, b]: 1\n").code, ErrorCode::kUnsupported);
  EXPECT_EQ(refused("<<: {a: 1}\n").code, ErrorCode::kUnsupported);
  EXPECT_EQ(refused("a: !!python/object x\n").code, ErrorCode::kUnsupported);
  EXPECT_EQ(refused("~: 1\n").code, ErrorCode::kMalformedFile);
  EXPECT_TRUE(parsed("a: !!str 5\n").root().at("a")->value().quoted);
}

TEST(BoundedYaml, SyntaxErrorsNameTheirLine) {
  const Error error = refused("a: 1\nb: [1, 2\nc: }\n");
  EXPECT_THAT(error.what, HasSubstr("is no YAML"));
  EXPECT_GT(error.line, 1);
}

TEST(BoundedYaml, UnknownKeysAreFoundAndTheNearestNameIsGiven) {
  const YamlDocument document = parsed("resolutoin: 1\nmode: raw\nquite_else: 2\n");
  constexpr std::string_view kKnown[] = {"resolution", "mode"};
  const auto findings = document.root().unknown_keys(kKnown);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_THAT(findings[0].error.what, HasSubstr("did you mean \"resolution\"?"));
  EXPECT_EQ(findings[1].error.what, "unknown key, kept");
}

TEST(BoundedYaml, OtherKeysAreRefusedWhereNoneMayBe) {
  constexpr std::string_view kKnown[] = {"resolution", "mode"};
  const YamlDocument known = parsed("mode: raw\n");
  EXPECT_TRUE(known.root().refuse_other_keys(kKnown));
  const YamlDocument other = parsed("mode: raw\nresolutoin: 1\n");
  const Error error = other.root().refuse_other_keys(kKnown).error();
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_EQ(error.line, 2);
  EXPECT_EQ(error.what, "unknown key \"resolutoin\", did you mean \"resolution\"?");
  EXPECT_EQ(other.root().refuse_other_keys(kKnown, ErrorCode::kMalformedFile).error().code,
            ErrorCode::kMalformedFile);
  const YamlDocument list = parsed("[mode]\n");
  EXPECT_EQ(list.root().refuse_other_keys(kKnown).error().code, ErrorCode::kMalformedFile);
}

TEST(BoundedYaml, AFileOnDiskIsNamedInErrors) {
  const test::TempDir dir;
  std::ofstream(dir / "x.yaml") << "a: [";
  const auto bad = read_yaml(dir / "x.yaml");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().file, (dir / "x.yaml").string());
  const auto absent = read_yaml(dir / "absent.yaml");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
