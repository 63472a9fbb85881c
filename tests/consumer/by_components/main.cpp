// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody else's that maps, saves and loads, and needs nothing else.
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>

int main() {
  const auto mapper = hypermap::SemanticMapper::create({});
  if (!mapper || !mapper->octree().empty()) return 1;
  const auto bytes = hypermap::write_archive({});
  if (!bytes || !hypermap::parse_archive(*bytes, {.file = "empty.hmap"})) return 1;
  // A folder is no archive; that files can be read is what is tried here.
  return hypermap::load_archive("/") ? 1 : 0;
}
