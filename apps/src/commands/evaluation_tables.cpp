// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_texts.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"
#include "voxel_texts.hpp"

#include <string>
#include <vector>

namespace hypermap::app {
namespace {

std::vector<std::string> object_row(const std::string& name, const ClassMetrics& metrics) {
  const OneToOneMetric& one = metrics.one_to_one;
  return {printable(name),
          std::to_string(one.num_truth),
          std::to_string(one.num_map),
          fixed(one.precision, 2),
          fixed(one.recall, 2),
          fixed(one.f1, 2),
          fixed(one.distance_m, 3),
          fixed(one.jaccard_in_place, 2),
          fixed(one.box_iou, 2),
          fixed(one.footprint_covered, 2),
          std::to_string(one.duplicates),
          fixed(metrics.nearest.distance_m, 3),
          fixed(metrics.nearest.jaccard, 2)};
}

std::string object_table(const EvaluationReport& report) {
  Table table({"class",
               "truths",
               "found",
               "precision",
               "recall",
               "F1",
               "distance m",
               "Jaccard",
               "box IoU",
               "covered",
               "duplicates",
               "thesis: distance m",
               "thesis: Jaccard"});
  for (const auto& [name, metrics] : report.classes) table.add(object_row(name, metrics));
  table.add(object_row("all", report.all));
  return table.text();
}

std::string object_remarks(const EvaluationOutcome& outcome) {
  const OneToOneMetric& one = outcome.report.all.one_to_one;
  std::string text = count_text(one.excluded, "true object") + " excluded, " +
                     std::to_string(one.rarely_seen) + " of them rarely seen";
  if (!outcome.knows_frames_named)
    text += " (the truth does not tell how often they were named: only 200 depth pixels are asked)";
  text += "; Jaccard in place over " + count_text(one.num_judged, "footprint") + " of " +
          fixed(EvaluationOptions{}.min_judged_area_m2, 2) + " m2 and more, worst " +
          fixed(one.worst_jaccard_in_place, 2) + "; over the " + std::to_string(one.num_seen) +
          " of them half seen " + fixed(one.seen_jaccard_in_place, 2) + "\n";
  return text;
}

std::string voxel_table(const VoxelEvaluation& voxels) {
  Table table(voxel_headings());
  for (const auto& [name, counts] : voxels.classes) table.add(voxel_row(name, counts));
  table.add(voxel_row(voxels.all));
  return table.text();
}

std::string voxel_text(const EvaluationOutcome& outcome) {
  if (!outcome.voxels) return "voxel labels are not evaluated: " + outcome.why_no_voxels + "\n";
  std::string text = voxel_table(outcome.voxels->labels);
  text += "of the labelled voxels " + fixed(outcome.voxels->labels.all.wrong_class_share(), 3) +
          " bear a wrong class; of the surface that was seen " +
          fixed(outcome.voxels->surface_covered, 2) + " is occupied in the map\n";
  return text;
}

std::string occupancy_text(const GridAgreement& grid) {
  return "of the free cells of the occupancy layer " + fixed(grid.free_precision(), 3) +
         " are free in truth, of the truly free ones " + fixed(grid.free_recall(), 3) +
         " are found; of the occupied ones " + fixed(grid.occupied_precision(), 3) +
         " are right to a cell, " + fixed(grid.occupied_recall(), 3) + " are found, " +
         count_text(grid.occupied_free, "cell") +
         " that are occupied in truth are free in the map\n";
}

std::string relation_table(const RelationEvaluation& relations) {
  Table table({"relation", "right", "in the map", "true", "precision", "recall"});
  for (const RelationKind kind : kRelationKinds) {
    const RelationCounts& counts = relations.of(kind);
    if (counts.num_map + counts.num_truth == 0) continue;
    table.add({std::string(name_of(kind)),
               std::to_string(counts.right),
               std::to_string(counts.num_map),
               std::to_string(counts.num_truth),
               fixed(counts.precision(), 2),
               fixed(counts.recall(), 2)});
  }
  return table.text();
}

std::string calibration_text(const std::string& name, const CalibrationReport& report) {
  if (!report.expected_error) return name + ": nothing to calibrate\n";
  return name + ": expected calibration error " + fixed(report.expected_error, 3) +
         " (95 %: " + fixed(report.error_low, 3) + " .. " + fixed(report.error_high, 3) +
         "), log loss " + fixed(report.log_loss, 3) + ", over " + count_text(report.n, "object") +
         "\n";
}

std::string comparison_text(const MapComparison& comparison) {
  return "against the other map (Wilcoxon, one-sided): p = " + fixed(comparison.jaccard.p, 4) +
         " that this map's Jaccard is greater by chance, p = " + fixed(comparison.distance.p, 4) +
         " that its distance is smaller by chance\n";
}

}  // namespace

std::string table_text_of(const EvaluationOutcome& outcome) {
  std::string text = object_table(outcome.report);
  text += object_remarks(outcome);
  text += voxel_text(outcome);
  if (outcome.occupancy) text += occupancy_text(*outcome.occupancy);
  if (outcome.relations) text += relation_table(*outcome.relations);
  text += calibration_text("P(best class)", outcome.best_class);
  text += calibration_text("P(real)", outcome.real);
  if (outcome.against) text += comparison_text(*outcome.against);
  return text;
}

}  // namespace hypermap::app
