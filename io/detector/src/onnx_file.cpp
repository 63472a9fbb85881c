// SPDX-License-Identifier: BSD-3-Clause
#include "onnx_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

constexpr std::uint64_t kLastModelField = 26;
constexpr std::uint64_t kModelGraph = 7;
constexpr std::uint64_t kGraphInitializer = 5;
constexpr std::uint64_t kGraphInput = 11;
constexpr std::uint64_t kTensorName = 8;
constexpr std::uint64_t kValueName = 1;
constexpr std::uint64_t kValueType = 2;
constexpr std::uint64_t kTypeTensor = 1;
constexpr std::uint64_t kTensorShape = 2;
constexpr std::uint64_t kShapeDim = 1;
constexpr std::uint64_t kDimValue = 1;

/// Protobuf's variable-length integer; none when it is cut. Moves `at` behind it.
std::optional<std::uint64_t> take_varint(std::string_view bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64 && at < bytes.size(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

/// A field of a message: a number or bytes.
struct ProtoField {
  std::uint64_t number = 0;
  std::uint64_t value = 0;
  std::string_view bytes = {};
};

constexpr std::size_t kFixedBytes[] = {0, 8, 0, 0, 0, 4};  // by wire type

/// The next field; none at the end and where the message is none.
std::optional<ProtoField> take_field(std::string_view message, std::size_t& at) {
  const auto tag = take_varint(message, at);
  if (!tag) return std::nullopt;
  ProtoField field{.number = *tag >> 3U};
  const std::uint64_t type = *tag & 7U;
  if (type == 1 || type == 5) {
    if (kFixedBytes[type] > message.size() - at) return std::nullopt;
    at += kFixedBytes[type];
    return field;
  }
  const auto value = take_varint(message, at);
  if (!value || (type != 0 && type != 2)) return std::nullopt;
  field.value = *value;
  if (type == 0) return field;
  if (*value > message.size() - at) return std::nullopt;
  field.bytes = message.substr(at, static_cast<std::size_t>(*value));
  at += static_cast<std::size_t>(*value);
  return field;
}

std::vector<ProtoField> fields_of(std::string_view message, std::uint64_t number) {
  std::vector<ProtoField> found;
  std::size_t at = 0;
  while (const auto field = take_field(message, at)) {
    if (field->number == number) found.push_back(*field);
  }
  return found;
}

std::string_view bytes_at(std::string_view message, std::uint64_t number) {
  const auto found = fields_of(message, number);
  return found.empty() ? std::string_view() : found.back().bytes;
}

/// 0 for a dimension that is left open.
std::vector<std::uint64_t> shape_of_value(std::string_view value_info) {
  const std::string_view type = bytes_at(bytes_at(value_info, kValueType), kTypeTensor);
  std::vector<std::uint64_t> shape;
  for (const ProtoField& dim : fields_of(bytes_at(type, kTensorShape), kShapeDim)) {
    const auto sizes = fields_of(dim.bytes, kDimValue);
    shape.push_back(sizes.empty() ? 0 : sizes.back().value);
  }
  return shape;
}

}  // namespace

bool looks_like_onnx(std::string_view bytes) {
  bool has_graph = false;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto field = take_field(bytes, at);
    if (!field || field->number == 0 || field->number > kLastModelField) return false;
    has_graph = has_graph || (field->number == kModelGraph && !field->bytes.empty());
  }
  return has_graph;
}

std::optional<InputSize> declared_input(std::string_view bytes) {
  constexpr std::uint64_t kMaxSide = 65'535;
  const std::string_view graph = bytes_at(bytes, kModelGraph);
  std::vector<std::string_view> weights;
  for (const ProtoField& tensor : fields_of(graph, kGraphInitializer)) {
    weights.push_back(bytes_at(tensor.bytes, kTensorName));
  }
  std::sort(weights.begin(), weights.end());
  for (const ProtoField& input : fields_of(graph, kGraphInput)) {
    if (std::binary_search(weights.begin(), weights.end(), bytes_at(input.bytes, kValueName)))
      continue;
    const auto shape = shape_of_value(input.bytes);
    if (shape.size() != 4 || shape[1] != 3) continue;
    const bool is_told =
        std::min(shape[2], shape[3]) > 0 && std::max(shape[2], shape[3]) <= kMaxSide;
    if (!is_told) return std::nullopt;
    return InputSize{.width_px = static_cast<int>(shape[3]),
                     .height_px = static_cast<int>(shape[2])};
  }
  return std::nullopt;
}

}  // namespace hypermap
