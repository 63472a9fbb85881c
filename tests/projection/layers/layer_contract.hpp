// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What holds for every type of layer, and a small type of a program's own.
#pragma once

#include "hypermap/projection/layers/layer_members.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <set>
#include <string>
#include <vector>

namespace hypermap::test {

inline std::vector<std::uint64_t> ids_of(const MapLayer& layer, const LayerQuery& query) {
  const auto answers = layer.query(query);
  EXPECT_TRUE(answers) << (answers ? "" : to_string(answers.error()));
  std::vector<std::uint64_t> ids;
  if (answers) {
    for (const LayerAnswer& answer : *answers) ids.push_back(answer.id);
  }
  return ids;
}

/// Those of `all` that pass.
template <class Passes>
std::vector<std::uint64_t> filtered(const std::vector<LayerAnswer>& all, const Passes& passes) {
  std::vector<std::uint64_t> ids;
  for (const LayerAnswer& answer : all) {
    if (passes(answer)) ids.push_back(answer.id);
  }
  return ids;
}

inline Polygon rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}).value();
}

inline PlanPoint place_of(const LayerAnswer& answer) {
  return {.xy = answer.position, .z = answer.z_m};
}

/// Every query is the filter that it says it is, of all that the layer has.
inline void expect_queries_to_be_filters(const MapLayer& layer) {
  const auto all = layer.query({}).value();
  for (const LayerAnswer& one : all) {
    EXPECT_EQ(ids_of(layer, {.value = one.value}),
              filtered(all, [&](const auto& answer) { return answer.value == one.value; }));
    if (one.name == "unknown") continue;
    const auto named = filtered(all, [&](const auto& answer) { return answer.name == one.name; });
    EXPECT_EQ(ids_of(layer, {.text = one.name}), named);
    const auto here = ids_of(layer, {.at = place_of(one)});
    EXPECT_TRUE(std::set(here.begin(), here.end()).contains(one.id)) << one.id;
    std::vector<std::uint64_t> named_here;
    for (const std::uint64_t id : here) {
      if (std::set(named.begin(), named.end()).contains(id)) named_here.push_back(id);
    }
    EXPECT_EQ(ids_of(layer, {.text = one.name, .at = place_of(one)}), named_here);
  }
  EXPECT_TRUE(ids_of(layer, {.text = "no such thing"}).empty());
}

/// Answers lie within the bounds; beyond them there is nothing.
inline void expect_bounds_to_hold_all(const MapLayer& layer) {
  const auto bounds = layer.statistics().bounds;
  const auto all = layer.query({}).value();
  ASSERT_EQ(bounds.has_value(), !all.empty());
  if (!bounds) return;
  for (const LayerAnswer& answer : all) {
    EXPECT_EQ(answer.z_m.has_value(), !layer.is_flat());
    const Eigen::Vector3d place(answer.position.x(), answer.position.y(), answer.z_m.value_or(0.0));
    EXPECT_LT(bounds->exteriorDistance(place), 1e-9) << answer.id;
  }
  const Eigen::Vector2d low = bounds->min().head<2>();
  const Eigen::Vector2d high = bounds->max().head<2>();
  const Eigen::Vector2d one(1.0, 1.0);
  const auto ids = filtered(all, [](const auto&) { return true; });
  EXPECT_EQ(ids_of(layer, {.area = rectangle(low - one, high + one)}), ids);
  EXPECT_TRUE(ids_of(layer, {.at = PlanPoint{low - one}}).empty());
  EXPECT_TRUE(ids_of(layer, {.at = PlanPoint{high + one}}).empty());
  EXPECT_TRUE(ids_of(layer, {.area = rectangle(high + one, high + 2.0 * one)}).empty());
  for (std::size_t i = 1; i < ids.size(); ++i) EXPECT_LT(ids[i - 1], ids[i]);
}

inline void expect_layer_contract(const MapLayer& layer) {
  expect_queries_to_be_filters(layer);
  expect_bounds_to_hold_all(layer);
  EXPECT_TRUE(layer.equals(layer));
  EXPECT_FALSE(layer.class_name().empty());
  EXPECT_GE(layer.version(), 1);
  if (layer.statistics().bounds) {
    EXPECT_FALSE(layer.draw().empty());
  }
}

/// One number at the origin: the smallest type of layer that a program may add.
class NumberLayer final : public MapLayer {
 public:
  static constexpr int kVersion = 3;

  NumberLayer() = default;
  explicit NumberLayer(int number) : number_(number) {}

  static Result<LayerContent> load(LayerReader& reader) {
    HYPERMAP_ASSIGN_OR_RETURN(const ValueTree tree, reader.yaml(".yaml"));
    const ValueTree* number = tree.find("number");
    int value = 0;
    const auto end = number == nullptr ? nullptr : number->text.data() + number->text.size();
    if (number == nullptr || std::from_chars(number->text.data(), end, value).ptr != end)
      return fail(ErrorCode::kMalformedFile, "must be an integer", "number");
    return LayerContent(NumberLayer(value));
  }

  [[nodiscard]] std::string_view class_name() const override { return "NumberLayer"; }
  [[nodiscard]] int version() const override { return kVersion; }
  [[nodiscard]] LayerStatistics statistics() const override {
    LayerStatistics statistics{.num_values = number_ ? 1U : 0U};
    if (number_) statistics.bounds = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
    return statistics;
  }
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override {
    if (!number_) return std::vector<LayerAnswer>{};
    const LayerAnswer answer{.id = 0, .name = std::to_string(*number_), .value = *number_};
    const bool here = (!query.at || query.at->xy.isZero()) &&
                      (!query.area || contains(*query.area, Eigen::Vector2d::Zero()));
    if (!here || !has_representation(answer, query)) return std::vector<LayerAnswer>{};
    return std::vector<LayerAnswer>{answer};
  }
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override {
    if (!number_) return {};
    return {DrawnText{.position = {0, 0}, .text = std::to_string(*number_), .color = {}}};
  }
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override {
    return writer.yaml(".yaml", make_map({{"number", make_number(number_.value_or(0))}}));
  }
  [[nodiscard]] bool equals(const MapLayer& other) const override {
    return is_same_layer(*this, other);
  }
  friend bool operator==(const NumberLayer& a, const NumberLayer& b) {
    return a.number_ == b.number_;
  }

 private:
  std::optional<int> number_;
};

}  // namespace hypermap::test
