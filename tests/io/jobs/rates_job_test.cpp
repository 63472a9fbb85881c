// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/rates_job.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Eigen::Vector3d kRatedSize(0.5, 0.5, 0.8);

Polygon rated_square(double x) {
  return make_polygon({{x - 0.25, -0.25}, {x + 0.25, -0.25}, {x + 0.25, 0.25}, {x - 0.25, 0.25}})
      .value();
}

/// Maps and truths of chairs of 0.5 x 0.5 x 0.8 m along the x axis; their number is their id.
class RatesJobTest : public testing::Test {
 protected:
  /// With what the map believes; those in `tentative` are not in the layer.
  [[nodiscard]] std::filesystem::path saved_map(const std::string& name,
                                                const std::vector<double>& confirmed,
                                                const std::vector<double>& tentative = {},
                                                double z = 0.4) const {
    MapArchive archive;
    const ClassId chair = archive.classes.add("chair").value();
    SemanticLayer layer;
    std::vector<Object> objects;
    const auto add = [&](double x) {
      Object object;
      object.id = ObjectId{static_cast<std::uint32_t>(objects.size() + 1)};
      const Eigen::Vector3d centre(x, 0.0, z);
      object.box = {centre - 0.5 * kRatedSize, centre + 0.5 * kRatedSize};
      object.centroid_in_map = centre;
      object.belief.observe(std::vector<ClassEvidence>{{chair, Probability(0.9)}},
                            Probability(0.5));
      objects.push_back(std::move(object));
    };
    for (const double x : confirmed) {
      add(x);
      EXPECT_TRUE(layer.add({.id = objects.size(), .name = "chair", .parts = {rated_square(x)}}));
    }
    for (const double x : tentative) add(x);
    EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, std::move(layer)}));
    archive.objects = ObjectMap::restore(objects, ObjectId{100}).value();
    archive.provenance.push_back(
        {.tool = "hypermap", .input = "room", .input_hash = "xxh3-128:0", .map_from_input = {}});
    EXPECT_TRUE(save_archive(archive, dir / name));
    return dir / name;
  }

  /// Chairs with the boxes that a simulated truth tells; `excluded` do not count.
  [[nodiscard]] std::filesystem::path saved_truth(const std::string& name,
                                                  const std::vector<double>& places,
                                                  const std::vector<double>& excluded = {},
                                                  bool has_boxes = true) const {
    SemanticLayer layer;
    const auto add = [&](double x, bool counts) {
      SemanticObject object{.id = layer.next_id(), .name = "chair", .parts = {rated_square(x)}};
      std::vector<ValueTree::Entry> extra;
      if (has_boxes) extra.emplace_back("box", box_tree(x));
      if (!counts) extra.emplace_back("excluded", make_bool(true));
      if (!extra.empty()) object.extra = make_map(std::move(extra));
      EXPECT_TRUE(layer.add(std::move(object)));
    };
    for (const double x : places) add(x, true);
    for (const double x : excluded) add(x, false);
    MapArchive archive;
    EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, std::move(layer)}));
    EXPECT_TRUE(save_archive(archive, dir / name));
    return dir / name;
  }

  [[nodiscard]] std::filesystem::path saved_list(const std::string& instances) const {
    test::write_text(dir / "room.yaml",
                     "format: hypermap-sequence-truth\nversion: 1\nsequence: room\nup: [0, 0, 1]\n"
                     "things:\n" +
                         instances);
    return dir / "room.yaml";
  }

  test::TempDir dir;

 private:
  static ValueTree box_tree(double x) {
    return make_list({make_number(x - 0.25),
                      make_number(-0.25),
                      make_number(0.0),
                      make_number(x + 0.25),
                      make_number(0.25),
                      make_number(0.8)});
  }
};

std::string listed_instance_at(const std::string& name, const std::string& x, double yaw_degrees) {
  return "  - {name: " + name + ", class: chair, centre: [" + x +
         ", 0, 0.4], size: [0.5, 0.5, 0.8], yaw: " + std::to_string(yaw_degrees) +
         ", first_frame: 0, marks: []}\n";
}

TEST_F(RatesJobTest, AMapAgainstAnArchive) {
  // Chairs at 0 and 2 are found, that at 4 is missed; 9 is false, 7 was rightly rejected, 4.1 is
  // the missed one; at 12 stands what does not count.
  const auto map = saved_map("map.hmap", {0.1, 2.0, 9.0, 12.1}, {7.0, 4.1});
  const auto truth = saved_truth("truth.hmap", {0, 2, 4}, {12});
  const auto outcome = run_rates_job({.maps = {map}, .truths = {truth}});
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  const BinaryCounts expected{
      .true_positives = 2, .false_positives = 1, .false_negatives = 1, .true_negatives = 1};
  EXPECT_EQ(outcome->tables.classes.at("chair").rates.counts, expected);
  EXPECT_EQ(outcome->tables.all.counts, expected);
  EXPECT_THAT(outcome->unknown, IsEmpty());
  ASSERT_THAT(outcome->runs, SizeIs(1));
  const TruthRun& first = outcome->runs[0].truths[0];
  EXPECT_NEAR(first.error_m->x(), -0.1, 1e-9);
  EXPECT_NEAR(*first.overlap, 0.4 / 0.6, 1e-6);
  // Classes: of four real objects, three of them confirmed and one excluded without a reason.
  EXPECT_EQ(outcome->tables.classifications.num_right, outcome->tables.classifications.num_all);
  EXPECT_TRUE(outcome->tables.all.average_precision[0].has_value());
}

