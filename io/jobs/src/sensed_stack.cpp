// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/sensed_stack.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/projection/sensor_models/depth_camera_model.hpp"
#include "hypermap/projection/sensor_models/detection_model.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kSensorNames[] = {"depth", "detections"};

/// Why register_grids refuses.
constexpr std::pair<std::string_view, std::string_view> kRefusalTexts[] = {
    {"features", "too little structure to find it by"},
    {"inliers", "too few matches agree on one place within the limits"},
    {"overlap", "too few cells in common"},
    {"agreement", "the best place does not fit well enough"},
    {"rivals", "several places fit about as well"},
};

/// Frames were to be registered, and none could be.
Error none_registered(const SensedStackReport& report, const std::string& reference) {
  std::string what = "none of " + count_text(report.num_frames, "frame") +
                     " could be placed on layer " + printable(reference);
  for (const auto& [reason, count] : report.num_refused) {
    what += "; " + count_text(count, "frame") + ": " + std::string(refusal_text(reason)) + " (" +
            reason + ")";
  }
  return {.code = ErrorCode::kNotFound, .what = std::move(what), .field = "--register"};
}

using FrameModel = InverseSensorModel<RgbdFrame>;

struct WeightedModel {
  FrameSensorKind kind;
  double weight = 1.0;
  std::unique_ptr<FrameModel> model;
};

std::string folder_name(const std::filesystem::path& input) {
  return printable(std::filesystem::absolute(input).lexically_normal().filename().string());
}

/// Where the input's world lies in the map.
Result<MapFromInput> world_in_map(const DatasetReader& dataset,
                                  const std::filesystem::path& input,
                                  std::span<const Provenance> runs) {
  const std::string& world = dataset.summary().world;
  const std::string name = folder_name(input);
  const auto of_world = std::find_if(runs.rbegin(), runs.rend(), [&](const Provenance& run) {
    return !world.empty() && run.world == world;
  });
  if (of_world != runs.rend()) return of_world->map_from_input;
  const auto of_input = std::find_if(
      runs.rbegin(), runs.rend(), [&](const Provenance& run) { return run.input == name; });
  if (of_input != runs.rend()) return of_input->map_from_input;
  return fail(ErrorCode::kInvalidArgument,
              "the map has no run of an input \"" + name +
                  "\" nor of its world, so nothing says where its poses lie in the map",
              "--input");
}

std::set<std::string> layers_of_classes(const std::string& parent,
                                        const ClassRegistry& classes,
                                        std::span<const ClassId> ids) {
  std::set<std::string> layers;
  for (const ClassId id : ids) layers.insert(stack_layer_name(parent, classes.name(id)));
  return layers;
}

/// Sensed layers on the cells of a stack, and what is known of how they came about.
class FrameFuser {
 public:
  /// Errors: those of fuse_frames. Requires: `stack` and `job` outlive it.
  [[nodiscard]] static Result<FrameFuser> create(const GridStack& stack,
                                                 const SensedStackJob& job,
                                                 const ClassRegistry& classes) {
    HYPERMAP_TRY(validate(job.registration));
    if (job.reference && !stack.layers().contains(*job.reference)) {
      std::vector<std::string> known;
      for (const auto& [name, grid] : stack.layers()) known.push_back(name);
      return fail(
          ErrorCode::kNotFound, nothing_named("layer", *job.reference, known), "--register");
    }
    HYPERMAP_ASSIGN_OR_RETURN(GridStack sensed,
                              GridStack::create(stack.geometry(), stack.options()));
    FrameFuser fuser(stack, job, std::move(sensed));
    HYPERMAP_TRY(fuser.make_models(classes));
    return fuser;
  }

