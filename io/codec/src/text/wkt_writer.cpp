// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/wkt.hpp"

#include <cstddef>
#include <string>

namespace hypermap {
namespace {

void append_ring(std::string& out, const Ring& ring) {
  out += "(";
  for (const Eigen::Vector2d& point : ring)
    out += number_text(point.x()) + " " + number_text(point.y()) + ",";
  out += number_text(ring.front().x()) + " " + number_text(ring.front().y()) + ")";
}

void append_polygon(std::string& out, const Polygon& polygon) {
  out += "(";
  append_ring(out, polygon.outer);
  for (const Ring& hole : polygon.holes) {
    out += ",";
    append_ring(out, hole);
  }
  out += ")";
}

}  // namespace

std::string write_wkt(std::span<const Polygon> parts) {
  std::string out = parts.size() == 1 ? "POLYGON" : "MULTIPOLYGON(";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) out += ",";
    append_polygon(out, parts[i]);
  }
  return parts.size() == 1 ? out : out + ")";
}

}  // namespace hypermap
