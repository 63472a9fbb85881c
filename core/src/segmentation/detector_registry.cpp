// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/detector_registry.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxTextBytes = 256;

Result<void> check_text(std::string_view text, const char* field) {
  if (text.size() > kMaxTextBytes) {
    return fail(
        ErrorCode::kLimit, "at most 256 bytes are read, has " + std::to_string(text.size()), field);
  }
  const bool has_control =
      std::ranges::any_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (first_bad_utf8(text) == text.size() && !has_control) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be UTF-8 without control characters, is " + printable(text),
              field);
}

std::vector<std::string> canonical_classes(const DetectorDescription& description) {
  std::vector<std::string> names;
  names.reserve(description.classes.size());
  for (const std::string& name : description.classes) names.push_back(canonical_class_name(name));
  std::ranges::sort(names);
  return names;
}

bool agree(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() || a == b;
}

bool agree_on_classes(const DetectorDescription& a, const DetectorDescription& b) {
  if (a.classes.empty() || b.classes.empty()) return true;
  return canonical_classes(a) == canonical_classes(b);
}

/// The first class that one of both has and the other lacks, as a text.
std::string class_difference(const DetectorDescription& known, const DetectorDescription& other) {
  const std::vector<std::string> before = canonical_classes(known);
  for (const std::string& name : other.classes) {
    if (!std::ranges::binary_search(before, canonical_class_name(name))) {
      return " (\"" + printable(name) + "\" among them)";
    }
  }
  const std::vector<std::string> now = canonical_classes(other);
  for (const std::string& name : known.classes) {
    if (!std::ranges::binary_search(now, canonical_class_name(name))) {
      return " (\"" + printable(name) + "\" not among them)";
    }
  }
  return {};
}

/// In what two detectors of one name differ; nothing when they may be the same.
std::string difference(const DetectorDescription& known, const DetectorDescription& other) {
  if (!agree(known.type, other.type)) return "another type";
  if (!agree(known.architecture, other.architecture)) return "another architecture";
  if (agree_on_classes(known, other)) return {};
  return "other classes" + class_difference(known, other);
}

void complete(std::string& text, const std::string& other) {
  if (text.empty()) text = other;
}

}  // namespace

Result<void> validate(const DetectorDescription& description) {
  if (description.name.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must not be empty", "name");
  }
  HYPERMAP_TRY(check_text(description.name, "name"));
  HYPERMAP_TRY(check_text(description.type, "type"));
  HYPERMAP_TRY(check_text(description.architecture, "architecture"));
  const auto classes = ClassRegistry::from_names(description.classes);
  if (classes) return {};
  Error error = classes.error();
  error.field = "classes: " + error.field;
  return Unexpected(std::move(error));
}

std::string to_string(const DetectorDescription& description) {
  std::string stated;
  for (const std::string& text : {description.type, description.architecture}) {
    if (!text.empty()) stated += (stated.empty() ? "" : ", ") + printable(text);
  }
  if (!description.classes.empty()) {
    stated += (stated.empty() ? "" : ", ") + std::to_string(description.classes.size()) +
              (description.classes.size() == 1 ? " class" : " classes");
  }
  return "\"" + printable(description.name) + "\"" + (stated.empty() ? "" : " (" + stated + ")");
}

Result<DetectorId> DetectorRegistry::add(const DetectorDescription& description) {
  HYPERMAP_TRY(validate(description));
  if (const std::optional<DetectorId> id = find(description.name)) {
    DetectorDescription& known = detectors_[id->value];
    if (const std::string other = difference(known, description); !other.empty()) {
      return fail(ErrorCode::kInvalidArgument,
                  to_string(description) + " has " + other + " than the detector " +
                      to_string(known) + " of the same name; one of them needs another name",
                  "detector");
    }
    complete(known.type, description.type);
    complete(known.architecture, description.architecture);
    if (known.classes.empty()) known.classes = description.classes;
    return *id;
  }
  if (detectors_.size() >= kMaxDetectors) {
    return fail(ErrorCode::kLimit,
                "at most " + std::to_string(kMaxDetectors) + " detectors are kept",
                "detector");
  }
  detectors_.push_back(description);
  return DetectorId{static_cast<std::uint32_t>(detectors_.size() - 1)};
}

Result<DetectorId> DetectorRegistry::add_unnamed(std::string_view name,
                                                 std::span<const DetectorId> taken) {
  std::string numbered(name);
  for (std::size_t number = 2;; ++number) {
    const std::optional<DetectorId> known = find(numbered);
    if (!known || std::ranges::find(taken, *known) == taken.end()) break;
    numbered = std::string(name) + " " + std::to_string(number);
  }
  return add({.name = numbered});
}

std::optional<DetectorId> DetectorRegistry::find(std::string_view name) const {
  const auto found = std::ranges::find(detectors_, name, &DetectorDescription::name);
  if (found == detectors_.end()) return std::nullopt;
  return DetectorId{static_cast<std::uint32_t>(found - detectors_.begin())};
}

const DetectorDescription& DetectorRegistry::description(DetectorId id) const {
  assert(contains(id));
  return detectors_[id.value];
}

std::vector<std::string> DetectorRegistry::names() const {
  std::vector<std::string> names;
  names.reserve(detectors_.size());
  for (const DetectorDescription& detector : detectors_) names.push_back(detector.name);
  return names;
}

}  // namespace hypermap
