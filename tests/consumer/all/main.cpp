// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody else's that uses the installed package, each of its libraries.
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>
#include <hypermap/viewer_offscreen/snapshot/snapshot.hpp>

int main() {
  const auto mapper = hypermap::SemanticMapper::create({});
  if (!mapper || !mapper->octree().empty()) return 1;
  const auto saved = hypermap::write_archive({});
  if (!saved) return 1;
  // A machine without EGL says so; that it can be asked is what is tried here.
  const auto image = hypermap::render_snapshot({}, {.width_px = 64, .height_px = 64});
  return image || image.error().code == hypermap::ErrorCode::kUnavailable ? 0 : 1;
}
