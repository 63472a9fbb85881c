// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_palette.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hypermap {
namespace {

struct CommonClass {
  std::string_view canonical_name;
  Rgb8 color;
};

// Found by a search: the first 12 maximise the smallest difference in both visions, the others are
// each the farthest from all before them.
constexpr std::array<CommonClass, 24> kCommonClasses{{
    {"chair", {215, 120, 15}},       {"diningtable", {0, 175, 255}},  {"tvmonitor", {75, 110, 215}},
    {"pottedplant", {55, 165, 105}}, {"keyboard", {95, 60, 120}},     {"mouse", {190, 25, 25}},
    {"laptop", {10, 0, 250}},        {"book", {255, 195, 0}},         {"cup", {250, 180, 255}},
    {"bottle", {155, 215, 150}},     {"sofa", {175, 35, 100}},        {"person", {40, 80, 30}},
    {"bed", {175, 100, 190}},        {"refrigerator", {0, 125, 155}}, {"sink", {155, 155, 210}},
    {"toilet", {255, 190, 125}},     {"microwave", {245, 115, 105}},  {"oven", {125, 60, 5}},
    {"bowl", {135, 135, 55}},        {"bench", {0, 120, 70}},         {"remote", {180, 190, 65}},
    {"cellphone", {155, 0, 170}},    {"vase", {0, 70, 170}},          {"backpack", {160, 100, 80}},
}};

// Each the farthest from all before it for normal eyes, of lightness 30 to 82 and chroma over 30.
constexpr std::array<Rgb8, 64> kOtherColors{{
    {0, 220, 245},   {95, 80, 0},     {255, 35, 125},  {0, 235, 0},     {120, 55, 55},
    {240, 65, 0},    {150, 110, 45},  {135, 70, 255},  {190, 145, 0},   {60, 140, 0},
    {255, 100, 255}, {255, 180, 160}, {115, 105, 160}, {100, 150, 255}, {200, 140, 110},
    {0, 165, 195},   {195, 175, 120}, {245, 10, 65},   {80, 105, 0},    {105, 180, 50},
    {180, 85, 5},    {160, 120, 255}, {155, 200, 255}, {150, 170, 115}, {180, 80, 90},
    {220, 0, 255},   {0, 100, 155},   {255, 125, 65},  {100, 130, 80},  {15, 135, 205},
    {205, 195, 255}, {0, 205, 105},   {255, 155, 0},   {100, 75, 180},  {175, 0, 55},
    {195, 140, 220}, {0, 75, 255},    {175, 140, 90},  {140, 80, 150},  {210, 0, 180},
    {135, 35, 15},   {155, 220, 0},   {0, 90, 65},     {125, 110, 0},   {120, 45, 75},
    {75, 80, 130},   {0, 105, 5},     {120, 85, 40},   {200, 205, 145}, {215, 105, 120},
    {165, 155, 0},   {105, 205, 250}, {225, 205, 0},   {205, 90, 70},   {255, 25, 205},
    {95, 30, 170},   {175, 115, 70},  {125, 155, 0},   {150, 125, 195}, {70, 75, 25},
    {130, 75, 55},   {220, 0, 90},    {190, 120, 110}, {165, 55, 0},
}};

/// FNV-1a: http://www.isthe.com/chongo/tech/comp/fnv
std::uint32_t hash_of(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

Rgb8 color_of_canonical(std::string_view name) {
  const auto* common =
      std::find_if(kCommonClasses.begin(), kCommonClasses.end(), [&](const CommonClass& one) {
        return one.canonical_name == name;
      });
  if (common != kCommonClasses.end()) return common->color;
  return kOtherColors[hash_of(name) % kOtherColors.size()];
}

}  // namespace

std::vector<std::string_view> common_classes() {
  std::vector<std::string_view> names;
  names.reserve(kCommonClasses.size());
  for (const CommonClass& one : kCommonClasses) names.push_back(one.canonical_name);
  return names;
}

Rgb8 class_color(std::string_view class_name) {
  return color_of_canonical(canonical_class_name(class_name));
}

Result<void> ClassPalette::set(std::string_view class_name, Rgb8 color) {
  if (class_name.empty()) return fail(ErrorCode::kInvalidArgument, "must not be empty", "class");
  if (!color_of_canonical_.emplace(canonical_class_name(class_name), color).second) {
    return fail(ErrorCode::kInvalidArgument,
                "must have one colour, has another one already",
                printable(class_name));
  }
  return {};
}

Rgb8 ClassPalette::color_of(std::string_view class_name) const {
  const std::string canonical = canonical_class_name(class_name);
  const auto own = color_of_canonical_.find(canonical);
  return own == color_of_canonical_.end() ? color_of_canonical(canonical) : own->second;
}

std::vector<std::string> ClassPalette::class_names() const {
  std::vector<std::string> names;
  names.reserve(color_of_canonical_.size());
  for (const auto& [name, color] : color_of_canonical_) names.push_back(name);
  return names;
}

std::vector<Rgb8> class_colors(const ClassRegistry& classes, const ClassPalette& palette) {
  std::vector<Rgb8> colors;
  colors.reserve(classes.size());
  for (const std::string& name : classes.names()) colors.push_back(palette.color_of(name));
  return colors;
}

}  // namespace hypermap
