// SPDX-License-Identifier: BSD-3-Clause
#include "table_top_scene.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "table_top_world.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::test {
namespace {

using Eigen::Vector2d;

/// A sensor that looks ahead over a sector. Unit: metre, radian.
struct Sensor {
  std::string_view layer;
  std::uint64_t number;
  double resolution;  ///< Of its grids.
  double min_range;
  double max_range;
  double half_angle;
  double range_noise;       ///< Standard deviation, constant part.
  double range_noise_part;  ///< And the part that grows with the range.
  double offset_noise;      ///< Of its mounting: a standard deviation, once a scene.
  double yaw_noise;
  double scale_noise;  ///< Ranges are too long by this share: a pitch that is not known well.
};

constexpr Sensor kCamera{"/ism/cam", 0, 0.015, 0.12, 1.2, 0.6, 0.004, 0.015, 0.008, 0.01, 0.015};
constexpr Sensor kEdge{"/ism/edge", 1, 0.02, 0.06, 0.5, 1.05, 0.01, 0.01, 0.005, 0.01, 0.01};
constexpr Sensor kLaser{"/ism/laser", 2, 0.01, 0.05, 1.5, 2.1, 0.01, 0.0, 0.003, 0.005, 0.0};
constexpr double kCameraHeight = 0.15;
constexpr double kRayStep = kSceneCellM / 2.0;
constexpr double kAngleStep = 0.005;

struct Mounting {
  Vector2d offset = Vector2d::Zero();
  double yaw = 0.0;
  double scale = 1.0;
};

/// Where an obstacle begins along a ray, and which; none within reach.
struct Hit {
  double range = 1e9;
  int obstacle = -1;
};

Hit first_obstacle(const TrueCells& cells, const Vector2d& from, double bearing, double max_range) {
  const Vector2d ahead(std::cos(bearing), std::sin(bearing));
  for (double range = kRayStep; range < max_range; range += kRayStep) {
    const auto place = TrueCells::place(from + range * ahead);
    if (!place) break;
    if (cells.obstacle[*place] >= 0) return {range, cells.obstacle[*place]};
  }
  return {};
}

/// First obstacles of all bearings of a sensor at a stop.
std::vector<Hit> sweep(const TrueCells& cells, const Stop& stop, const Sensor& sensor) {
  const int count = static_cast<int>(2.0 * sensor.half_angle / kAngleStep) + 1;
  std::vector<Hit> hits;
  for (int i = 0; i < count; ++i) {
    const double bearing = stop.yaw - sensor.half_angle + i * kAngleStep;
    hits.push_back(first_obstacle(cells, stop.at, bearing, sensor.max_range));
  }
  return hits;
}

/// Noise that is alike within some centimetres: bilinear between random values on a lattice.
double smooth_noise(const CounterRng& random, const Vector2d& point, double scale) {
  const double x = point.x() / scale + 1000.0;
  const double y = point.y() / scale + 1000.0;
  const auto col = static_cast<std::uint64_t>(x);
  const auto row = static_cast<std::uint64_t>(y);
  const double u = x - std::floor(x);
  const double v = y - std::floor(y);
  const auto at = [&](std::uint64_t i, std::uint64_t j) {
    return random.normal_at((row + j) * 4096 + col + i);
  };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

struct Reading {
  const TableTopWorld* world;
  const TrueCells* cells;
  const Sensor* sensor;
  Stop stop;
  std::vector<Hit> hits;
  std::vector<double> range_errors;  ///< Of each bearing.
  CounterRng random;
};

/// What a camera says of a point on the plane of the table: whether its colour is the table's.
/// Behind an obstacle it sees that obstacle, as far as its height hides the plane.
double camera_log_odds(const Reading& reading,
                       const Vector2d& point,
                       double range,
                       const Hit& hit) {
  bool is_table = false;
  if (range < hit.range) {
    const auto place = TrueCells::place(point);
    if (!place) return 0.0;
    is_table = reading.cells->is_table[*place];
  } else {
    const double height = reading.world->obstacles[static_cast<std::size_t>(hit.obstacle)].height;
    const bool is_hidden =
        height >= kCameraHeight || range < hit.range * kCameraHeight / (kCameraHeight - height);
    if (!is_hidden) return 0.0;  // what stands behind may hide it again
  }
  const bool is_marked = std::ranges::any_of(
      reading.world->marks, [&](const PlanShape& mark) { return mark.holds(point); });
  if (is_marked) is_table = !is_table;
  const double strength = 1.2 - 0.6 * range / reading.sensor->max_range;
  const double noise = 0.8 * smooth_noise(reading.random, point, 0.04);
  return (is_table ? strength : -strength) + noise;
}

/// A sensor that looks down: whether the ground ahead drops.
double edge_log_odds(const Reading& reading, const Vector2d& point, double range, const Hit& hit) {
  if (range >= hit.range) return 0.0;
  const auto place = TrueCells::place(point);
  if (!place) return 0.0;
  const double noise = 0.7 * smooth_noise(reading.random, point, 0.03);
  return (reading.cells->is_table[*place] ? -0.9 : 0.9) + noise;
}

/// Free up to what the beam met, occupied there, nothing behind. Some beams come back too early,
/// some not at all.
double laser_log_odds(const Reading& reading, double range, const Hit& hit, std::uint64_t beam) {
  const double lot = reading.random.uniform_at((1U << 20U) + beam);
  if (lot < 0.02) return 0.0;
  const double end = lot < 0.03 ? hit.range * reading.random.uniform_at((1U << 21U) + beam)
                                : hit.range + reading.range_errors[beam];
  if (range < end - 0.015) return -0.6;
  return range < end + 0.015 ? 1.4 : 0.0;
}

/// What the sensor says at this place of its own grid, as it takes it to lie.
double log_odds_of(const Reading& reading, const Vector2d& local, const Mounting& mounting) {
  const Sensor& sensor = *reading.sensor;
  const double range = local.norm();
  const double bearing = std::atan2(local.y(), local.x());
  if (range < sensor.min_range || range > sensor.max_range) return 0.0;
  if (std::abs(bearing) >= sensor.half_angle) return 0.0;
  const auto beam = std::min(static_cast<std::size_t>((bearing + sensor.half_angle) / kAngleStep),
                             reading.hits.size() - 1);
  const Hit& hit = reading.hits[beam];
  if (sensor.number == kLaser.number) return laser_log_odds(reading, range, hit, beam);
  // Where the ray truly meets the plane.
  const double true_range =
      range * mounting.scale +
      reading.range_errors[beam] * (1.0 + sensor.range_noise_part / sensor.range_noise * range);
  const double yaw = reading.stop.yaw + bearing;
  const Vector2d point = reading.stop.at + true_range * Vector2d(std::cos(yaw), std::sin(yaw));
  if (sensor.number == kCamera.number) return camera_log_odds(reading, point, true_range, hit);
  return edge_log_odds(reading, point, true_range, hit);
}

LogOddsGrid grid_of(const Reading& reading, const Mounting& mounting) {
  const Sensor& sensor = *reading.sensor;
  const int side = static_cast<int>(std::ceil(2.0 * sensor.max_range / sensor.resolution));
  const GridGeometry geometry{.resolution_m = sensor.resolution,
                              .origin = Vector2d::Constant(-side * sensor.resolution / 2.0),
                              .cols = side,
                              .rows = side};
  LogOddsGrid grid = LogOddsGrid::create(geometry).value();
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      const double l = log_odds_of(reading, centre(geometry, {col, row}), mounting);
      if (l != 0.0) grid.set({col, row}, to_steps(LogOdds(l)));
    }
  }
  return grid;
}

