// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"

#include <CLI/StringTools.hpp>

#include <algorithm>
#include <utility>

namespace hypermap::app {

namespace {

/// By case alone, else by any spelling that is one name's only: "-x" is not "x".
const std::string* meant_name(const std::vector<std::string>& names, const std::string& text) {
  const auto same = std::ranges::find(names, CLI::detail::to_lower(text), CLI::detail::to_lower);
  if (same != names.end()) return &*same;
  const auto is_spelt = [&](const std::string& name) { return is_spelling_of(name, text); };
  const auto spelt = std::ranges::find_if(names, is_spelt);
  return std::ranges::count_if(names, is_spelt) == 1 ? &*spelt : nullptr;
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> names) {
  const std::string description = "{" + CLI::detail::join(names, ",") + "}";
  const auto check = [names = std::move(names)](std::string& text) -> std::string {
    const std::string* meant = meant_name(names, text);
    if (meant == nullptr) return not_one_of(text, names);
    text = *meant;
    return "";
  };
  return {check, description, "choice"};
}

CLI::Validator one_of(std::span<const std::string_view> names) {
  return one_of(std::vector<std::string>(names.begin(), names.end()));
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(":{");
  if (begin == std::string::npos || !type.ends_with('}')) return {};
  return CLI::detail::split(type.substr(begin + 2, type.size() - begin - 3), ',');
}

}  // namespace hypermap::app
