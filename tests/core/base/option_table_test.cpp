// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_table.hpp"

#include "hypermap/core/base/option_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Flavour { kSweet, kSour };

struct InnerOptions {
  double share = 0.5;
  LogOdds bound{2.0};
  std::array<double, 2> weights = {1.0, 2.0};
};

struct FlatOptions {
  std::uint32_t seeds = 5;
};

struct OuterOptions {
  InnerOptions inner = {};
  FlatOptions flat = {};
  int number = 3;
  bool is_on = true;
  Flavour flavour = Flavour::kSour;
  std::optional<double> range_m = std::nullopt;
  std::vector<std::string> classes = {};
  std::vector<NamedNumber> shares = {};
  int threads = 1;
  std::optional<std::size_t> most = std::nullopt;
};

constexpr std::string_view kFlavours[] = {"sweet", "sour"};

constexpr OptionRow kInnerRows[] = {
    option::number<&InnerOptions::share>("share", option::above(0, 1), {.smap = 0.25}),
    option::number<&InnerOptions::bound>("bound", {-10, 10}, {.hypermap = -1.0}),
    option::number<&InnerOptions::weights>("weights", {0, 5}, {}),
};

constexpr OptionRow kFlatRows[] = {
    option::count<&FlatOptions::seeds>("seeds", {1, 6}, {}),
};

constexpr OptionRow kOuterRows[] = {
    option::section<&OuterOptions::inner>("inner"),
    option::section<&OuterOptions::flat>(""),
    option::count<&OuterOptions::number>("number", option::zero_or(2, 9), {.smap = 0}),
    option::flag<&OuterOptions::is_on>("is_on", {.hypermap = false}),
    option::choice<&OuterOptions::flavour>("flavour", kFlavours, {.smap = Flavour::kSweet}),
    option::number<&OuterOptions::range_m>("range_m", {1, 8}, {.smap = 1.5, .hypermap = kNoValue}),
    option::names<&OuterOptions::classes>("classes", {}),
    option::named_numbers<&OuterOptions::shares>("shares", {0, 1}, {}),
    option::count<&OuterOptions::threads>("threads", {1, 4}, {.is_listed = false}),
    option::count<&OuterOptions::most>("most", option::at_least(1), {.is_listed = false}),
};

Result<void> check_outer(const OuterOptions& options) {
  if (options.number == 7) return fail(ErrorCode::kInvalidArgument, "must not be 7", "number");
  return {};
}

const OptionTable& option_table(const InnerOptions&) {
  static constexpr OptionTable kTable{kInnerRows};
  return kTable;
}

const OptionTable& option_table(const FlatOptions&) {
  static constexpr OptionTable kTable{kFlatRows};
  return kTable;
}

const OptionTable& option_table(const OuterOptions&) {
  static constexpr OptionTable kTable{kOuterRows, kRule<check_outer>};
  return kTable;
}

std::string refusal(const OuterOptions& options) {
  const auto checked = check_options(options);
  return checked ? "none" : to_string(checked.error());
}

TEST(OptionTable, ADefaultPasses) {
  EXPECT_EQ(refusal({}), "none");
}

TEST(OptionTable, ARefusalNamesFieldRuleAndValue) {
  EXPECT_EQ(refusal({.inner = {.share = 1.5}}),
            "inner.share: must be above 0 and at most 1, is 1.5");
  EXPECT_EQ(refusal({.inner = {.bound = LogOdds(-11)}}),
            "inner.bound: must be in -10 .. 10, is -11");
  EXPECT_EQ(refusal({.inner = {.weights = {1.0, 6.0}}}),
            "inner.weights: each must be in 0 .. 5, one is 6");
  EXPECT_EQ(refusal({.flat = {.seeds = 7}}), "seeds: must be in 1 .. 6, is 7");
  EXPECT_EQ(refusal({.number = 1}), "number: must be 0 or 2 .. 9, is 1");
  EXPECT_EQ(refusal({.flavour = static_cast<Flavour>(2)}),
            "flavour: must be one of sweet, sour, is no. 2");
  EXPECT_EQ(refusal({.range_m = 0.5}), "range_m: must be in 1 .. 8, is 0.5");
  EXPECT_EQ(refusal({.shares = {{"a", 1.0}, {"b", 2.0}}}),
            "shares: each must be in 0 .. 1, that of \"b\" is 2");
  EXPECT_EQ(refusal({.shares = {{"a", 1.0}, {"a", 0.5}}}),
            "shares: must name each once, \"a\" is there twice");
  EXPECT_EQ(refusal({.shares = {{"", 1.0}}}), "shares: must name each number");
  EXPECT_EQ(refusal({.shares = {{"a", 1.0}, {"b", 0.0}}}), "none");
  EXPECT_EQ(refusal({.threads = 5}), "threads: must be in 1 .. 4, is 5");
  EXPECT_EQ(refusal({.most = 0}), "most: must be at least 1, is 0");
  EXPECT_EQ(refusal({.most = 1}), "none");
  EXPECT_EQ(refusal({.number = 7}), "number: must not be 7");
}

