// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/evaluation_job.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Squares of half a metre, a chair each, their lower left corners at these x.
SemanticLayer chairs_at(const std::vector<double>& places) {
  SemanticLayer layer;
  for (const double x : places) {
    const Polygon square = make_polygon({{x, 0}, {x + 0.5, 0}, {x + 0.5, 0.5}, {x, 0.5}}).value();
    EXPECT_TRUE(layer.add({.id = layer.next_id(), .name = "chair", .parts = {square}}));
  }
  return layer;
}

class EvaluationJobTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path saved(const std::string& name,
                                            LayerContent content,
                                            const std::string& frame_id = "map") const {
    MapArchive archive;
    EXPECT_TRUE(archive.hypermap.add_layer(
        {{.name = "semantic", .frame_id = frame_id}, std::move(content)}));
    EXPECT_TRUE(save_archive(archive, dir / name));
    return dir / name;
  }

  test::TempDir dir;
};

TEST_F(EvaluationJobTest, TwoArchivesAreComparedWithAThird) {
  const auto truth = saved("truth.hmap", chairs_at({0, 2, 4}));
  const auto near = saved("near.hmap", chairs_at({0.1, 2.1}));
  const auto far = saved("far.hmap", chairs_at({0.2, 2.2, 4.2}));
  const auto outcome = run_evaluation({.map = near, .truth = truth, .against = far}).value();
  EXPECT_DOUBLE_EQ(*outcome.report.all.one_to_one.precision, 1.0);
  EXPECT_DOUBLE_EQ(*outcome.report.all.one_to_one.recall, 2.0 / 3.0);
  EXPECT_NEAR(*outcome.report.all.one_to_one.distance_m, 0.1, 1e-9);
  ASSERT_TRUE(outcome.against);
  // The third truth lies 1.9 m from the near map's second chair, 0.2 m from the far map's third.
  // Differences of distance 0.1, 0.1 and -1.7: the positive ones share the ranks 1 and 2.
  EXPECT_NEAR(outcome.against->distance.rank_sum, 3.0, 1e-9);
  EXPECT_FALSE(run_evaluation({.map = near, .truth = truth}).value().against);
}

TEST_F(EvaluationJobTest, AClassThatNeitherHasIsNotFound) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const EvaluationJob job{.map = truth, .truth = truth, .options = {.classes = {"chiar"}}};
  const auto refused = run_evaluation(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(refused.error().field, "classes");
}

TEST_F(EvaluationJobTest, ALayerOfAnotherFrameThanTheTruthIsRefused) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const auto moved = saved("moved.hmap", chairs_at({0}), "lab");
  for (const EvaluationJob& job : {EvaluationJob{.map = moved, .truth = truth},
                                   EvaluationJob{.map = truth, .truth = truth, .against = moved}}) {
    const auto refused = run_evaluation(job);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
    EXPECT_EQ(refused.error().file, moved.string());
    EXPECT_EQ(refused.error().what, "is in frame lab, must be in that of the truth: map");
  }
  EXPECT_TRUE(run_evaluation({.map = moved, .truth = moved}));
}

TEST_F(EvaluationJobTest, ALayerMustBeThereAndHaveShapes) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const GridGeometry one_cell{.resolution_m = 0.05, .cols = 1, .rows = 1};
  const auto grid =
      saved("grid.hmap",
            OccupancyLayer(OccupancyGrid::create(one_cell, std::vector<std::int8_t>{0}).value()));
  const auto absent = run_evaluation({.map = truth, .truth = truth, .layer = "smells"});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(absent.error().file, truth.string());
  const auto flat = run_evaluation({.map = grid, .truth = truth});
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(flat.error().file, grid.string());
}

TEST_F(EvaluationJobTest, BadOptionsAreSaidFirst) {
  const auto refused =
      run_evaluation({.map = "absent", .truth = "absent", .options = {.gate_m = 0.0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

/// A map with the object of `class_name` at x = 0 .. 0.5, confirmed, and its voxels, one of them
/// labelled.
MapArchive chair_map(const std::string& class_name) {
  MapArchive archive;
  const ClassId id = archive.classes.add(class_name).value();
  SemanticLayer layer;
  const Polygon square = make_polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}).value();
  EXPECT_TRUE(layer.add({.id = 1, .name = class_name, .parts = {square}}));
  EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, layer}));
  Object object;
  object.id = ObjectId{1};
  object.box = {{0, 0, 0}, {0.5, 0.5, 1.0}};
  object.centroid_in_map = {0.25, 0.25, 0.5};
  object.belief.observe(std::vector<ClassEvidence>{{id, Probability(0.9)}}, Probability(0.5));
  object.existence = LogOdds(0.0);
  Object tentative = object;
  tentative.id = ObjectId{2};
  tentative.centroid_in_map.x() = 7.0;
  archive.objects = ObjectMap::restore({object, tentative}, ObjectId{3}).value();
  archive.octree = SemanticOctree::create({.resolution_m = 0.1}).value();
  VoxelLabel label;
  label.classes[0] = {.class_id = static_cast<std::uint16_t>(id.value), .log_odds = 1000};
  label.object = object.id;
  label.object_votes = 1;
  const VoxelGrid& grid = archive.octree->grid();
  EXPECT_TRUE(archive.octree->set_leaf(
      {.key = *grid.key({{0.25, 0.25, 0.05}}), .log_odds = 1000, .label = label}));
  EXPECT_TRUE(archive.octree->set_leaf({.key = *grid.key({{0.35, 0.25, 0.05}}), .log_odds = 1000}));
  return archive;
}

