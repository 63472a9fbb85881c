// SPDX-License-Identifier: BSD-3-Clause
// Supercells against the superpixel methods of OpenCV on table-top scenes. Source: [sogm] IV.
//   supercell_comparison tune SEED                      every setting of every method
//   supercell_comparison compare SETTINGS LEVEL SEED    the chosen settings
//   supercell_comparison figures SETTINGS SEED FOLDER   images of scenes and clusterings
// The first two print a JSON line for each run. SETTINGS is a file with the number of a setting a
// method. Run by scripts/supercells.
#include "comparison_images.hpp"
#include "superpixel_methods.hpp"
#include "table_top_scene.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr int kSmallestObjectLevel = 3;  // squares of 8 cells

void print_row(const TableTopScene& scene,
               SceneKind kind,
               std::uint64_t seed,
               int level,
               Method method,
               std::size_t setting,
               const std::optional<MatchedRun>& run) {
  const MethodSettings settings = settings_to_try(method)[setting];
  std::printf("{\"scene\": \"%s\", \"seed\": %llu, \"level\": %d, \"method\": \"%s\", ",
              std::string(name_of(kind)).c_str(),
              static_cast<unsigned long long>(seed),
              level,
              std::string(name_of(method)).c_str());
  std::printf("\"setting\": %zu, \"text\": \"%s\"", setting, text_of(settings).c_str());
  if (run) {
    const SegmentationMetrics metrics =
        segmentation_metrics(run->segmentation, scene.truth, scene.stack).value();
    std::printf(", \"count\": %d, \"icv\": %.9g, \"ev\": %.9g, \"ue\": %.9g, \"br\": %.9g",
                metrics.count,
                metrics.intra_cluster_variation,
                metrics.explained_variation,
                metrics.undersegmentation_error,
                metrics.boundary_recall);
    std::printf(", \"pureness\": %.9g, \"seconds\": %.4f", metrics.pureness, run->seconds);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

void tune(std::uint64_t seed) {
  for (const SceneKind kind : kSceneKinds) {
    const TableTopScene scene = table_top_scene(kind, seed);
    const StackImages images(scene.stack);
    for (const Method method : kMethods) {
      const std::vector<MethodSettings> all = settings_to_try(method);
      for (std::size_t i = 0; i < all.size(); ++i) {
        print_row(scene,
                  kind,
                  seed,
                  kSmallestObjectLevel,
                  method,
                  i,
                  run_matched(method, all[i], kSmallestObjectLevel, scene.stack, images));
      }
    }
  }
}

/// Of each method, the number of the setting that was chosen.
std::vector<std::size_t> chosen_settings(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::size_t> chosen;
  for (std::size_t number = 0; file >> number;) chosen.push_back(number);
  if (chosen.size() != std::size(kMethods)) {
    std::fprintf(stderr, "supercell_comparison: %s must have a number a method\n", path.c_str());
    std::exit(4);
  }
  return chosen;
}

void compare(const std::vector<std::size_t>& chosen, int level, std::uint64_t seed) {
  for (const SceneKind kind : kSceneKinds) {
    const TableTopScene scene = table_top_scene(kind, seed);
    const StackImages images(scene.stack);
    for (std::size_t m = 0; m < std::size(kMethods); ++m) {
      const MethodSettings settings = settings_to_try(kMethods[m])[chosen[m]];
      print_row(scene,
                kind,
                seed,
                level,
                kMethods[m],
                chosen[m],
                run_matched(kMethods[m], settings, level, scene.stack, images));
    }
  }
}

void draw_figures(const std::vector<std::size_t>& chosen,
                  std::uint64_t seed,
                  const std::string& folder) {
  std::vector<TableTopScene> scenes;
  for (const SceneKind kind : kSceneKinds) scenes.push_back(table_top_scene(kind, seed));
  write_scenes(scenes, folder + "/supercell_scenes.png");
  const TableTopScene& scene = scenes.back();
  write_layers(scene, folder + "/supercell_layers.png");
  const StackImages images(scene.stack);
  std::vector<CellSegmentation> clusterings;
  for (std::size_t m = 0; m < std::size(kMethods); ++m) {
    const MethodSettings settings = settings_to_try(kMethods[m])[chosen[m]];
    const auto run = run_matched(kMethods[m], settings, kSmallestObjectLevel, scene.stack, images);
    if (run) clusterings.push_back(run->segmentation);
  }
  write_clusterings(scene, clusterings, folder + "/supercell_clusterings.png");
}

int run(const std::vector<std::string>& arguments) {
  const auto number = [&](std::size_t i) {
    return std::strtoull(arguments[i].c_str(), nullptr, 10);
  };
  const std::size_t count = arguments.size();
  if (count == 2 && arguments[0] == "tune") {
    tune(number(1));
  } else if (count == 4 && arguments[0] == "compare") {
    compare(chosen_settings(arguments[1]), static_cast<int>(number(2)), number(3));
  } else if (count == 4 && arguments[0] == "figures") {
    draw_figures(chosen_settings(arguments[1]), number(2), arguments[3]);
  } else {
    std::fprintf(stderr,
                 "supercell_comparison: tune SEED | compare SETTINGS LEVEL SEED | "
                 "figures SETTINGS SEED FOLDER\n");
    return 4;
  }
  return 0;
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  return hypermap::test::run({argv + 1, argv + argc});
}
