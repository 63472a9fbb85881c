// SPDX-License-Identifier: BSD-3-Clause
#include "zip_extra_fields.hpp"

#include "zip_format.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace hypermap::zip {
namespace {

Unexpected bad_extra(std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what));
}

/// The data of the field; none where there is none.
Result<std::optional<std::string_view>> zip64_field(std::string_view extra) {
  std::optional<std::string_view> found;
  while (!extra.empty()) {
    const std::string_view data = extra.substr(4, get16(extra, 2));
    if (get16(extra, 0) == kExtraZip64) {
      if (found) return bad_extra("zip64: two extra fields");
      found = data;
    }
    extra.remove_prefix(4 + data.size());
  }
  return found;
}

}  // namespace

Result<void> check_extra(std::string_view extra, std::string_view name) {
  while (!extra.empty()) {
    if (extra.size() < 4 || extra.size() - 4 < get16(extra, 2))
      return bad_extra("damaged extra field");
    const std::string_view data = extra.substr(4, get16(extra, 2));
    if (get16(extra, 0) == kExtraUnicodeName && (data.size() < 5 || data.substr(5) != name))
      return bad_extra("extra field gives the member another name");
    extra.remove_prefix(4 + data.size());
  }
  return {};
}

Result<std::vector<std::uint64_t>> wide_numbers(std::string_view extra,
                                                std::initializer_list<std::uint32_t> numbers) {
  std::vector<std::uint64_t> wide(numbers.begin(), numbers.end());
  const auto num_marked = static_cast<std::size_t>(std::ranges::count(wide, kZip64Marker32));
  HYPERMAP_ASSIGN_OR_RETURN(const auto data, zip64_field(extra));
  if (!data && num_marked == 0) return wide;
  if (!data) return bad_extra("zip64: a number is marked that no extra field gives");
  if (num_marked == 0 || data->size() != 8 * num_marked) {
    return bad_extra("zip64: extra field of " + std::to_string(data->size()) + " bytes for " +
                     std::to_string(num_marked) + " marked numbers of 8");
  }
  std::size_t at = 0;
  for (std::uint64_t& number : wide) {
    if (number != kZip64Marker32) continue;
    number = get64(*data, at);
    at += 8;
  }
  return wide;
}

}  // namespace hypermap::zip