/// Its truth: a chair of the same place, whose seat is a sheet on the floor.
MapArchive chair_truth() {
  MapArchive archive;
  SemanticLayer layer;
  const Polygon square = make_polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}).value();
  std::vector<ValueTree> box;
  for (const double side : {0.0, 0.0, 0.0, 0.5, 0.5, 0.5}) box.push_back(make_number(side));
  EXPECT_TRUE(layer.add(
      {.id = 1,
       .name = "chair",
       .parts = {square},
       .extra = make_map({{"box", make_list(std::move(box))}, {"frames_named", make_number(4)}})}));
  EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, layer}));
  archive.true_surfaces = TrueSurfaces{
      .seen_cell_m = 0.1,
      .objects = {{.id = ObjectId{1},
                   .class_name = "chair",
                   .vertices = {{0, 0, 0}, {0.5F, 0, 0}, {0.5F, 0.5F, 0}, {0, 0.5F, 0}},
                   .triangles = {{0, 1, 2}, {0, 2, 3}},
                   .seen_cells = {{0, 0, 0}, {2, 2, 0}}}}};
  return archive;
}

TEST_F(EvaluationJobTest, VoxelsBoxesAndBeliefsAreComparedToo) {
  EXPECT_TRUE(save_archive(chair_map("chair"), dir / "map.hmap"));
  EXPECT_TRUE(save_archive(chair_truth(), dir / "truth.hmap"));
  const auto outcome =
      run_evaluation({.map = dir / "map.hmap", .truth = dir / "truth.hmap"}).value();
  ASSERT_TRUE(outcome.voxels);
  EXPECT_EQ(outcome.why_no_voxels, "");
  EXPECT_DOUBLE_EQ(*outcome.voxels->labels.all.precision(), 1.0);
  EXPECT_DOUBLE_EQ(*outcome.voxels->labels.all.recall(), 0.5);
  EXPECT_DOUBLE_EQ(*outcome.voxels->surface_covered, 0.5);
  EXPECT_TRUE(outcome.knows_frames_named);
  EXPECT_DOUBLE_EQ(*outcome.report.all.one_to_one.box_iou, 0.5);  // 1 m high instead of 0.5 m
  // Of two objects that may be there or not one is: P(real) = 0.5 of both is right.
  EXPECT_EQ(outcome.real.n, 2U);
  EXPECT_NEAR(*outcome.real.expected_error, 0.0, 1e-12);
  EXPECT_EQ(outcome.best_class.n, 1U);
  EXPECT_NEAR(*outcome.best_class.expected_error, 0.0, 1e-12);
}

TEST_F(EvaluationJobTest, AnotherClassIsAWrongLabelAndAWrongBelief) {
  EXPECT_TRUE(save_archive(chair_map("sofa"), dir / "map.hmap"));
  EXPECT_TRUE(save_archive(chair_truth(), dir / "truth.hmap"));
  const auto outcome =
      run_evaluation({.map = dir / "map.hmap", .truth = dir / "truth.hmap"}).value();
  EXPECT_DOUBLE_EQ(*outcome.voxels->labels.all.precision(), 0.0);
  EXPECT_DOUBLE_EQ(*outcome.voxels->labels.all.wrong_class_share(), 1.0);
  EXPECT_EQ(outcome.voxels->labels.classes.at("chair").most_confused_for(), "sofa");
  // Its box overlaps the truth's by a half, so it is real, and surely no sofa.
  EXPECT_NEAR(*outcome.real.expected_error, 0.0, 1e-12);
  EXPECT_NEAR(*outcome.best_class.expected_error, 1.0, 1e-12);
}

