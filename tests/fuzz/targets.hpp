// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All fuzz targets by name: the readers of files that strangers may have written.
#pragma once

#include <cstddef>
#include <string_view>

namespace hypermap::fuzz {

void fuzz_archive(std::string_view bytes);
void fuzz_bmp(std::string_view bytes);
void fuzz_classes(std::string_view bytes);
void fuzz_cloud(std::string_view bytes);
void fuzz_combiner(std::string_view bytes);
void fuzz_config(std::string_view bytes);
void fuzz_dataset(std::string_view bytes);
void fuzz_deflate(std::string_view bytes);
void fuzz_detections(std::string_view bytes);
void fuzz_detectors(std::string_view bytes);
void fuzz_embeddings(std::string_view bytes);
void fuzz_intrinsics(std::string_view bytes);
void fuzz_jpeg(std::string_view bytes);
void fuzz_json(std::string_view bytes);
void fuzz_labels(std::string_view bytes);
void fuzz_listed(std::string_view bytes);
void fuzz_map(std::string_view bytes);
void fuzz_objects(std::string_view bytes);
void fuzz_octree(std::string_view bytes);
void fuzz_options(std::string_view bytes);
void fuzz_pgm(std::string_view bytes);
void fuzz_places(std::string_view bytes);
void fuzz_png(std::string_view bytes);
void fuzz_part_record(std::string_view bytes);
void fuzz_provenance(std::string_view bytes);
void fuzz_relations(std::string_view bytes);
void fuzz_salvage(std::string_view bytes);
void fuzz_scene(std::string_view bytes);
void fuzz_semantic(std::string_view bytes);
void fuzz_sequences(std::string_view bytes);
void fuzz_sogm(std::string_view bytes);
void fuzz_surfaces(std::string_view bytes);
void fuzz_tile(std::string_view bytes);
void fuzz_tile_set(std::string_view bytes);
void fuzz_topology(std::string_view bytes);
void fuzz_trajectory(std::string_view bytes);
void fuzz_update(std::string_view bytes);
void fuzz_vector(std::string_view bytes);
void fuzz_views(std::string_view bytes);
void fuzz_vocabulary(std::string_view bytes);
void fuzz_wkt(std::string_view bytes);
void fuzz_yaml(std::string_view bytes);
void fuzz_zip(std::string_view bytes);
void fuzz_zones(std::string_view bytes);

/// Longer inputs are not tried.
inline constexpr std::size_t kMaxSeedBytes = 65'536;
/// What the target `archive` reads: members one after the other, each its name, a line end and its
/// content; this stands between them.
inline constexpr std::string_view kEndOfMember = "\n---\n";

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};

inline constexpr Target kTargets[] = {{"archive", fuzz_archive},
                                      {"bmp", fuzz_bmp},
                                      {"classes", fuzz_classes},
                                      {"cloud", fuzz_cloud},
                                      {"combiner", fuzz_combiner},
                                      {"config", fuzz_config},
                                      {"dataset", fuzz_dataset},
                                      {"deflate", fuzz_deflate},
                                      {"detections", fuzz_detections},
                                      {"detectors", fuzz_detectors},
                                      {"embeddings", fuzz_embeddings},
                                      {"intrinsics", fuzz_intrinsics},
                                      {"jpeg", fuzz_jpeg},
                                      {"json", fuzz_json},
                                      {"labels", fuzz_labels},
                                      {"listed", fuzz_listed},
                                      {"map", fuzz_map},
                                      {"objects", fuzz_objects},
                                      {"octree", fuzz_octree},
                                      {"options", fuzz_options},
                                      {"pgm", fuzz_pgm},
                                      {"places", fuzz_places},
                                      {"png", fuzz_png},
                                      {"part_record", fuzz_part_record},
                                      {"provenance", fuzz_provenance},
                                      {"relations", fuzz_relations},
                                      {"salvage", fuzz_salvage},
                                      {"scene", fuzz_scene},
                                      {"semantic", fuzz_semantic},
                                      {"sequences", fuzz_sequences},
                                      {"sogm", fuzz_sogm},
                                      {"surfaces", fuzz_surfaces},
                                      {"tile", fuzz_tile},
                                      {"tile_set", fuzz_tile_set},
                                      {"topology", fuzz_topology},
                                      {"trajectory", fuzz_trajectory},
                                      {"update", fuzz_update},
                                      {"vector", fuzz_vector},
                                      {"views", fuzz_views},
                                      {"vocabulary", fuzz_vocabulary},
                                      {"wkt", fuzz_wkt},
                                      {"yaml", fuzz_yaml},
                                      {"zip", fuzz_zip},
                                      {"zones", fuzz_zones}};

}  // namespace hypermap::fuzz