TEST(OptionTable, FieldsAreNamedWithinTheSectionOfTheirStruct) {
  const OuterOptions wrong{.inner = {.share = 1.5}};
  EXPECT_EQ(check_options(wrong, "outer").error().field, "outer.inner.share");
  EXPECT_EQ(check_options(wrong).error().field, "inner.share");
  EXPECT_EQ(check_options(OuterOptions{.number = 7}, "outer").error().field, "outer.number");
}

TEST(OptionTable, OneFieldMayHaveToLieAboveAnother) {
  EXPECT_TRUE(check_above("min", 1.0, "max", 1.5));
  EXPECT_EQ(to_string(check_above("min", 1.0, "max", 1.0).error()),
            "max: must be above min (1), is 1");
  EXPECT_FALSE(check_above("min", 1.0, "max", kNan));
  EXPECT_FALSE(check_above("min", kNan, "max", 1.0));
}

TEST(OptionTable, WhatIsNoNumberIsInNoRange) {
  EXPECT_EQ(refusal({.inner = {.share = kNan}}),
            "inner.share: must be above 0 and at most 1, is nan");
  EXPECT_EQ(refusal({.inner = {.weights = {kNan, 1.0}}}),
            "inner.weights: each must be in 0 .. 5, one is nan");
  EXPECT_EQ(refusal({.range_m = kNan}), "range_m: must be in 1 .. 8, is nan");
  EXPECT_EQ(refusal({.inner = {.bound = LogOdds(-kInfinity)}}),
            "inner.bound: must be in -10 .. 10, is -inf");
}

TEST(OptionTable, EndsOfAnIntervalBelongToItAsItSays) {
  EXPECT_TRUE((OptionRange{0, 1}.contains(0.0)) && (OptionRange{0, 1}.contains(1.0)));
  EXPECT_FALSE(option::above(0, 1).contains(0.0));
  EXPECT_TRUE(option::above(0, 1).contains(1.0));
  EXPECT_TRUE(option::below(0, 1).contains(0.0));
  EXPECT_FALSE(option::below(0, 1).contains(1.0));
  EXPECT_FALSE(option::inside(0, 1).contains(0.0) || option::inside(0, 1).contains(1.0));
  EXPECT_TRUE(option::zero_or(2, 9).contains(0.0));
  EXPECT_FALSE(option::zero_or(2, 9).contains(1.0));
}

TEST(OptionTable, InfinityLiesInAnUnboundedRangeUnlessExcluded) {
  EXPECT_TRUE(option::at_least(1).contains(kInfinity));
  EXPECT_TRUE(option::above(0, kUnbounded).contains(kInfinity));
  EXPECT_FALSE(option::inside(0, kUnbounded).contains(kInfinity));
  EXPECT_TRUE(option::inside(0, kUnbounded).contains(std::numeric_limits<double>::max()));
  const OptionRange any{-kUnbounded, kUnbounded};
  EXPECT_TRUE(any.contains(kInfinity) && any.contains(-kInfinity));
  EXPECT_FALSE(any.contains(kNan) || option::at_least(1).contains(kNan));
}

