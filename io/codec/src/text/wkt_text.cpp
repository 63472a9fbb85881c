// SPDX-License-Identifier: BSD-3-Clause
#include "wkt_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
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
      if (num_vertices_ + ring.points.size() > limits_.max_vertices) return too_many_vertices();
      HYPERMAP_ASSIGN_OR_RETURN(const double x, coordinate());
      HYPERMAP_ASSIGN_OR_RETURN(const double y, coordinate());
      ring.points.emplace_back(x, y);
    } while (take(',') || lacks_comma(ring));
    HYPERMAP_TRY(expect(')'));
    ring.is_closed = ring.points.size() > 1 && ring.points.front() == ring.points.back();
    if (ring.is_closed) ring.points.pop_back();
    num_vertices_ += ring.points.size();
    if (num_vertices_ > limits_.max_vertices) return too_many_vertices();
    return ring;
  }

  [[nodiscard]] Unexpected too_many_vertices() const {
    return refuse(ErrorCode::kLimit,
                  "more than " + std::to_string(limits_.max_vertices) + " vertices");
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

}  // namespace

Result<std::vector<PolygonText>> parse_wkt(std::string_view text, const WktLimits& limits) {
  return WktParser(text, limits).parse();
}

}  // namespace hypermap
