// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One node of an `.ot` file, byte for byte.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {

// The format has the byte order of the machine that wrote it, in practice little endian.
static_assert(std::endian::native == std::endian::little, "OctoMap files are little endian");

inline constexpr int kOctomapDepth = 16;
/// What 16 bits of 0.001 can hold.
inline constexpr float kMaxLogOdds = 32.767F;
/// OctoMap's "no colour".
inline constexpr Rgb8 kNoColor{.r = 255, .g = 255, .b = 255};

/// Requires: at + sizeof(T) <= bytes.size().
template <class T>
[[nodiscard]] T load(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

template <class T>
void store(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// A label as `.ot` files of SemanticOcTree have it; see write_octomap.
struct StoredLabel {
  std::uint32_t object = 0;
  std::uint16_t object_votes = 0;
  MilliLogOdds rest = 0;
  std::array<ClassWeight, VoxelLabel::kNumClasses> classes = {};
};
static_assert(sizeof(StoredLabel) == 20 && sizeof(ClassWeight) == 4);

/// A blank label stands for none.
[[nodiscard]] inline StoredLabel stored_label(const VoxelLabel* label) {
  if (label == nullptr) return {};
  return {.object = label->object.value,
          .object_votes = label->object_votes,
          .rest = label->rest,
          .classes = label->classes};
}
[[nodiscard]] inline bool is_blank(const StoredLabel& stored) {
  static constexpr StoredLabel kBlank{};
  return std::memcmp(&stored, &kBlank, sizeof(stored)) == 0;
}
[[nodiscard]] inline std::optional<VoxelLabel> label_of(const StoredLabel& stored) {
  if (is_blank(stored)) return std::nullopt;
  VoxelLabel label;
  label.classes = stored.classes;
  label.rest = stored.rest;
  label.object_votes = stored.object_votes;
  label.object = ObjectId{stored.object};
  if (label == VoxelLabel{}) return std::nullopt;
  return label;
}

/// Log-odds, what the kind of tree keeps besides, the byte of children.
[[nodiscard]] inline std::size_t node_bytes(OctomapKind kind) {
  std::size_t payload = 0;
  if (kind == OctomapKind::kColor) payload = sizeof(Rgb8);
  if (kind == OctomapKind::kSemantic) payload = sizeof(StoredLabel);
  return sizeof(float) + payload + sizeof(std::uint8_t);
}

}  // namespace hypermap
