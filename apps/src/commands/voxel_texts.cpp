// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_texts.hpp"

#include "json_numbers.hpp"
#include "tables.hpp"

#include <utility>

namespace hypermap::app {
namespace {

using VoxelJson = nlohmann::ordered_json;

std::string confusion_text(const ClassVoxelCounts& counts) {
  const auto name = counts.most_confused_for();
  if (!name) return "-";
  return printable(*name) + " (" + std::to_string(counts.confused_for.at(*name)) + ")";
}

}  // namespace

std::vector<std::string> voxel_headings() {
  return {"voxels of class",
          "labelled",
          "precision",
          "wrong class",
          "true",
          "recall",
          "unlabelled",
          "most confused for"};
}

std::vector<std::string> voxel_row(const std::string& name, const ClassVoxelCounts& counts) {
  return {printable(name),
          std::to_string(counts.labelled),
          fixed(counts.precision(), 2),
          std::to_string(counts.wrong_class),
          std::to_string(counts.true_voxels),
          fixed(counts.recall(), 2),
          std::to_string(counts.true_unlabelled),
          confusion_text(counts)};
}

std::vector<std::string> voxel_row(const VoxelLabelCounts& all) {
  return {"all",
          std::to_string(all.labelled),
          fixed(all.precision(), 2),
          std::to_string(all.wrong_class),
          std::to_string(all.true_voxels),
          fixed(all.recall(), 2),
          std::to_string(all.true_unlabelled),
          "-"};
}

VoxelJson voxel_json(const ClassVoxelCounts& counts) {
  VoxelJson confused = VoxelJson::object();
  for (const auto& [name, n] : counts.confused_for) confused[name] = n;
  return {{"labelled", counts.labelled},
          {"right", counts.right_labels},
          {"wrong_class", counts.wrong_class},
          {"precision", number_json(counts.precision())},
          {"true", counts.true_voxels},
          {"found", counts.found},
          {"unlabelled", counts.true_unlabelled},
          {"recall", number_json(counts.recall())},
          {"confused_for", std::move(confused)}};
}

VoxelJson voxel_json(const VoxelLabelCounts& all) {
  return {{"labelled", all.labelled},
          {"right", all.right},
          {"wrong_class", all.wrong_class},
          {"precision", number_json(all.precision())},
          {"true", all.true_voxels},
          {"found", all.true_right},
          {"unlabelled", all.true_unlabelled},
          {"recall", number_json(all.recall())}};
}

}  // namespace hypermap::app
