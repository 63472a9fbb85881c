// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody else's that uses the installed package.
#include <hypermap/io/map_archive.hpp>
#include <hypermap/octree_semantic/semantic_mapper.hpp>

int main() {
  const auto mapper = hypermap::SemanticMapper::create({});
  return mapper && mapper->octree().empty() ? 0 : 1;
}
