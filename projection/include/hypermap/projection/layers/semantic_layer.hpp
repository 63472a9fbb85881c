// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Named shapes in the plane, found by place and by name.
///
/// Source: [hypermap] 2.5.3 (R-trees), 3.3.3 (semantic layer).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

inline constexpr std::string_view kSemanticLayerClass = "SemanticLayer";

struct SemanticUpdate;
struct SemanticUpdateReport;

/// An object with a name and a shape.
struct SemanticObject {
  std::uint64_t id = 0;             ///< Unique in its layer.
  std::string name = {};            ///< The class as text; not unique.
  std::vector<Polygon> parts = {};  ///< The shape: one polygon, or several disjoint ones.
  std::vector<std::string> tags = {};
  std::vector<double> confidence = {};  ///< In [0, 1]: one for the object, or one per tag.
  /// The shape as its file wrote it (a ring wound more than once, an unclosed one); saved again as
  /// long as it still stands for `parts`, so that only edited shapes are rewritten.
  std::string shape_text = {};
  /// Unknown keys of its file, as a map; null when there are none.
  ValueTree extra = {};

  friend bool operator==(const SemanticObject&, const SemanticObject&) = default;
};

/// The confidence in the object: its only one, or the largest of its tags; none when unsaid.
[[nodiscard]] std::optional<double> confidence_of(const SemanticObject& object);
/// Centroid of the area of all parts; the object's position. Source: [hypermap] 3.3.3.
[[nodiscard]] Eigen::Vector2d position_of(const SemanticObject& object);
/// The smallest rectangle around all parts.
[[nodiscard]] Rect bounds_of(const SemanticObject& object);

/// A set of objects with an R-tree over their bounds. A value: copying copies the objects and the
/// tree. Frame: that of the hypermap layer that holds it. An edit that fails, also for want of
/// memory, leaves the layer as it was; one that ended within the tree costs the next questions a
/// look at all objects.
///
/// As a layer: its string is the object's name, asked for in any spelling of it, its integer the
/// object's id, its position the centroid.
class SemanticLayer final : public MapLayer {
 public:
  static constexpr std::size_t kMaxObjects = 1'000'000;
  static constexpr std::size_t kMaxNameBytes = 256;

  SemanticLayer();
  SemanticLayer(const SemanticLayer& other);
  SemanticLayer(SemanticLayer&& other) noexcept;
  SemanticLayer& operator=(const SemanticLayer& other);
  SemanticLayer& operator=(SemanticLayer&& other) noexcept;
  ~SemanticLayer() override;

  /// A layer of these objects, packed at once: O(n log n).
  /// Errors: as add, naming the index of the object.
  [[nodiscard]] static Result<SemanticLayer> create(std::vector<SemanticObject> objects);

  /// Errors: kInvalidArgument when the id is taken, the name empty or over 256 bytes, parts are
  /// missing, a confidence is outside [0, 1], or several confidences are not one per tag; kLimit
  /// beyond kMaxObjects.
  [[nodiscard]] Result<void> add(SemanticObject object);
  /// Replaces the object of the same id. Errors: kNotFound; as add.
  [[nodiscard]] Result<void> replace(SemanticObject object);
  /// Whether there was one.
  bool erase(std::uint64_t id);
  /// All changes of an update, or none (semantic_update.hpp). Source: [hypermap] 3.3.4.
  ///
  /// Errors, naming the object: kInvalidArgument when an id stands more than once in the update, an
  /// added one is that of an object of the layer, a polygon is none (make_polygon), or as add;
  /// kNotFound when an object that is to be modified or deleted is not there; kLimit.
  /// Cost: O(k log n) for k objects of the update in a layer of n; objects whose ids lie above the
  /// lowest deleted or added one move within their list, the tree stays.
  [[nodiscard]] Result<SemanticUpdateReport> apply(const SemanticUpdate& update);

  /// One more than the largest id; 0 when empty.
  [[nodiscard]] std::uint64_t next_id() const;
  /// In the order of their ids.
  [[nodiscard]] std::span<const SemanticObject> objects() const;
  [[nodiscard]] const SemanticObject* find(std::uint64_t id) const;

  /// Ids, ascending, of the objects that hold the point (edges included).
  [[nodiscard]] std::vector<std::uint64_t> at(const Eigen::Vector2d& point) const;
  /// Ids, ascending, of the objects that meet the area (touching included).
  [[nodiscard]] std::vector<std::uint64_t> in(const Polygon& area) const;
  /// Ids, ascending, of the objects of that very name.
  [[nodiscard]] std::vector<std::uint64_t> named(std::string_view name) const;
  /// Ids, ascending, of the objects whose name is a spelling of that one (`is_spelling_of`).
  [[nodiscard]] std::vector<std::uint64_t> of_class(std::string_view name) const;

  [[nodiscard]] std::string_view class_name() const override { return kSemanticLayerClass; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  /// Objects of the update replace those of their ids; the others are added.
  /// Source: [hypermap] 3.3.4 (SemanticMapUpdate). Errors: as MapLayer; kLimit.
  [[nodiscard]] Result<LayerContent> updated(const LayerContent& update) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const SemanticLayer& a, const SemanticLayer& b);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap
