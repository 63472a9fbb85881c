// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_registry.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNameBytes = 256;
constexpr std::size_t kMaxClasses = 65535;

/// COCO 2017's names, spaces removed, and the VOC style name of the same class.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kVocNameOf{{
    {"tv", "tvmonitor"},
    {"couch", "sofa"},
    {"motorcycle", "motorbike"},
    {"airplane", "aeroplane"},
}};

bool is_separator(char c) {
  return c == ' ' || c == '-' || c == '_';
}

Result<void> check_name(std::string_view name) {
  if (name.empty()) return fail(ErrorCode::kInvalidArgument, "must not be empty", "class name");
  if (name.size() > kMaxNameBytes) {
    return fail(ErrorCode::kLimit,
                "at most 256 bytes are read, has " + std::to_string(name.size()),
                "class name");
  }
  if (first_bad_utf8(name) == name.size() && name.find('\0') == std::string_view::npos) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be UTF-8 without NUL, is " + printable(name),
              "class name");
}

}  // namespace

std::string folded_class_name(std::string_view name) {
  std::string out;
  out.reserve(name.size());
  for (const char c : name) {
    if (!is_separator(c)) out.push_back(lower_ascii(c));
  }
  return out;
}

std::string canonical_class_name(std::string_view name) {
  std::string out = folded_class_name(name);
  const auto* alias = std::find_if(
      kVocNameOf.begin(), kVocNameOf.end(), [&](const auto& entry) { return entry.first == out; });
  return alias == kVocNameOf.end() ? out : std::string(alias->second);
}

bool is_spelling_of(std::string_view a, std::string_view b) {
  return a == b || canonical_class_name(a) == canonical_class_name(b);
}

Result<ClassRegistry> ClassRegistry::from_names(std::span<const std::string> names) {
  ClassRegistry registry;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string field = "names[" + std::to_string(i) + "]";
    auto id = registry.add(names[i]);
    if (!id) {
      id.error().field = field;
      return Unexpected(std::move(id).error());
    }
    if (id->value != i) {
      return fail(ErrorCode::kInvalidArgument,
                  "must name each class once, " + printable(names[i]) + " is that of names[" +
                      std::to_string(id->value) + "]",
                  field);
    }
  }
  return registry;
}

Result<ClassId> ClassRegistry::add(std::string_view name) {
  HYPERMAP_TRY(check_name(name));
  if (const std::optional<ClassId> known = find(name)) return *known;
  if (names_.size() >= kMaxClasses) {
    return fail(ErrorCode::kLimit, "at most 65535 classes are kept", printable(name));
  }
  const ClassId id{static_cast<std::uint32_t>(names_.size())};
  id_of_canonical_.emplace(canonical_class_name(name), id);
  names_.emplace_back(name);
  return id;
}

std::optional<ClassId> ClassRegistry::find(std::string_view name) const {
  const auto found = id_of_canonical_.find(canonical_class_name(name));
  if (found == id_of_canonical_.end()) return std::nullopt;
  return found->second;
}

const std::string& ClassRegistry::name(ClassId id) const {
  assert(contains(id));
  return names_[id.value];
}

}  // namespace hypermap
