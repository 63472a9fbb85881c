// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// ONNX models of a few hundred bytes, written without a protobuf library.
///
/// Source: onnx.proto3 of ONNX 1.7 (field numbers in the comments).
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::test {

inline std::string varint(std::uint64_t value) {
  std::string out;
  for (; value >= 0x80U; value >>= 7U) out.push_back(static_cast<char>(0x80U | (value & 0x7FU)));
  out.push_back(static_cast<char>(value));
  return out;
}

inline std::string number_field(unsigned field, std::uint64_t value) {
  return varint(std::uint64_t{field} << 3U) + varint(value);
}

inline std::string bytes_field(unsigned field, std::string_view bytes) {
  return varint((std::uint64_t{field} << 3U) | 2U) + varint(bytes.size()) + std::string(bytes);
}

/// Little-endian bytes of numbers of four or eight bytes.
template <class Bits>
std::string raw_bytes(const std::vector<Bits>& values) {
  std::string out;
  for (Bits value : values) {
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      out.push_back(static_cast<char>(value & 0xFFU));
      value >>= 8U;
    }
  }
  return out;
}

/// TensorProto: dims 1, data_type 2 (1 float, 7 int64), name 8, raw_data 9.
inline std::string tensor(std::string_view name,
                          const std::vector<std::int64_t>& dims,
                          std::uint64_t type,
                          const std::string& raw) {
  std::string out;
  for (const std::int64_t dim : dims) out += number_field(1, static_cast<std::uint64_t>(dim));
  return out + number_field(2, type) + bytes_field(8, name) + bytes_field(9, raw);
}

inline std::string float_tensor(std::string_view name,
                                const std::vector<std::int64_t>& dims,
                                const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  bits.reserve(values.size());
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return tensor(name, dims, 1, raw_bytes(bits));
}

/// NodeProto: input 1, output 2, name 3, op_type 4, attribute 5.
inline std::string node(const std::vector<std::string>& inputs,
                        std::string_view output,
                        std::string_view operation) {
  std::string out;
  for (const std::string& input : inputs) out += bytes_field(1, input);
  return out + bytes_field(2, output) + bytes_field(3, output) + bytes_field(4, operation);
}

/// ValueInfoProto of a float tensor: name 1, type 2 {tensor 1 {elem_type 1, shape 2 {dim 1 {value
/// 1}}}}.
inline std::string value_info(std::string_view name, const std::vector<std::int64_t>& dims) {
  std::string shape;
  for (const std::int64_t dim : dims) {
    shape += bytes_field(1, number_field(1, static_cast<std::uint64_t>(dim)));
  }
  return bytes_field(1, name) +
         bytes_field(2, bytes_field(1, number_field(1, 1) + bytes_field(2, shape)));
}

/// An output of a tiny network: `values`, each plus three weights (of none: 0) times the means of
/// the input's channels.
struct TinyOutput {
  std::string name;
  std::vector<std::int64_t> shape;
  std::vector<float> values;
  std::vector<float> weights = {};
};

/// The nodes, weights and description of one output: a convolution of one pixel, reshaped.
/// GraphProto: node 1, initializer 5, output 12.
inline std::string tiny_output(const TinyOutput& output) {
  const auto total = static_cast<std::int64_t>(output.values.size());
  const std::string& name = output.name;
  std::vector<float> weights = output.weights;
  weights.resize(3 * output.values.size(), 0.0F);
  const std::vector<std::uint64_t> shape(output.shape.begin(), output.shape.end());
  // AttributeProto: name 1, ints 8, type 20 (7: INTS).
  const std::string one_pixel_kernel = bytes_field(1, "kernel_shape") + number_field(8, 1) +
                                       number_field(8, 1) + number_field(20, 7);
  return bytes_field(1,
                     node({"pooled", name + "_weights", name + "_bias"}, name + "_all", "Conv") +
                         bytes_field(5, one_pixel_kernel)) +
         bytes_field(1, node({name + "_all", name + "_shape"}, name, "Reshape")) +
         bytes_field(5, float_tensor(name + "_weights", {total, 3, 1, 1}, weights)) +
         bytes_field(5, float_tensor(name + "_bias", {total}, output.values)) +
         bytes_field(
             5,
             tensor(
                 name + "_shape", {static_cast<std::int64_t>(shape.size())}, 7, raw_bytes(shape))) +
         bytes_field(12, value_info(name, output.shape));
}

/// A network that says the same of every input 1 x 3 x height x width but for its mean colour.
inline std::string tiny_onnx(std::int64_t width,
                             std::int64_t height,
                             const std::vector<TinyOutput>& outputs) {
  // GraphProto: name 2, input 11.
  std::string graph = bytes_field(1, node({"images"}, "pooled", "GlobalAveragePool")) +
                      bytes_field(2, "tiny") +
                      bytes_field(11, value_info("images", {1, 3, height, width}));
  for (const TinyOutput& output : outputs) graph += tiny_output(output);
  // ModelProto: ir_version 1, graph 7, opset_import 8 {version 2}.
  return number_field(1, 6) + bytes_field(7, graph) + bytes_field(8, number_field(2, 11));
}

/// A network whose output 1 x rows x length is `values`, whatever its input 1 x 3 x side x side.
inline std::string constant_onnx(std::int64_t side,
                                 std::int64_t rows,
                                 std::int64_t length,
                                 const std::vector<float>& values) {
  return tiny_onnx(side, side, {{"output", {1, rows, length}, values}});
}

}  // namespace hypermap::test
