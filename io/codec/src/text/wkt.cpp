// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/wkt.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <new>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 9> kOtherGeometries = {"POINT",
                                                              "LINESTRING",
                                                              "MULTIPOINT",
                                                              "MULTILINESTRING",
                                                              "GEOMETRYCOLLECTION",
                                                              "TRIANGLE",
                                                              "TIN",
                                                              "CURVEPOLYGON",
                                                              "SRID"};

bool is_wkt_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return out;
}

struct RingText {
  Ring points;
  std::size_t column = 1;
  std::size_t missing_commas = 0;
};
using PolygonText = std::vector<RingText>;  // outer ring first

/// Reads the text from front to back; nesting is fixed by the grammar, so nothing recurs.
class WktParser {
 public:
  WktParser(std::string_view text, const WktLimits& limits) : text_(text), limits_(limits) {}

  [[nodiscard]] Result<std::vector<PolygonText>> parse() {
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_multi, keyword());
    std::vector<PolygonText> polygons;
    if (is_multi) HYPERMAP_TRY(expect('('));
    do {
      if (polygons.size() == limits_.max_parts) {
        return refuse(ErrorCode::kLimit,
                      "more than " + std::to_string(limits_.max_parts) + " parts");
      }
      HYPERMAP_ASSIGN_OR_RETURN(PolygonText polygon, polygon_text());
      polygons.push_back(std::move(polygon));
    } while (is_multi && take(','));
    if (is_multi) HYPERMAP_TRY(expect(')'));
    skip_blanks();
    if (at_ < text_.size()) return refuse(ErrorCode::kMalformedFile, "text follows: " + shown());
    return polygons;
  }

 private:
  [[nodiscard]] Result<bool> keyword() {
    skip_blanks();
    std::size_t end = at_;
    while (end < text_.size() && is_letter(text_[end])) ++end;
    const std::string word = upper(text_.substr(at_, end - at_));
    if (word == "POLYGON" || word == "MULTIPOLYGON") {
      at_ = end;
      return word == "MULTIPOLYGON";
    }
    const bool is_other =
        std::find(kOtherGeometries.begin(), kOtherGeometries.end(), word) != kOtherGeometries.end();
    if (is_other) {
      return refuse(ErrorCode::kUnsupported,
                    word + " is not read, expected POLYGON or MULTIPOLYGON");
    }
    return refuse(ErrorCode::kMalformedFile,
                  "is " + shown() + ", expected POLYGON or MULTIPOLYGON");
  }

  [[nodiscard]] Result<PolygonText> polygon_text() {
    PolygonText rings;
    HYPERMAP_TRY(expect('('));
    do {
      if (rings.size() > limits_.max_holes) {
        return refuse(ErrorCode::kLimit,
                      "more than " + std::to_string(limits_.max_holes) + " holes");
      }
      HYPERMAP_ASSIGN_OR_RETURN(RingText ring, ring_text());
      rings.push_back(std::move(ring));
    } while (take(','));
    HYPERMAP_TRY(expect(')'));
    return rings;
  }

  [[nodiscard]] Result<RingText> ring_text() {
    skip_blanks();
    RingText ring{.points = {}, .column = at_ + 1};
    HYPERMAP_TRY(expect('('));
    do {
      if (++num_vertices_ > limits_.max_vertices) {
        return refuse(ErrorCode::kLimit,
                      "more than " + std::to_string(limits_.max_vertices) + " vertices");
      }
      HYPERMAP_ASSIGN_OR_RETURN(const double x, coordinate());
      HYPERMAP_ASSIGN_OR_RETURN(const double y, coordinate());
      ring.points.emplace_back(x, y);
    } while (take(',') || lacks_comma(ring));
    HYPERMAP_TRY(expect(')'));
    return ring;
  }

  /// Whether two more numbers follow a point where a comma should stand, as in "0 0, 1 0 1 1": one
  /// hand-made map has that, once. Three numbers are a point in space, and so are four each time:
  /// both are refused.
  [[nodiscard]] bool lacks_comma(RingText& ring) {
    const std::size_t before = at_;
    const bool two_numbers = coordinate() && coordinate();
    skip_blanks();
    const bool ends = at_ < text_.size() && (text_[at_] == ',' || text_[at_] == ')');
    at_ = before;
    if (!two_numbers || !ends || ring.missing_commas > 0) return false;
    ++ring.missing_commas;
    return true;
  }

  /// A decimal number that ends at a blank, a comma or a bracket.
  [[nodiscard]] Result<double> coordinate() {
    skip_blanks();
    std::string_view rest = text_.substr(at_);
    if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
    double value = 0.0;
    const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    const auto used = static_cast<std::size_t>(end.ptr - rest.data());
    const bool ends = used == rest.size() || is_wkt_blank(rest[used]) || rest[used] == ',' ||
                      rest[used] == ')' || rest[used] == '(';
    if (end.ec != std::errc() || !ends || !std::isfinite(value)) {
      return refuse(ErrorCode::kMalformedFile, "is " + shown() + ", expected a finite number");
    }
    at_ = text_.size() - rest.size() + used;
    return value;
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_wkt_blank(text_[at_])) ++at_;
  }
  [[nodiscard]] bool take(char wanted) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }
  [[nodiscard]] Result<void> expect(char wanted) {
    if (take(wanted)) return {};
    return refuse(ErrorCode::kMalformedFile,
                  "is " + shown() + ", expected '" + std::string(1, wanted) + "'");
  }
  [[nodiscard]] std::string shown() const {
    if (at_ == text_.size()) return "the end";
    return "'" + printable(text_.substr(at_, 20)) + "'";
  }
  [[nodiscard]] Unexpected refuse(ErrorCode code, const std::string& what) const {
    return fail(code, "column " + std::to_string(at_ + 1) + ": " + what);
  }

  std::string_view text_;
  WktLimits limits_;
  std::size_t at_ = 0;
  std::size_t num_vertices_ = 0;
};