TEST_F(RatesJobTest, SeveralRunsAgainstOneTruth) {
  const auto truth = saved_truth("truth.hmap", {0, 2});
  const auto near = saved_map("near.hmap", {0.1, 2.0});
  const auto far = saved_map("far.hmap", {0.3}, {}, 0.5);
  const auto outcome = run_rates_job({.maps = {near, far}, .truths = {truth}}).value();
  ASSERT_THAT(outcome.tables.runs, SizeIs(2));
  ASSERT_THAT(outcome.tables.objects, SizeIs(2));
  EXPECT_EQ(outcome.tables.objects[0].num_found, 2U);
  EXPECT_TRUE(
      outcome.tables.objects[0].position.mean_m->isApprox(Eigen::Vector3d(-0.2, 0.0, -0.05), 1e-9));
  EXPECT_EQ(outcome.tables.objects[1].num_found, 1U);
  EXPECT_EQ(outcome.tables.objects[1].num_counting, 2U);
  // Footprints moved by 0.1 of their 0.5 m have 0.4 of 0.6 in common, by 0.3 a quarter of the
  // union; what is missed has nothing. Without surfaces nothing is known of voxels.
  EXPECT_NEAR(*outcome.runs[0].fit.jaccard_in_place, (2.0 / 3.0 + 1.0) / 2.0, 1e-9);
  EXPECT_NEAR(*outcome.runs[1].fit.jaccard_in_place, 0.125, 1e-9);
  EXPECT_FALSE(outcome.runs[0].fit.label_precision);
  const auto truth_each = saved_truth("other.hmap", {0, 2});
  EXPECT_EQ(
      run_rates_job({.maps = {near, far}, .truths = {truth, truth_each}}).value().tables.all.counts,
      outcome.tables.all.counts);
}

TEST_F(RatesJobTest, AMapAgainstAList) {
  // A cube of the plan that stands at 45 degrees has 2 (sqrt 2 - 1) = 0.828 of itself in common.
  const auto map = saved_map("map.hmap", {0.0, 9.0}, {5.0});
  const auto list =
      saved_list(listed_instance_at("turned", "0", 45) + listed_instance_at("gone", "3", 0));
  const auto outcome = run_rates_job({.maps = {map}, .truths = {list}});
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  const BinaryCounts expected{
      .true_positives = 1, .false_positives = 1, .false_negatives = 1, .true_negatives = 1};
  EXPECT_EQ(outcome->tables.all.counts, expected);
  EXPECT_EQ(outcome->tables.objects[0].reference, "turned");
  const double common = 2.0 * (std::numbers::sqrt2 - 1.0);
  EXPECT_NEAR(*outcome->runs[0].truths[0].overlap, common / (2.0 - common), 1e-6);
  EXPECT_FALSE(outcome->runs[0].fit.jaccard_in_place);
  EXPECT_THAT(outcome->unknown, ElementsAre(HasSubstr("rarely seen")));
}

TEST_F(RatesJobTest, WhatCannotBeToldIsSaid) {
  const auto flat = saved_truth("flat.hmap", {0, 2}, {}, false);
  const auto outcome = run_rates_job({.maps = {flat}, .truths = {flat}}).value();
  EXPECT_EQ(outcome.tables.all.counts.true_positives, 2U);
  EXPECT_FALSE(outcome.tables.all.counts.true_negatives);
  EXPECT_FALSE(outcome.tables.all.average_precision[0]);
  EXPECT_FALSE(outcome.tables.all.box_iou);
  EXPECT_FALSE(outcome.tables.all.position.total_rmse_m);
  EXPECT_THAT(outcome.unknown,
              ElementsAre(HasSubstr("no TNr"), HasSubstr("no AP"), HasSubstr("2 things")));
}

TEST_F(RatesJobTest, JobsThatDoNotFitAreRefused) {
  const auto truth = saved_truth("truth.hmap", {0});
  const auto map = saved_map("map.hmap", {0});
  const auto list = saved_list(listed_instance_at("here", "0", 0));
  const auto field_of = [](const RatesJob& job) {
    const auto refused = run_rates_job(job);
    return refused ? std::string("taken") : refused.error().field;
  };
  EXPECT_EQ(field_of({.truths = {truth}}), "maps");
  EXPECT_EQ(field_of({.maps = {map, map, map}, .truths = {truth, truth}}), "truths");
  EXPECT_EQ(field_of({.maps = {map}, .truths = {}}), "truths");
  EXPECT_EQ(field_of({.maps = {map}, .truths = {truth}, .frames = NamingFrames{}}), "frames");
  EXPECT_EQ(field_of({.maps = {map}, .truths = {list}, .options = {.classes = {"chair"}}}),
            "classes");
  EXPECT_EQ(field_of({.maps = {map}, .truths = {truth}, .options = {.classes = {"sofa"}}}),
            "classes");
  EXPECT_EQ(field_of({.maps = {map}, .truths = {truth}, .options = {.classes = {"Chair"}}}),
            "taken");
  const auto absent = run_rates_job({.maps = {dir / "absent.hmap"}, .truths = {truth}});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().file, (dir / "absent.hmap").string());
}

}  // namespace
}  // namespace hypermap
