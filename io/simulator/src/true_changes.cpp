// SPDX-License-Identifier: BSD-3-Clause
#include "true_changes.hpp"

#include "hypermap/projection/layers/semantic_layer.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 3> kKindNames{"moved", "removed", "added"};

ValueTree box_numbers(const Box& box) {
  std::vector<ValueTree> numbers;
  for (const Eigen::Vector3d& corner : {box.min_in_map, box.max_in_map}) {
    for (const double coordinate : corner) numbers.push_back(make_number(coordinate));
  }
  return make_list(std::move(numbers));
}

SemanticObject changed_object(const SceneChange& change, std::size_t index) {
  const PlacedObject& object = change.object;
  std::vector<ValueTree::Entry> extra{
      {"thing", make_text(object.name)},
      {"change", make_text(std::string(kKindNames[static_cast<std::size_t>(change.kind)]))},
      {"box", box_numbers(object.box)}};
  if (change.at_end != kNoObject)
    extra.emplace_back("at_end", make_number(static_cast<double>(change.at_end.value)));
  SemanticObject result;
  result.id = index + 1;
  result.name = object.class_name;
  result.parts = {object.footprint};
  result.extra = make_map(std::move(extra));
  return result;
}

}  // namespace

Result<void> add_changes(std::span<const SceneChange> changes, MapArchive& truth) {
  if (changes.empty()) return {};
  std::vector<SemanticObject> objects;
  objects.reserve(changes.size());
  for (const SceneChange& change : changes)
    objects.push_back(changed_object(change, objects.size()));
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer layer, SemanticLayer::create(std::move(objects)));
  return truth.hypermap.add_layer({LayerInfo{.name = "changes"}, std::move(layer)});
}

}  // namespace hypermap