/// Adds what one sensor says at all stops, where the map takes it to stand.
void map_with(GridStack& stack,
              const TableTopWorld& world,
              const TrueCells& cells,
              const Sensor& sensor,
              const CounterRng& seeds) {
  CounterRng random(seeds.bits_at(0), kMounting, sensor.number);
  const Mounting mounting{
      .offset = Vector2d(random.normal(), random.normal()) * sensor.offset_noise,
      .yaw = random.normal() * sensor.yaw_noise,
      .scale = 1.0 + random.normal() * sensor.scale_noise};
  for (std::size_t i = 0; i < world.stops.size(); ++i) {
    const Stop& stop = world.stops[i];
    Reading reading{.world = &world,
                    .cells = &cells,
                    .sensor = &sensor,
                    .stop = stop,
                    .hits = sweep(cells, stop, sensor),
                    .range_errors = {},
                    .random = CounterRng(seeds.bits_at(1), kReadings, sensor.number, i)};
    for (std::size_t beam = 0; beam < reading.hits.size(); ++beam) {
      reading.range_errors.push_back(reading.random.normal() * sensor.range_noise);
    }
    const Vector2d at = stop.at + Vector2d(random.normal(), random.normal()) * 0.003;
    const double yaw = stop.yaw + mounting.yaw + random.normal() * 0.003;
    Eigen::Isometry2d stack_from_sensor = Eigen::Isometry2d::Identity();
    stack_from_sensor.linear() = Eigen::Rotation2Dd(yaw).toRotationMatrix();
    stack_from_sensor.translation() = at + stack_from_sensor.linear() * mounting.offset;
    (void)stack
        .fuse({.layer = std::string(sensor.layer), .grid = grid_of(reading, mounting)},
              Eigen::Matrix3d(stack_from_sensor.matrix()))
        .value();
  }
}

