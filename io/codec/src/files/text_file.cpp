// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A decimal number taken apart: digits without point, times ten to `exponent`.
struct Decimal {
  std::string digits;
  long exponent = 0;
  bool has_exponent = false;
};

std::optional<long> parse_exponent(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  long value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size() || std::abs(value) > 400) {
    return std::nullopt;
  }
  return value;
}

std::optional<Decimal> take_apart(std::string_view text) {
  Decimal out;
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) {
    const auto exponent = parse_exponent(text.substr(e + 1));
    if (!exponent) return std::nullopt;
    out.exponent = *exponent;
    out.has_exponent = true;
    text = text.substr(0, e);
  }
  const std::size_t point = text.find('.');
  out.digits = text.substr(0, point);
  if (point != std::string_view::npos) {
    out.digits += text.substr(point + 1);
    out.exponent -= static_cast<long>(text.size() - point - 1);
  }
  if (out.digits.empty() || !std::all_of(out.digits.begin(), out.digits.end(), is_digit)) {
    return std::nullopt;
  }
  return out;
}

/// digits * 10^(exponent + shift), rounded to the nearest; none when it does not fit.
std::optional<std::int64_t> scaled(const Decimal& decimal, long shift) {
  std::string digits = decimal.digits;
  const long places = decimal.exponent + shift;
  bool round_up = false;
  if (places >= 0) {
    digits.append(static_cast<std::size_t>(places), '0');
  } else if (static_cast<std::size_t>(-places) > digits.size()) {
    digits = "0";
  } else {
    const std::size_t kept = digits.size() - static_cast<std::size_t>(-places);
    round_up = digits[kept] >= '5';
    digits = kept == 0 ? "0" : digits.substr(0, kept);
  }
  std::int64_t value = 0;
  const auto [end, ec] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (ec != std::errc{} || value == std::numeric_limits<std::int64_t>::max()) return std::nullopt;
  return value + (round_up ? 1 : 0);
}

}  // namespace

std::vector<TextLine> split_lines(std::string_view text) {
  std::vector<TextLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back({number, line});
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return lines;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const std::size_t first = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    words.push_back(line.substr(first, at - first));
  }
  return words;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> parse_double(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parse_unsigned(std::string_view text) {
  std::uint64_t value = 0;
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<ParsedStamp> parse_stamp(std::string_view text) {
  const auto refuse = [&](std::string_view rule) {
    return fail(ErrorCode::kMalformedFile,
                "must be " + std::string(rule) + ", is " + printable(text, 60),
                "timestamp");
  };
  if (text.size() > 64) return refuse("a number of at most 64 digits");
  if (text.starts_with('-')) return refuse("0 or more");
  const auto decimal = take_apart(text);
  if (!decimal) return refuse("a finite decimal number");
  if (const auto seconds = scaled(*decimal, 9)) return ParsedStamp{.stamp = {*seconds}};
  const auto ns = scaled(*decimal, 0);
  constexpr std::int64_t kLeastNanoseconds = 100'000'000'000'000'000;
  if (!ns || *ns < kLeastNanoseconds)
    return refuse("seconds or nanoseconds (below 9.2e9, or 1e17 and more)");
  return ParsedStamp{
      .stamp = {*ns}, .is_in_nanoseconds = true, .is_rounded = decimal->has_exponent};
}

std::string stamp_text(Stamp stamp) {
  std::string fraction = std::to_string(stamp.ns % kNanosecondsPerSecond);
  fraction.insert(0, 9 - fraction.size(), '0');
  while (fraction.size() > 1 && fraction.ends_with('0')) fraction.pop_back();
  return std::to_string(stamp.ns / kNanosecondsPerSecond) + "." + fraction;
}

}  // namespace hypermap
