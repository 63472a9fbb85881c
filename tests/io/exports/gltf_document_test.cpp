// SPDX-License-Identifier: BSD-3-Clause
#include "gltf_document.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

struct GlbParts {
  nlohmann::json json;
  std::string binary;
};

/// The two chunks. Source: glTF 2.0 Specification, section 4.4.
GlbParts glb_parts(const std::string& glb) {
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(uint32_at(glb, 4), 2U);
  EXPECT_EQ(uint32_at(glb, 8), glb.size());
  const std::size_t json_size = uint32_at(glb, 12);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(json_size % 4, 0U);
  const std::size_t binary_size = uint32_at(glb, 20 + json_size);
  EXPECT_EQ(glb.substr(24 + json_size, 4), std::string("BIN\0", 4));
  EXPECT_EQ(28 + json_size + binary_size, glb.size());
  EXPECT_EQ(binary_size % 4, 0U);
  return {.json = nlohmann::json::parse(glb.substr(20, json_size)),
          .binary = glb.substr(28 + json_size)};
}

/// A triangle with `num_points` positions, of which the last three are used.
GlbParts triangle_among(std::size_t num_points, const std::string& name) {
  GltfDocument document;
  std::vector<Eigen::Vector3f> positions(num_points, Eigen::Vector3f(0.0F, -1.5F, 0.25F));
  positions.back() = {1.0F, 2.0F, 0.25F};
  const auto last = static_cast<std::uint32_t>(num_points - 1);
  const std::vector<std::uint32_t> triangle{last - 2, last - 1, last};
  const std::vector<GltfPrimitive> primitives{
      {.positions = document.add_positions(positions),
       .indices = document.add_indices(triangle),
       .material = document.add_material(name, Rgb8{255, 0, 188}, 0.5)}};
  GltfNode node{.name = name, .translation = {1.0, 0.0, -2.0}};
  node.mesh = document.add_mesh(name, primitives);
  node.extras = R"({"id":7})";
  return glb_parts(document.glb(document.add_node(node)).value());
}

TEST(GltfDocument, ATriangleByHand) {
  const auto [json, binary] = triangle_among(3, "t");
  // Three positions of 12 bytes, three indices of 2 and two bytes of filler.
  EXPECT_EQ(json.at("buffers"), nlohmann::json::parse(R"([{"byteLength": 44}])"));
  EXPECT_EQ(json.at("bufferViews"), nlohmann::json::parse(R"([
    {"buffer": 0, "byteLength": 36, "byteStride": 12, "target": 34962},
    {"buffer": 0, "byteOffset": 36, "byteLength": 8, "target": 34963}])"));
  EXPECT_EQ(json.at("accessors"), nlohmann::json::parse(R"([
    {"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": 3, "type": "VEC3",
     "min": [0.0, -1.5, 0.25], "max": [1.0, 2.0, 0.25]},
    {"bufferView": 1, "byteOffset": 0, "componentType": 5123, "count": 3, "type": "SCALAR"}])"));
  EXPECT_EQ(json.at("nodes"), nlohmann::json::parse(R"([
    {"name": "t", "translation": [1.0, 0.0, -2.0], "mesh": 0, "extras": {"id": 7}}])"));
  EXPECT_EQ(binary.substr(36), std::string("\0\0\1\0\2\0\0\0", 8));
  EXPECT_EQ(floats_of_bytes(binary.substr(0, 12)).value(), (std::vector<float>{0, -1.5F, 0.25F}));
}

// sRGB 188 is half of the light: ((188/255 + 0.055) / 1.055)^2.4 = 0.502886.
TEST(GltfDocument, ColoursAreLinear) {
  const nlohmann::json material = triangle_among(3, "t").json.at("materials").at(0);
  EXPECT_EQ(material.at("pbrMetallicRoughness").at("baseColorFactor"),
            nlohmann::json::parse("[1.0, 0.0, 0.502886, 0.5]"));
  EXPECT_EQ(material.at("alphaMode"), "BLEND");
}

// 65,535 restarts primitives, so it is no index of 16 bits.
TEST(GltfDocument, IndicesAreLongWhereTheyHaveToBe) {
  EXPECT_EQ(triangle_among(65535, "t").json.at("accessors").at(1).at("componentType"), 5123);
  EXPECT_EQ(triangle_among(65536, "t").json.at("accessors").at(1).at("componentType"), 5125);
}

TEST(GltfDocument, AnyTextIsAName) {
  for (const char* name : {"a \"b\"\n\\", "Stühle", "\x01", "</script>"}) {
    EXPECT_EQ(triangle_among(3, name).json.at("nodes").at(0).at("name"), name);
  }
}

}  // namespace
}  // namespace hypermap