  Result<void> add(const RgbdFrame& frame) {
    std::vector<SensorGrid> readings;
    for (const WeightedModel& sensor : models_) {
      HYPERMAP_ASSIGN_OR_RETURN(std::vector<SensorGrid> grids, sensor.model->grids(frame));
      for (SensorGrid& grid : grids) {
        grid.weight = sensor.weight;
        readings.push_back(std::move(grid));
      }
    }
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Matrix3d stack_from_map, registered(frame));
    for (const SensorGrid& reading : readings) HYPERMAP_TRY(fuse(reading, stack_from_map));
    ++report_.num_frames;
    report_.num_detections += frame.detections.size();
    return {};
  }

  void skip(Error error) { report_.skipped.push_back(std::move(error)); }

  /// The stack with what was sensed, of classes that were seen.
  [[nodiscard]] Result<GridStack> fused() const {
    GridStack all = *stack_;
    for (const auto& [name, grid] : sensed_.layers()) {
      const bool is_of_class = name != depth_layer_;
      if (is_of_class && !shown_.contains(name)) continue;
      HYPERMAP_TRY(all.fuse({.layer = name, .grid = grid},
                            Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                            {.rule = ResamplingRule::kNearest}));
    }
    return all;
  }

  [[nodiscard]] SensedStackReport report() const {
    SensedStackReport report = report_;
    if (report.num_registered > 0) {
      report.mean_shift_m /= static_cast<double>(report.num_registered);
    }
    return report;
  }

 private:
  FrameFuser(const GridStack& stack, const SensedStackJob& job, GridStack sensed)
      : stack_(&stack),
        job_(&job),
        sensed_(std::move(sensed)),
        depth_layer_(stack_layer_name(stack.options().parent, "depth")) {}

  Result<void> make_models(const ClassRegistry& classes) {
    const EvidenceOptions evidence{.resolution_m = stack_->geometry().resolution_m};
    for (const FrameSensor& sensor : job_->sensors) {
      if (sensor.kind == FrameSensorKind::kDepth) {
        HYPERMAP_ASSIGN_OR_RETURN(auto model, depth_model(evidence));
        models_.push_back({sensor.kind, sensor.weight, std::move(model)});
      } else {
        HYPERMAP_ASSIGN_OR_RETURN(auto model, detection_model(evidence, classes));
        models_.push_back({sensor.kind, sensor.weight, std::move(model)});
      }
    }
    if (job_->reference) {
      HYPERMAP_ASSIGN_OR_RETURN(aligner_, depth_model(evidence));
    }
    if (!models_.empty()) return {};
    return fail(ErrorCode::kInvalidArgument, "nothing is to be sensed", "--sensor");
  }

  [[nodiscard]] Result<std::unique_ptr<FrameModel>> depth_model(
      const EvidenceOptions& evidence) const {
    HYPERMAP_ASSIGN_OR_RETURN(DepthCameraModel model,
                              DepthCameraModel::create({.layer = depth_layer_,
                                                        .frame_id = stack_->options().frame_id,
                                                        .evidence = evidence,
                                                        .heights = job_->heights}));
    return std::make_unique<DepthCameraModel>(std::move(model));
  }

  [[nodiscard]] Result<std::unique_ptr<FrameModel>> detection_model(EvidenceOptions evidence,
                                                                    const ClassRegistry& classes) {
    const std::string parent = stack_layer_name(stack_->options().parent, "detections");
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<ClassId> ids,
                              asked_classes(classes, job_->vocabulary, job_->classes));
    wanted_ = layers_of_classes(parent, classes, ids);
    evidence.p_hit = DetectionModelOptions{}.evidence.p_hit;
    HYPERMAP_ASSIGN_OR_RETURN(DetectionModel model,
                              DetectionModel::create(classes,
                                                     {.parent = parent,
                                                      .frame_id = stack_->options().frame_id,
                                                      .evidence = evidence,
                                                      .heights = job_->heights}));
    return std::make_unique<DetectionModel>(std::move(model));
  }

  /// Where the frame's grids belong, which the identity says unless the frame is registered.
  Result<Eigen::Matrix3d> registered(const RgbdFrame& frame) {
    const Eigen::Matrix3d as_posed = Eigen::Matrix3d::Identity();
    if (!aligner_) return as_posed;
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<SensorGrid> depth, aligner_->grids(frame));
    const LogOddsGrid& fixed = stack_->layers().at(*job_->reference);
    const LogOddsGrid& moving = depth.front().grid;
    const auto found = register_grids(moving, fixed, job_->registration);
    if (!found) {
      if (found.error().code != ErrorCode::kNotFound) return Unexpected(found.error());
      ++report_.num_refused[found.error().field];
      return as_posed;
    }
    const Rect place = bounds(moving.geometry());
    const Eigen::Vector2d middle = (place.min + place.max) / 2.0;
    const double shift_m =
        ((found->fixed_from_moving * middle.homogeneous()).hnormalized() - middle).norm();
    ++report_.num_registered;
    report_.mean_shift_m += shift_m;  // a sum, until it is reported
    report_.max_shift_m = std::max(report_.max_shift_m, shift_m);
    return found->fixed_from_moving;
  }

  Result<void> fuse(const SensorGrid& reading, const Eigen::Matrix3d& stack_from_map) {
    const bool is_of_class = reading.layer != depth_layer_;
    if (is_of_class && !wanted_.empty() && !wanted_.contains(reading.layer)) return {};
    if (reading.grid.num_known() == 0 || !reaches_stack(reading.grid, stack_from_map)) return {};
    HYPERMAP_TRY(sensed_.fuse(reading, stack_from_map));
    if (is_of_class && std::ranges::max(reading.grid.cells()) > 0) shown_.insert(reading.layer);
    return {};
  }

  [[nodiscard]] bool reaches_stack(const LogOddsGrid& grid,
                                   const Eigen::Matrix3d& stack_from_map) const {
    const Eigen::Vector2d size(stack_->geometry().cols, stack_->geometry().rows);
    const Eigen::Vector2d own(grid.geometry().cols, grid.geometry().rows);
    Eigen::Vector2d min = size;
    Eigen::Vector2d max = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(own.x(), 0), Eigen::Vector2d(0, own.y()), own}) {
      const Eigen::Vector2d place = from_cells(grid.geometry(), corner);
      const Eigen::Vector2d cells =
          to_cells(stack_->geometry(), (stack_from_map * place.homogeneous()).hnormalized());
      min = min.cwiseMin(cells);
      max = max.cwiseMax(cells);
    }
    return (min.array() < size.array()).all() && (max.array() > 0.0).all();
  }

  const GridStack* stack_;
  const SensedStackJob* job_;
  GridStack sensed_;
  std::string depth_layer_;
  std::vector<WeightedModel> models_;
  std::unique_ptr<FrameModel> aligner_;  ///< None: frames are not registered.
  std::set<std::string> wanted_;         ///< Layers of classes; all when empty.
  std::set<std::string> shown_;          ///< That something was detected of.
  SensedStackReport report_;
};

}  // namespace

