// SPDX-License-Identifier: BSD-3-Clause
#include "integration_workspace.hpp"

#include "frame_checks.hpp"
#include "integration/marking/cell_finder.hpp"
#include "integration/marking/ray_marking.hpp"
#include "integration/marking/sparse_rays.hpp"

#include <algorithm>
#include <new>

namespace hypermap {
namespace {

/// Farther than any volume of a map: no limit.
constexpr double kEverywhereM = 1e9;
/// Measurements beyond the range are united by voxel within a window of at most so many cells, that
/// is 32 MiB of bits; else each gets a ray of its own.
constexpr double kMaxFarCells = 268435456.0;
constexpr std::size_t kRaysPerChunk = RayMarker::kMaxRays;

std::size_t num_chunks_of(std::size_t size, std::size_t per_chunk) {
  return (size + per_chunk - 1) / per_chunk;
}

void add(IntegrationReport& total, const IntegrationReport& more) {
  total.num_hits += more.num_hits;
  total.num_beyond_range += more.num_beyond_range;
  total.num_not_measured += more.num_not_measured;
  total.num_not_finite += more.num_not_finite;
  total.num_outside_volume += more.num_outside_volume;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
  more.clear();
}

}  // namespace

Result<IntegrationReport> IntegrationWorkspace::integrate(SemanticOctree& tree,
                                                          const MeasuredPoints& points,
                                                          const DepthPoints* image,
                                                          std::span<const PixelLabels> labels,
                                                          const IntegrationOptions& options) {
  const double resolution_m = tree.resolution_m();
  const KeyBox key_bounds = points.key_bounds(resolution_m, options.max_range_m);
  if (!window_.cover(key_bounds, WindowGeometry::kMaxCells))
    return window_too_large(key_bounds, options);
  IntegrationReport report;
  try {
    prepare(options);
    const bool by_voxel = options.mode == IntegrationMode::kDiscretize;
    const EndPoints ends(
        resolution_m,
        points.sensor(),
        options,
        window_,
        by_voxel ? prepare_far(points.key_bounds(resolution_m, kEverywhereM)) : nullptr);
    find_ends(points, ends, report);  // where measurements end
    if (by_voxel) ends.cast_from_voxels(slots_.front().ends);
    if (options.mode == IntegrationMode::kProjective) {
      project(*image, ends, resolution_m, options.max_range_m);  // what they looked through
    }
    cast_rays(resolution_m, points.sensor());  // what rays passed through
    const auto key_of = [this](std::size_t brick) { return this->key_of(brick); };
    const MarkedBricks marked{hit(), passed(), window_.num_bricks(), key_of};
    writer_.count_votes(tree.grid(),
                        marked,
                        cell_of_measurement_,
                        labels,
                        LabelVotes::Storage::kInPlace,
                        report);                    // which labels ended where
    writer_.stage(tree, marked, workers_, report);  // all memory that the map will need
    writer_.commit(tree, marked, workers_, report);
  } catch (const std::bad_alloc&) {
    clear();
    return fail(ErrorCode::kOutOfMemory, "no memory to integrate the frame");
  }
  clear();
  return report;
}

std::optional<BrickKey> IntegrationWorkspace::key_of(std::size_t brick) const noexcept {
  const auto [x, y, z] = window_.brick_corner(brick);
  // Rounding may carry a ray along the edge of the volume one voxel too far.
  if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= kKeysPerAxis) return std::nullopt;
  return BrickKey::of({static_cast<std::uint16_t>(x),
                       static_cast<std::uint16_t>(y),
                       static_cast<std::uint16_t>(z)});
}

void IntegrationWorkspace::prepare(const IntegrationOptions& options) {
  workers_.set_num_threads(options.num_threads);
  slots_.resize(workers_.num_slots());
  for (Slot& slot : slots_) {
    slot.ends.hit.fit(window_.num_bricks());
    slot.passed.fit(window_.num_bricks());
    slot.ends.ray_ends.clear();
    slot.ends.dropped.clear();
    slot.ends.report = {};
  }
}

const WindowGeometry* IntegrationWorkspace::prepare_far(const KeyBox& everything) {
  if (!far_window_.cover(everything, kMaxFarCells)) return nullptr;
  for (Slot& slot : slots_) slot.ends.far.fit(far_window_.num_bricks());
  return &far_window_;
}

void IntegrationWorkspace::find_ends(const MeasuredPoints& points,
                                     const EndPoints& ends,
                                     IntegrationReport& report) {
  cell_of_measurement_.resize(points.size());
  for (Slot& slot : slots_) ends.reserve(slot.ends, points);
  workers_.for_each(points.num_chunks(), [&](std::size_t slot, std::size_t chunk) {
    EndSink& sink = slots_[slot].ends;
    points.read(chunk, sink.chunk, sink.report);
    ends.add(sink, std::span(cell_of_measurement_).subspan(sink.chunk.first, sink.chunk.size));
  });
  EndSink& first = slots_.front().ends;
  for (Slot& slot : slots_) {
    add(report, slot.ends.report);
    if (&slot == &slots_.front()) continue;
    first.hit.take(slot.ends.hit);
    first.far.take(slot.ends.far);
    append(first.ray_ends, slot.ends.ray_ends);
    append(first.dropped, slot.ends.dropped);
  }
}

void IntegrationWorkspace::cast_rays(double resolution_m, const PointF& sensor) {
  const RayMarker marker(window_, resolution_m, sensor);
  const std::vector<PointF>& rays = ray_ends();
  workers_.for_each(
      num_chunks_of(rays.size(), kRaysPerChunk), [&](std::size_t slot, std::size_t chunk) {
        const std::size_t first = chunk * kRaysPerChunk;
        const std::size_t size = std::min(rays.size() - first, kRaysPerChunk);
        marker.mark(std::span(rays).subspan(first, size), slots_[slot].passed.marker());
      });
  for (std::size_t i = 1; i < slots_.size(); ++i) passed().take(slots_[i].passed);
}

void IntegrationWorkspace::project(const DepthPoints& image,
                                   const EndPoints& ends,
                                   double resolution_m,
                                   double max_range_m) {
  const RgbdFrame& frame = image.frame();
  const EndSink& found = slots_.front().ends;
  pyramid_.build(frame.depth_m.pixels(), frame.camera.width_px, found.dropped, workers_);
  projection_.mark(frame, pyramid_, resolution_m, max_range_m, window_, workers_, passed());
  add_sparse_rays(image, pyramid_, ends, cell_of_measurement_, ray_ends());
}

void IntegrationWorkspace::clear() noexcept {
  for (Slot& slot : slots_) {
    slot.ends.hit.clear();
    slot.ends.far.clear();
    slot.passed.clear();
  }
}

}  // namespace hypermap