TEST_F(EvaluationJobTest, AliasesAreOneClassInObjectsVoxelsAndBeliefs) {
  const ClassVocabulary words =
      ClassVocabulary::create({.aliases = {{{"chair"}, {{"stool"}}}},
                               .super_classes = {{{"seat"}, {{"chair"}}}, {{"tool"}, {{"saw"}}}}})
          .value();
  MapArchive map = chair_map("stool");
  EXPECT_TRUE(save_archive(map, dir / "plain.hmap"));
  map.vocabulary = words;
  EXPECT_TRUE(save_archive(map, dir / "map.hmap"));
  EXPECT_TRUE(save_archive(chair_truth(), dir / "truth.hmap"));
  const EvaluationJob without{.map = dir / "plain.hmap", .truth = dir / "truth.hmap"};
  const EvaluationJob kept{.map = dir / "map.hmap", .truth = dir / "truth.hmap"};
  EvaluationJob given = without;
  given.vocabulary = words;
  const auto apart = run_evaluation(without).value();
  EXPECT_EQ(apart.report.all.one_to_one.matched, 0U);
  EXPECT_DOUBLE_EQ(*apart.voxels->labels.all.precision(), 0.0);
  EXPECT_NEAR(*apart.best_class.expected_error, 1.0, 1e-12);
  for (const EvaluationJob& job : {kept, given}) {
    const auto outcome = run_evaluation(job).value();
    EXPECT_EQ(outcome.report.all.one_to_one.matched, 1U);
    EXPECT_TRUE(outcome.report.classes.contains("chair"));
    EXPECT_FALSE(outcome.report.classes.contains("stool"));
    EXPECT_DOUBLE_EQ(*outcome.voxels->labels.all.precision(), 1.0);
    EXPECT_NEAR(*outcome.best_class.expected_error, 0.0, 1e-12);
    EXPECT_EQ(outcome.objects.at(0).class_name, "chair");
  }
  EvaluationJob seats = kept;
  seats.options.classes = {"seat"};
  EXPECT_EQ(run_evaluation(seats).value().report.all.one_to_one.matched, 1U);
  seats.options.classes = {"tool"};
  EXPECT_EQ(run_evaluation(seats).error().field, "classes");
}

TEST_F(EvaluationJobTest, FurtherPairsCountInTheCalibrationAlone) {
  EXPECT_TRUE(save_archive(chair_map("chair"), dir / "map.hmap"));
  EXPECT_TRUE(save_archive(chair_map("sofa"), dir / "sofa.hmap"));
  EXPECT_TRUE(save_archive(chair_truth(), dir / "truth.hmap"));
  const auto outcome = run_evaluation({.map = dir / "map.hmap",
                                       .truth = dir / "truth.hmap",
                                       .also = {{dir / "sofa.hmap", dir / "truth.hmap"}}})
                           .value();
  EXPECT_EQ(outcome.report.all.one_to_one.num_map, 1U);
  EXPECT_EQ(outcome.real.n, 4U);
  EXPECT_EQ(outcome.best_class.n, 2U);
  EXPECT_NEAR(*outcome.best_class.expected_error, 0.5, 1e-12);
}

TEST_F(EvaluationJobTest, AnOlderTruthStillServesAndItIsSaidWhatIsNotEvaluated) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  EXPECT_TRUE(save_archive(chair_map("chair"), dir / "map.hmap"));
  const auto outcome = run_evaluation({.map = dir / "map.hmap", .truth = truth}).value();
  EXPECT_FALSE(outcome.voxels);
  EXPECT_EQ(outcome.why_no_voxels,
            "the truth has no surfaces: it is an older one, or made by hand");
  EXPECT_FALSE(outcome.knows_frames_named);
  EXPECT_EQ(outcome.report.all.one_to_one.matched, 1U);
  MapArchive flat = chair_map("chair");
  flat.octree.reset();
  EXPECT_TRUE(save_archive(flat, dir / "flat.hmap"));
  EXPECT_TRUE(save_archive(chair_truth(), dir / "new.hmap"));
  EXPECT_EQ(
      run_evaluation({.map = dir / "flat.hmap", .truth = dir / "new.hmap"}).value().why_no_voxels,
      "the map has no octree");
}

TEST_F(EvaluationJobTest, SemanticFilesAreMapsAndTruthsOfAnyFrame) {
  const auto write = [&](const std::string& name, const SemanticLayer& layer) {
    std::ofstream(dir / name) << write_semantic_layer(layer);
    return dir / name;
  };
  const auto truth = write("truth.yaml", chairs_at({0, 2}));
  const auto map = write("map.yaml", chairs_at({0.1}));
  const auto lab = saved("lab.hmap", chairs_at({0.1, 2.1}), "lab");
  const auto bare = run_evaluation({.map = map, .truth = truth, .against = lab});
  ASSERT_TRUE(bare) << to_string(bare.error());
  EXPECT_DOUBLE_EQ(*bare->report.all.one_to_one.recall, 0.5);
  EXPECT_NEAR(*bare->report.all.one_to_one.distance_m, 0.1, 1e-9);
  EXPECT_TRUE(bare->against);
  EXPECT_DOUBLE_EQ(
      *run_evaluation({.map = lab, .truth = truth}).value().report.all.one_to_one.recall, 1.0);
  EXPECT_TRUE(run_evaluation({.map = map, .truth = lab}));
  std::ofstream(dir / "bad.yaml") << "- name: chair\n  shape: POLYGON((0 0, 1 1))\n";
  const auto refused = run_evaluation({.map = dir / "bad.yaml", .truth = truth});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().file, (dir / "bad.yaml").string());
  EXPECT_EQ(refused.error().line, 2);
}

}  // namespace
}  // namespace hypermap
