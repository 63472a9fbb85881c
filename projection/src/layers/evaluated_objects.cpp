// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <charconv>
#include <optional>
#include <system_error>

namespace hypermap {
namespace {

/// Largest side of the box in the extra keys; none when there is no such box.
std::optional<double> largest_side_m(const SemanticObject& object) {
  const ValueTree* box = object.extra.find("box");
  if (box == nullptr || box->items.size() != 6) return std::nullopt;
  Eigen::Matrix<double, 6, 1> numbers;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string& text = box->items[i].text;
    double& number = numbers[static_cast<Eigen::Index>(i)];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  }
  return (numbers.tail<3>() - numbers.head<3>()).maxCoeff();
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
  result.size_m = largest_side_m(object).value_or((rect.max - rect.min).maxCoeff());
  return result;
}

}  // namespace

std::vector<EvaluatedObject> evaluated_objects(const SemanticLayer& layer) {
  std::vector<EvaluatedObject> objects;
  for (const SemanticObject& object : layer.objects()) objects.push_back(evaluated(object));
  return objects;
}

}  // namespace hypermap
