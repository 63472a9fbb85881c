// SPDX-License-Identifier: BSD-3-Clause
#include "gltf_document.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/codec/number_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

// Of the specification: component types, targets of buffer views, types of chunks.
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kVersion = 2;
constexpr std::string_view kJsonChunk = "JSON";
constexpr std::string_view kBinaryChunk{"BIN\0", 4};
constexpr std::uint32_t kRestart = 65535;  // restarts primitives where indices have 16 bits

// The buffer views, in their order in the file.
constexpr std::size_t kPositionsView = 0;
constexpr std::size_t kIndicesView = 1;
constexpr std::size_t kPositionBytes = 12;

template <class Vector>
std::string numbers(const Vector& values) {
  return json_array(values, [](auto value) { return json_number(static_cast<double>(value)); });
}

std::string texts(const std::vector<std::string>& values) {
  return json_array(values, [](const std::string& value) { return value; });
}

std::string number(std::size_t value) {
  return std::to_string(value);
}

/// Colours of images follow the curve of sRGB, factors of materials are linear.
double linear(std::uint8_t part) {
  const double value = part / 255.0;
  const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return std::round(light * 1e6) / 1e6;
}

void add_member(std::string& object, std::string_view key, const std::string& value) {
  object.insert(object.size() - 1, ",\"" + std::string(key) + "\":" + value);
}

void pad(std::string& bytes, char filler) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
}

void append_chunk_head(std::string& bytes, std::string_view type, std::size_t size) {
  append_uint32(bytes, static_cast<std::uint32_t>(size));
  bytes += type;
}

}  // namespace

std::size_t GltfDocument::add_material(const std::string& name, Rgb8 color, double opacity) {
  const std::array<double, 4> factor{linear(color.r), linear(color.g), linear(color.b), opacity};
  std::string material = json_object({{"name", json_quoted(name)},
                                      {"pbrMetallicRoughness",
                                       json_object({{"baseColorFactor", numbers(factor)},
                                                    {"metallicFactor", "0"},
                                                    {"roughnessFactor", "1"}})}});
  if (opacity < 1.0) add_member(material, "alphaMode", "\"BLEND\"");
  materials_.push_back(std::move(material));
  return materials_.size() - 1;
}

std::size_t GltfDocument::add_positions(std::span<const Eigen::Vector3f> positions) {
  const std::size_t offset = positions_.size();
  Eigen::Vector3f low = positions.front();
  Eigen::Vector3f high = positions.front();
  for (const Eigen::Vector3f& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
    positions_ += bytes_of_floats({position.data(), 3});
  }
  accessors_.push_back(json_object({{"bufferView", number(kPositionsView)},
                                    {"byteOffset", number(offset)},
                                    {"componentType", std::to_string(kFloat)},
                                    {"count", number(positions.size())},
                                    {"type", "\"VEC3\""},
                                    {"min", numbers(low)},
                                    {"max", numbers(high)}}));
  return accessors_.size() - 1;
}

std::size_t GltfDocument::add_indices(std::span<const std::uint32_t> indices) {
  const std::size_t offset = indices_.size();
  const bool is_short = *std::ranges::max_element(indices) < kRestart;
  for (const std::uint32_t index : indices) {
    if (is_short) {
      indices_ += {static_cast<char>(index & 0xFFU), static_cast<char>(index >> 8U)};
    } else {
      append_uint32(indices_, index);
    }
  }
  pad(indices_, '\0');
  accessors_.push_back(
      json_object({{"bufferView", number(kIndicesView)},
                   {"byteOffset", number(offset)},
                   {"componentType", std::to_string(is_short ? kUnsignedShort : kUnsignedInt)},
                   {"count", number(indices.size())},
                   {"type", "\"SCALAR\""}}));
  return accessors_.size() - 1;
}

std::size_t GltfDocument::add_mesh(const std::string& name,
                                   std::span<const GltfPrimitive> primitives) {
  const std::string parts = json_array(primitives, [](const GltfPrimitive& primitive) {
    return json_object({{"attributes", json_object({{"POSITION", number(primitive.positions)}})},
                        {"indices", number(primitive.indices)},
                        {"material", number(primitive.material)}});
  });
  meshes_.push_back(json_object({{"name", json_quoted(name)}, {"primitives", parts}}));
  return meshes_.size() - 1;
}

std::size_t GltfDocument::add_node(const GltfNode& node) {
  std::string text = json_object({{"name", json_quoted(node.name)}});
  if (!node.translation.isZero(0.0)) add_member(text, "translation", numbers(node.translation));
  if (node.rotation) add_member(text, "rotation", numbers(*node.rotation));
  if (node.mesh) add_member(text, "mesh", number(*node.mesh));
  if (!node.children.empty()) add_member(text, "children", json_array(node.children, number));
  if (!node.extras.empty()) add_member(text, "extras", node.extras);
  nodes_.push_back(std::move(text));
  return nodes_.size() - 1;
}

std::string GltfDocument::json(std::size_t root) const {
  const std::string views = "[" +
                            json_object({{"buffer", "0"},
                                         {"byteLength", number(positions_.size())},
                                         {"byteStride", number(kPositionBytes)},
                                         {"target", std::to_string(kArrayBuffer)}}) +
                            "," +
                            json_object({{"buffer", "0"},
                                         {"byteOffset", number(positions_.size())},
                                         {"byteLength", number(indices_.size())},
                                         {"target", std::to_string(kElementArrayBuffer)}}) +
                            "]";
  const std::string buffer =
      json_object({{"byteLength", number(positions_.size() + indices_.size())}});
  return json_object(
      {{"asset", json_object({{"version", "\"2.0\""}, {"generator", "\"hypermap\""}})},
       {"scene", "0"},
       {"scenes", "[" + json_object({{"nodes", "[" + number(root) + "]"}}) + "]"},
       {"nodes", texts(nodes_)},
       {"meshes", texts(meshes_)},
       {"materials", texts(materials_)},
       {"accessors", texts(accessors_)},
       {"bufferViews", views},
       {"buffers", "[" + buffer + "]"}});
}

Result<std::string> GltfDocument::glb(std::size_t root) const {
  constexpr std::uint64_t kHeaderBytes = 12;
  constexpr std::uint64_t kChunkHeaderBytes = 8;
  std::string text = json(root);
  pad(text, ' ');
  const std::uint64_t binary_size = positions_.size() + indices_.size();
  const std::uint64_t size = kHeaderBytes + 2 * kChunkHeaderBytes + text.size() + binary_size;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kLimit,
                "would take " + std::to_string(size) + " bytes, a GLB has less than 2^32",
                "--output");
  }
  std::string bytes;
  bytes.reserve(size);
  bytes += kMagic;
  append_uint32(bytes, kVersion);
  append_uint32(bytes, static_cast<std::uint32_t>(size));
  append_chunk_head(bytes, kJsonChunk, text.size());
  bytes += text;
  append_chunk_head(bytes, kBinaryChunk, binary_size);
  bytes += positions_;
  bytes += indices_;
  return bytes;
}

}  // namespace hypermap
