// SPDX-License-Identifier: BSD-3-Clause
// fuzz_seeds FROM TO: seeds that lie within the archives anywhere in FROM and within a small map of
// our own, into folders of TO: each member for the target that reads it, and all members as records
// for the target `archive`.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/tiles/tile_file.hpp"
#include "io/archive/sample_archive.hpp"
#include "io/tiles/tile_builders.hpp"
#include "targets.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap::fuzz {
namespace {

namespace fs = std::filesystem;

/// Who reads the member; empty: nobody by itself.
std::string_view target_of(std::string_view member) {
  if (member == "hmap_config.yaml") return "config";
  if (member == "provenance.yaml") return "provenance";
  if (member == "classes.yaml") return "yaml";
  if (member == "detectors.yaml") return "detectors";
  if (member == "vocabulary.yaml") return "vocabulary";
  if (member.ends_with(".yaml")) return "map";
  if (member.ends_with(".png")) return "png";
  if (member.ends_with(".ot")) return "octree";
  if (member == "embeddings.bin") return "embeddings";
  if (member == "views.bin") return "views";
  if (member == "true_surfaces.jsonl") return "surfaces";
  if (member == "topological_map.jsonl") return "topology";
  if (member.ends_with(".jsonl")) return "objects";
  return "semantic";
}

void write_seed(const fs::path& to,
                std::string_view target,
                const std::string& name,
                std::string_view bytes) {
  fs::create_directories(to / target);
  std::ofstream(to / target / name, std::ios::binary) << bytes;
}

/// Of an archive that is none: nothing.
void write_members(std::shared_ptr<const ByteSource> source,
                   const std::string& archive,
                   const fs::path& to) {
  const auto zip = ZipReader::create(std::move(source));
  if (!zip) return;
  std::string records;
  for (const ZipMember& member : zip->members()) {
    const auto content = zip->read(member.name, kMaxSeedBytes);
    if (!content) continue;
    const std::string name = fs::path(member.name).filename().string();
    write_seed(to, target_of(name), archive + "." + name, *content);
    if (target_of(name) == "semantic")
      write_seed(to, "update", archive + "." + name, "delete: [1]\nadd:\n" + *content);
    if (records.size() + content->size() > kMaxSeedBytes) continue;
    records += (records.empty() ? "" : std::string(kEndOfMember));
    records += member.name + "\n" + *content;
  }
  write_seed(to, "archive", archive, records);
}

/// The tests' sample with what only a simulation knows: two surfaces, one of them seen.
MapArchive simulated_archive() {
  MapArchive archive = test::sample_archive();
  archive.vocabulary = ClassVocabulary::create({.aliases = {{{"sofa"}, {{"settee"}}}},
                                                .super_classes = {{{"seat"}, {{"sofa"}}}}})
                           .value();
  archive.topological_map.emplace();
  archive.topological_map->observe({0, 0, 1.2});
  archive.topological_map->observe({1.5, 0, 1.2});
  archive.topological_map->cover({1.5, 2.5, 0.4});
  archive.true_surfaces = {
      .seen_cell_m = 0.025,
      .objects = {{.id = ObjectId{2},
                   .class_name = "chair",
                   .vertices = {{0.1F, 0, 0}, {1, 0, 0.3F}, {0, 1, 0}},
                   .triangles = {{0, 1, 2}, {2, 1, 0}},
                   .seen_cells = {{-3, 0, 7}, {-3, 1, 0}}},
                  {.id = ObjectId{9}, .class_name = "bin", .is_nameable = false}}};
  return archive;
}

/// One of ours, and two as the public implementation of [sogm] names them, of two cells each.
void write_tiles(const fs::path& to) {
  const auto tile = encode_tile(test::sample_tile({-2, 6}, 1), test::small_tiles());
  if (tile) write_seed(to, "tile", "sample.tile", *tile);
  write_seed(to,
             "sogm",
             "int8",
             "What_OGM_T_12.345s.ns_Format_INT8_Unit_logodds_Layer_-a-b_Res_10mm_X_-1.5m_Y_2m_Z_0m_"
             "yaw_0.5_rows_1_cols_2_lat_52.0_lon_8.5_alt_100_.bin\n\x10\xF0");
  write_seed(
      to,
      "sogm",
      "float",
      "Timestamp_12345us_LayerIdx_3_Format_32F_Unit_probability_GridRes_50mm_X_1m_Y_2m_rows_1_"
      "cols_2.bin\nabc>def?");
}

void write_lists(const fs::path& to) {
  write_seed(to,
             "sequences",
             "all_keys",
             "sequences:\n- kitchen\n- input: /data/hall\n  name: hall\n  dataset: hall.yaml\n"
             "  detections: [{file: a.json, detector: a}, b.jsonl]\n  poses: closed.txt\n  up: -y\n"
             "  transform: [4.2, 0, 0, 90]\n");
  write_seed(to,
             "part_record",
             "all_keys",
             "format: hypermap-part\nversion: 1\nprogram: hypermap 0.1.0\ninput: xxh3-128:0\n"
             "settings: xxh3-128:1\ncontent: xxh3-128:2\nframes: 40\nskipped: 1\nobjects: 2\n"
             "tentative: 3\nsessions: 1\noccupied: 4\nfree: 5\nfindings: [odd, more]\n");
}

/// Clouds of a few points: text, rows, and columns packed as literals.
void write_clouds(const fs::path& to) {
  const std::string head =
      "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 1\nTYPE F F F U\nWIDTH 2\nHEIGHT 1\nDATA ";
  write_seed(to, "cloud", "text.pcd", head + "ascii\n1 2 3 4\n5 nan 7 8\n");
  const std::string rows(26, '\x3F');
  write_seed(to, "cloud", "rows.pcd", head + "binary\n" + rows);
  const std::string sizes("\x1B\0\0\0\x1A\0\0\0", 8);
  write_seed(to, "cloud", "columns.pcd", head + "binary_compressed\n" + sizes + "\x19" + rows);
  write_seed(to,
             "cloud",
             "text.ply",
             "ply\nformat ascii 1.0\ncomment label 3 chair\nelement vertex 1\nproperty float x\n"
             "property float y\nproperty double z\nproperty uchar label\nelement face 1\n"
             "property list uchar int i\nend_header\n1 2 3 3\n1 0\n");
  write_seed(to, "cloud", "names.yaml", "0: ~\n3: chair\n-1: dining table\n");
}

void write_seeds(const fs::path& from, const fs::path& to) {
  write_tiles(to);
  write_lists(to);
  write_clouds(to);
  const auto sample = write_archive(simulated_archive());
  if (sample) write_members(view_bytes(*sample), "sample", to);
  std::error_code ec;
  for (const auto& entry : fs::recursive_directory_iterator(from, ec)) {
    if (entry.path().extension() != ".hmap") continue;
    if (auto source = open_file(entry.path(), kMaxSeedBytes))
      write_members(std::move(*source), entry.path().filename().string(), to);
  }
}

}  // namespace
}  // namespace hypermap::fuzz

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  hypermap::fuzz::write_seeds(argv[1], argv[2]);
  return 0;
}