TEST(OptionTable, RangesReadAsSentences) {
  EXPECT_EQ(to_string(OptionRange{0.000001, 100000}), "0.000001 .. 100000");
  EXPECT_EQ(to_string(option::above(0, 1)), "above 0 and at most 1");
  EXPECT_EQ(to_string(option::below(0, 0.5)), "at least 0 and below 0.5");
  EXPECT_EQ(to_string(option::inside(0.5, 1)), "above 0.5 and below 1");
  EXPECT_EQ(to_string(option::zero_or(2, 9)), "0 or 2 .. 9");
  EXPECT_EQ(to_string(option::at_least(1)), "at least 1");
  EXPECT_EQ(to_string(option::above(0, kUnbounded)), "above 0");
  EXPECT_EQ(to_string(option::inside(0, kUnbounded)), "above 0 and finite");
  EXPECT_EQ(to_string(option::below(0, kUnbounded)), "at least 0 and finite");
  EXPECT_EQ(to_string(OptionRange{-kUnbounded, 5}), "at most 5");
  EXPECT_EQ(to_string(OptionRange{-kUnbounded, kUnbounded}), "a number");
  std::vector<std::string> texts;
  for (const OptionRow& row : kOuterRows) {
    if (row.kind != OptionKind::kSection) texts.push_back(range_text(row));
  }
  EXPECT_EQ(texts,
            (std::vector<std::string>{"0 or 2 .. 9",
                                      "true, false",
                                      "sweet, sour",
                                      "none or 1 .. 8",
                                      "names",
                                      "numbers by name, each 0 .. 1",
                                      "1 .. 4",
                                      "none or at least 1"}));
}

TEST(OptionTable, APresetGivesItsValuesAndLeavesTheOthers) {
  const auto smap = preset_options<OuterOptions>(PresetName::kSmap);
  EXPECT_EQ(smap.inner.share, 0.25);
  EXPECT_EQ(smap.inner.bound, LogOdds(2.0));
  EXPECT_EQ(smap.number, 0);
  EXPECT_TRUE(smap.is_on);
  EXPECT_EQ(smap.flavour, Flavour::kSweet);
  EXPECT_EQ(smap.range_m, 1.5);
  OuterOptions hypermap{.range_m = 2.0};
  set_preset(option_table(hypermap), PresetName::kHypermap, &hypermap);
  EXPECT_EQ(hypermap.inner.bound, LogOdds(-1.0));
  EXPECT_FALSE(hypermap.is_on);
  EXPECT_EQ(hypermap.range_m, std::nullopt);
  EXPECT_EQ(preset_options<OuterOptions>(PresetName::kDefault).number, 3);
}

TEST(OptionTable, ListedOptionsAreReadAndWrittenByName) {
  OuterOptions options;
  std::vector<std::string> names;
  const auto bound = bind_options(option_table(options), &options);
  names.reserve(bound.size());
  for (const BoundOption& option : bound) names.push_back(option.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"inner.share",
                                      "inner.bound",
                                      "inner.weights",
                                      "seeds",
                                      "number",
                                      "is_on",
                                      "flavour",
                                      "range_m",
                                      "classes",
                                      "shares"}));
  EXPECT_EQ(bound[0].value().scalar(), 0.5);
  bound[0].assign(0.75);
  bound[1].assign(1.0);
  const double weights[] = {3.0, 4.0};
  bound[2].assign(OptionValue(OptionValue::Numbers(weights)));
  bound[6].assign(Flavour::kSweet);
  EXPECT_TRUE(bound[7].value().is_none());
  bound[7].assign(2.0);
  const std::vector<std::string> classes{"cup"};
  bound[8].assign(OptionValue(OptionValue::Names(classes)));
  const std::vector<NamedNumber> shares{{"cup", 0.25}};
  bound[9].assign(OptionValue(OptionValue::NamedNumbers(shares)));
  EXPECT_EQ(options.inner.share, 0.75);
  EXPECT_EQ(options.inner.bound, LogOdds(1.0));
  EXPECT_EQ(options.inner.weights, (std::array<double, 2>{3.0, 4.0}));
  EXPECT_EQ(options.flavour, Flavour::kSweet);
  EXPECT_EQ(options.range_m, 2.0);
  EXPECT_EQ(options.classes, classes);
  EXPECT_EQ(options.shares, shares);
  EXPECT_EQ(bound[9].value().named_numbers().size(), 1U);
}

}  // namespace
}  // namespace hypermap
