// SPDX-License-Identifier: BSD-3-Clause
#include "feature_geometry.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <bit>

namespace hypermap {
namespace {

constexpr char kLittleEndian = 1;
constexpr std::uint32_t kWkbPolygon = 3;
constexpr std::uint32_t kWkbMultiPolygon = 6;
/// Little endian, envelope of x and y, not empty.
constexpr char kGeometryFlags = 0b0000'0011;

void append_double(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  append_uint32(bytes, static_cast<std::uint32_t>(bits));
  append_uint32(bytes, static_cast<std::uint32_t>(bits >> 32U));
}

void append_count(std::string& bytes, std::size_t count) {
  append_uint32(bytes, static_cast<std::uint32_t>(count));
}

void append_point(std::string& bytes, const Eigen::Vector2d& point) {
  append_double(bytes, point.x());
  append_double(bytes, point.y());
}

void append_ring(std::string& bytes, const Ring& ring) {
  append_count(bytes, ring.size() + 1);
  for (const Eigen::Vector2d& point : ring) append_point(bytes, point);
  append_point(bytes, ring.front());
}

void append_polygon(std::string& bytes, const Polygon& polygon) {
  bytes += kLittleEndian;
  append_uint32(bytes, kWkbPolygon);
  append_count(bytes, polygon.holes.size() + 1);
  append_ring(bytes, polygon.outer);
  for (const Ring& hole : polygon.holes) append_ring(bytes, hole);
}

}  // namespace

Rect bounds_of_parts(std::span<const Polygon> parts) {
  Rect all = bounds(parts.front());
  for (const Polygon& part : parts.subspan(1)) {
    const Rect one = bounds(part);
    all.min = all.min.cwiseMin(one.min);
    all.max = all.max.cwiseMax(one.max);
  }
  return all;
}

std::string feature_geometry(std::span<const Polygon> parts) {
  std::string bytes = "GP";
  bytes += '\0';  // version 1
  bytes += kGeometryFlags;
  append_uint32(bytes, static_cast<std::uint32_t>(kUndefinedCartesian));
  const Rect envelope = bounds_of_parts(parts);
  append_double(bytes, envelope.min.x());
  append_double(bytes, envelope.max.x());
  append_double(bytes, envelope.min.y());
  append_double(bytes, envelope.max.y());
  bytes += kLittleEndian;
  append_uint32(bytes, kWkbMultiPolygon);
  append_count(bytes, parts.size());
  for (const Polygon& part : parts) append_polygon(bytes, part);
  return bytes;
}

}  // namespace hypermap