/// Cells that some sensor could see, obstacles that some sensor met.
struct Visible {
  std::vector<bool> cells;
  std::vector<bool> obstacles;
};

Visible visible_parts(const TableTopWorld& world, const TrueCells& cells) {
  Visible visible{.cells = std::vector<bool>(cells.obstacle.size(), false),
                  .obstacles = std::vector<bool>(world.obstacles.size(), false)};
  for (const Stop& stop : world.stops) {
    for (const Sensor* sensor : {&kCamera, &kEdge, &kLaser}) {
      const std::vector<Hit> hits = sweep(cells, stop, *sensor);
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const double bearing = stop.yaw - sensor->half_angle + static_cast<double>(i) * kAngleStep;
        const Vector2d ahead(std::cos(bearing), std::sin(bearing));
        const int met = hits[i].obstacle;
        if (met >= 0) visible.obstacles[static_cast<std::size_t>(met)] = true;
        const double end = std::min(hits[i].range, sensor->max_range);
        for (double range = sensor->min_range; range < end; range += kRayStep) {
          const auto place = TrueCells::place(stop.at + range * ahead);
          if (place) visible.cells[*place] = true;
        }
      }
    }
  }
  return visible;
}

/// As a person draws it: what most cells within 3 cells are.
std::vector<bool> smoothed(const std::vector<bool>& marks) {
  constexpr int kReach = 3;
  const auto place = [](int col, int row) {
    return static_cast<std::size_t>(row) * kSceneSide + static_cast<std::size_t>(col);
  };
  std::vector<bool> result(marks.size(), false);
  for (int row = 0; row < kSceneSide; ++row) {
    for (int col = 0; col < kSceneSide; ++col) {
      int balance = 0;
      for (int y = std::max(row - kReach, 0); y <= std::min(row + kReach, kSceneSide - 1); ++y) {
        for (int x = std::max(col - kReach, 0); x <= std::min(col + kReach, kSceneSide - 1); ++x) {
          balance += marks[place(x, y)] ? 1 : -1;
        }
      }
      result[place(col, row)] = balance > 0;
    }
  }
  return result;
}

CellSegmentation true_segmentation(const TableTopWorld& world, const TrueCells& cells) {
  const Visible visible = visible_parts(world, cells);
  const std::vector<bool> is_seen = smoothed(visible.cells);
  CellSegmentation truth{.cols = kSceneSide, .rows = kSceneSide, .count = 4, .labels = {}};
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    const int obstacle = cells.obstacle[i];
    const bool is_met = obstacle >= 0 && visible.obstacles[static_cast<std::size_t>(obstacle)];
    const TrueClass ground = cells.is_table[i] ? kTable : kFloor;
    truth.labels.push_back(is_met ? kObstacle : is_seen[i] ? ground : kUnknown);
  }
  return truth;
}

}  // namespace

TableTopScene table_top_scene(SceneKind kind, std::uint64_t seed) {
  const TableTopWorld world = table_top_world(kind, seed);
  const TrueCells cells = true_cells(world);
  const GridGeometry geometry{.resolution_m = kSceneCellM, .cols = kSceneSide, .rows = kSceneSide};
  TableTopScene scene{.stack = GridStack::create(geometry).value(),
                      .truth = true_segmentation(world, cells)};
  const CounterRng seeds(seed, static_cast<std::uint64_t>(kind), kTexture);
  for (const Sensor* sensor : {&kCamera, &kEdge, &kLaser}) {
    map_with(scene.stack, world, cells, *sensor, seeds);
  }
  return scene;
}

}  // namespace hypermap::test