Unexpected bad_shape(const Error& error, std::size_t column) {
  const ErrorCode code =
      error.code == ErrorCode::kInvalidArgument ? ErrorCode::kMalformedFile : error.code;
  return fail(code, "column " + std::to_string(column) + ": " + error.what);
}

bool is_unclosed(const RingText& ring) {
  return ring.points.size() > 1 && ring.points.front() != ring.points.back();
}

Result<Polygon> polygon_of(const PolygonText& rings) {
  std::vector<Ring> holes;
  for (std::size_t i = 1; i < rings.size(); ++i) holes.push_back(rings[i].points);
  return make_polygon(rings.front().points, std::move(holes));
}

/// The same rings without spikes; counts those that had some.
Result<PolygonText> spike_free(PolygonText rings, std::size_t& num_spiked) {
  for (RingText& ring : rings) {
    auto clean = without_spikes(std::move(ring.points));
    if (!clean) return bad_shape(clean.error(), ring.column);
    if (clean->had_spikes) ++num_spiked;
    ring.points = std::move(clean->ring);
  }
  return rings;
}

Result<void> append_winding_fill(WktShape& shape, const RingText& ring) {
  auto fill = resolve_winding(ring.points);
  if (!fill) return bad_shape(fill.error(), ring.column);
  ++shape.wound_rings;
  if (fill->had_spikes) ++shape.spiked_rings;
  std::move(fill->parts.begin(), fill->parts.end(), std::back_inserter(shape.parts));
  return {};
}

/// A polygon is what it says, spikes apart; a single ring that is none by itself may stand for its
/// winding fill.
Result<void> append_parts(WktShape& shape, const PolygonText& rings) {
  const auto unclosed = std::count_if(rings.begin(), rings.end(), is_unclosed);
  shape.unclosed_rings += static_cast<std::size_t>(unclosed);
  for (const RingText& ring : rings) shape.missing_commas += ring.missing_commas;
  auto polygon = polygon_of(rings);
  if (!polygon) {
    HYPERMAP_ASSIGN_OR_RETURN(const PolygonText mended, spike_free(rings, shape.spiked_rings));
    polygon = polygon_of(mended);
    if (!polygon && rings.size() == 1) return append_winding_fill(shape, mended.front());
  }
  if (!polygon) return bad_shape(polygon.error(), rings.front().column);
  shape.parts.push_back(*std::move(polygon));
  return {};
}

bool overlap(const Polygon& a, const Polygon& b) {
  constexpr double kRounding = 1e-12;
  const Rect box_a = bounds(a);
  const Rect box_b = bounds(b);
  const bool may = (box_a.min.array() < box_b.max.array()).all() &&
                   (box_b.min.array() < box_a.max.array()).all();
  return may && jaccard(a, b) > kRounding;
}

Result<void> check_disjoint(const std::vector<Polygon>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!overlap(parts[i], parts[j])) continue;
      return fail(ErrorCode::kMalformedFile,
                  "column 1: parts " + std::to_string(j) + " and " + std::to_string(i) +
                      " of the MULTIPOLYGON overlap");
    }
  }
  return {};
}

std::string number(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return std::string(digits.data(), end.ptr);
}

void append_ring(std::string& out, const Ring& ring) {
  out += "(";
  for (const Eigen::Vector2d& point : ring)
    out += number(point.x()) + " " + number(point.y()) + ",";
  out += number(ring.front().x()) + " " + number(ring.front().y()) + ")";
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

Result<WktShape> read_wkt(std::string_view text, const WktLimits& limits) {
  try {
    HYPERMAP_ASSIGN_OR_RETURN(const auto polygons, WktParser(text, limits).parse());
    WktShape shape;
    for (const PolygonText& rings : polygons) HYPERMAP_TRY(append_parts(shape, rings));
    if (polygons.size() > 1) HYPERMAP_TRY(check_disjoint(shape.parts));
    return shape;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the shape");
  }
}

std::string write_wkt(std::span<const Polygon> parts) {
  std::string out = parts.size() == 1 ? "POLYGON" : "MULTIPOLYGON(";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) out += ",";
    append_polygon(out, parts[i]);
  }
  return parts.size() == 1 ? out : out + ")";
}

}  // namespace hypermap
