// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hypermap::app {
namespace {

/// Characters, not bytes: names are UTF-8.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string padded(const std::string& cell, std::size_t wanted, bool left_aligned) {
  const std::string blanks(wanted - width(cell), ' ');
  return left_aligned ? cell + blanks : blanks + cell;
}

}  // namespace

std::string fixed(const std::optional<double>& value, int digits) {
  if (!value) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, *value);
  return text;
}

std::pair<std::string, std::string> fixed_apart(double a, double b) {
  constexpr int kMostDigits = 9;
  int digits = 2;
  while (a != b && digits < kMostDigits && fixed(a, digits) == fixed(b, digits)) ++digits;
  return {fixed(a, digits), fixed(b, digits)};
}

Table::Table(std::vector<std::string> heading, LastColumn last) : last_(last) {
  rows_.push_back(std::move(heading));
}

void Table::add(std::vector<std::string> row) {
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += "  ";
      const bool is_text = i == 0 || (i + 1 == row.size() && last_ == LastColumn::kText);
      line += padded(row[i], widths[i], is_text);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace hypermap::app