std::span<const std::string_view> frame_sensor_names() {
  return kSensorNames;
}

std::string_view refusal_text(std::string_view reason) {
  const auto* const found =
      std::ranges::find(kRefusalTexts, reason, [](const auto& text) { return text.first; });
  return found == std::end(kRefusalTexts) ? reason : found->second;
}

Result<SensedStackReport> fuse_frames(GridStack& stack,
                                      const SensedStackJob& job,
                                      std::span<const Provenance> runs,
                                      ClassRegistry classes,
                                      const JobProgress& progress) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset, open_dataset(job.input, job.dataset, classes));
  HYPERMAP_ASSIGN_OR_RETURN(const MapFromInput world, world_in_map(*dataset, job.input, runs));
  dataset->set_map_from_input(world);
  HYPERMAP_ASSIGN_OR_RETURN(FrameFuser fuser, FrameFuser::create(stack, job, classes));
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    auto frame = dataset->read(i);
    if (frame) {
      HYPERMAP_TRY(fuser.add(*frame));
    } else {
      fuser.skip(std::move(frame.error()));
    }
    if (progress && !progress(i + 1, dataset->size())) return interrupted();
  }
  SensedStackReport report = fuser.report();
  if (report.num_frames == 0) {
    return fail(ErrorCode::kNotFound, "no frame of the dataset could be read", "--input");
  }
  if (job.reference && report.num_registered == 0) {
    return Unexpected(none_registered(report, *job.reference));
  }
  HYPERMAP_ASSIGN_OR_RETURN(stack, fuser.fused());
  return report;
}

}  // namespace hypermap
