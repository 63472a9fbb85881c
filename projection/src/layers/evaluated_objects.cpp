// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace hypermap {
namespace {

constexpr double kMaxFrames = 1e9;

std::optional<double> number_in(const ValueTree& tree) {
  const std::string& text = tree.text;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

/// The number that an extra key gives; none when it is absent, no number or out of the range.
std::optional<double> extra_number(const SemanticObject& object,
                                   std::string_view key,
                                   double low,
                                   double high) {
  const ValueTree* tree = object.extra.find(key);
  const auto number = tree == nullptr ? std::nullopt : number_in(*tree);
  return number && *number >= low && *number <= high ? number : std::nullopt;
}

/// The box in the extra keys; none when there is no such box.
std::optional<Box> extra_box(const SemanticObject& object) {
  const ValueTree* box = object.extra.find("box");
  if (box == nullptr || box->items.size() != 6) return std::nullopt;
  Eigen::Matrix<double, 6, 1> numbers;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto number = number_in(box->items[i]);
    if (!number) return std::nullopt;
    numbers[static_cast<Eigen::Index>(i)] = *number;
  }
  const Box result{numbers.head<3>(), numbers.tail<3>()};
  return (result.extent().array() >= 0.0).all() ? std::optional(result) : std::nullopt;
}

/// One polygon for the whole shape.
Polygon outline(const SemanticObject& object) {
  if (object.parts.size() == 1) return object.parts.front();
  std::vector<Eigen::Vector2d> points;
  for (const Polygon& part : object.parts)
    points.insert(points.end(), part.outer.begin(), part.outer.end());
  return convex_hull(points).value_or(object.parts.front());
}

EvaluatedObject evaluated(const SemanticObject& object) {
  const Rect rect = bounds_of(object);
  EvaluatedObject result;
  result.class_name = object.name;
  result.centroid = position_of(object);
  result.footprint = outline(object);
  result.excluded = object.extra.find("excluded") != nullptr;
  result.box = extra_box(object);
  result.size_m = result.box ? result.box->extent().maxCoeff() : (rect.max - rect.min).maxCoeff();
  const ValueTree* nameable = object.extra.find("nameable");
  result.is_nameable = nameable == nullptr || nameable->text != "false";
  if (const auto count = extra_number(object, "frames_named", 0.0, kMaxFrames))
    result.frames_named = static_cast<std::size_t>(*count);
  result.seen_footprint_share = extra_number(object, "seen_footprint", 0.0, 1.0);
  return result;
}

}  // namespace

std::vector<EvaluatedObject> evaluated_objects(const SemanticLayer& layer) {
  std::vector<EvaluatedObject> objects;
  for (const SemanticObject& object : layer.objects()) objects.push_back(evaluated(object));
  return objects;
}

}  // namespace hypermap
