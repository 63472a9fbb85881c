// SPDX-License-Identifier: BSD-3-Clause
// How do the detections of my own network get into the map, by class names, and the depth of my own
// camera driver without a copy? Usage: own_detector DATASET
#include <hypermap/core/base/depth_view.hpp>
#include <hypermap/io/dataset/dataset_reader.hpp>
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>

#include <algorithm>
#include <cstdio>

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

// Stands for a network: what is at most 40 cm behind the nearest pixel is a "thing", or a "person".
static Detection my_network(std::span<const float> metres, const PinholeCamera& camera) {
  float nearest = 100.0F;
  for (const float depth : metres) nearest = depth > 0.0F ? std::min(nearest, depth) : nearest;
  PixelBox box{1e5, 1e5, 0.0, 0.0};
  for (int i = 0; i < camera.width_px * camera.height_px; ++i) {
    const float depth = metres[static_cast<std::size_t>(i)];
    if (!(depth > 0.0F && depth < nearest + 0.4F)) continue;
    const double u = i % camera.width_px;
    const double v = i / camera.width_px;  // NOLINT: rows are whole
    box = {std::min(box.u_min_px, u),
           std::min(box.v_min_px, v),
           std::max(box.u_max_px, u + 1.0),
           std::max(box.v_max_px, v + 1.0)};
  }
  const std::vector<ClassId> known{{0}, {1}};
  const ClassId named{box.height_px() > 0.9 * camera.height_px ? 1U : 0U};
  return {.box_px = box,
          .class_scores = spread_score(named, Probability(0.8), known),
          .score = Probability(0.8)};
}

int main(int argc, char** argv) {
  if (argc != 2) return 4;
  const std::vector<std::string> names{"thing", "person"};  // in the order of the network's outputs
  auto classes = ClassRegistry::from_names(names).value();
  SemanticMapperOptions options;
  options.objects.transient_class_names = {"person"};
  auto mapper = SemanticMapper::create(options, classes).value();
  const auto dataset =
      open_dataset(argv[1], {.find_detections = false, .read_color = false}, classes);
  if (!dataset) return 2;
  for (std::size_t i = 0; i < (*dataset)->size(); ++i) {
    const RgbdFrame recorded = (*dataset)->read(i).value();  // stands for the driver
    RgbdFrame frame{.index = i, .stamp = recorded.stamp, .camera = recorded.camera};
    frame.map_from_camera = recorded.map_from_camera;
    frame.depth_m = depth_image({.buffer = std::as_bytes(recorded.depth_m.pixels()),
                                 .width_px = frame.camera.width_px,
                                 .height_px = frame.camera.height_px})
                        .value();  // borrowed
    frame.detections = {my_network(recorded.depth_m.pixels(), frame.camera)};
    if (!mapper.integrate(frame)) return 2;
  }
  std::printf("%zu objects\n", mapper.objects().size());
}
