// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/intrinsics_file.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/codec/value_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;

Finding intrinsics_warning(Error error) {
  return {Severity::kWarning, std::move(error)};
}

Result<void> positive(double value, const char* field) {
  if (std::isfinite(value) && value > 0.0) return {};
  return fail(ErrorCode::kMalformedFile, "must be > 0, is " + json_number(value), field);
}

Result<void> centred(double value, std::optional<int> side, const char* field) {
  const double half = 0.5 * side.value_or(kMaxImageSidePx);
  if (std::isfinite(value) && value >= -half && value <= 3.0 * half) return {};
  return fail(ErrorCode::kMalformedFile,
              "must be inside the image or at most half its side beyond, is " + json_number(value),
              field);
}

/// The rules that hold for every form.
Result<void> check(const Intrinsics& k) {
  HYPERMAP_TRY(positive(k.fx_px, "fx"));
  if (auto ok = positive(k.fy_px, "fy"); !ok) {
    ok.error().what += rows_up_hint(k.fy_px);
    return ok;
  }
  if (k.depth_units_per_m) HYPERMAP_TRY(positive(*k.depth_units_per_m, "depth_scale"));
  HYPERMAP_TRY(centred(k.cx_px, k.width_px, "cx"));
  return centred(k.cy_px, k.height_px, "cy");
}

Result<int> side(const JsonNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, root.require(key));
  HYPERMAP_ASSIGN_OR_RETURN(const auto value, node.integer(1, kMaxImageSidePx));
  return static_cast<int>(value);
}

Result<double> number(const JsonNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, root.require(key));
  return node.number();
}

std::vector<Finding> unknown_keys(const JsonNode& root, std::span<const std::string_view> known) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const JsonNode member = root.at(i);
    if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
    const std::string what = "unknown key" + did_you_mean(member.key(), known);
    findings.push_back(intrinsics_warning(member.error(ErrorCode::kMalformedFile, what).value()));
  }
  return findings;
}

/// Open3D: `intrinsic_matrix` is column-major.
Result<void> read_open3d_matrix(const JsonNode& matrix, Intrinsics& out) {
  HYPERMAP_TRY(matrix.expect(JsonKind::kArray));
  if (matrix.size() != 9) {
    return matrix.error(ErrorCode::kMalformedFile,
                        "must have 9 numbers, has " + std::to_string(matrix.size()));
  }
  std::array<double, 9> m{};
  for (std::size_t i = 0; i < m.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(m.at(i), matrix.at(i).number());
  }
  out.fx_px = m[0];
  out.fy_px = m[4];
  out.cx_px = m[6];
  out.cy_px = m[7];
  return {};
}

Result<Loaded<Intrinsics>> parse_json(std::string_view text, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document, JsonDocument::parse(text, name));
  const JsonNode root = document.root();
  HYPERMAP_TRY(root.expect(JsonKind::kObject));
  Intrinsics k;
  HYPERMAP_ASSIGN_OR_RETURN(k.width_px, side(root, "width"));
  HYPERMAP_ASSIGN_OR_RETURN(k.height_px, side(root, "height"));
  if (const auto matrix = root.find("intrinsic_matrix")) {
    HYPERMAP_TRY(read_open3d_matrix(*matrix, k));
  } else {
    HYPERMAP_ASSIGN_OR_RETURN(k.fx_px, number(root, "fx"));
    HYPERMAP_ASSIGN_OR_RETURN(k.fy_px, number(root, "fy"));
    HYPERMAP_ASSIGN_OR_RETURN(k.cx_px, number(root, "cx"));
    HYPERMAP_ASSIGN_OR_RETURN(k.cy_px, number(root, "cy"));
  }
  if (const auto scale = root.find("depth_scale")) {
    HYPERMAP_ASSIGN_OR_RETURN(k.depth_units_per_m, scale->number());
  }
  constexpr std::array<std::string_view, 8> kKnown{
      "width", "height", "fx", "fy", "cx", "cy", "depth_scale", "intrinsic_matrix"};
  return Loaded<Intrinsics>{k, unknown_keys(root, kKnown)};
}

/// A matrix is a list, or a map with the list under `data`.
Result<std::vector<double>> yaml_matrix(const YamlNode& node, std::size_t count) {
  if (const auto data = node.find("data")) return data->as_doubles(count);
  return node.as_doubles(count);
}

std::optional<YamlNode> first_of(const YamlNode& root, std::span<const std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (auto node = root.find(key)) return node;
  }
  return std::nullopt;
}

/// The calibration file says `image_width`, the message `width`.
Result<int> yaml_side(const YamlNode& root, std::string_view file_key, std::string_view key) {
  if (const auto node = root.find(key)) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto value, node->as_int(1, kMaxImageSidePx));
    return static_cast<int>(value);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(file_key));
  HYPERMAP_ASSIGN_OR_RETURN(const auto value, node.as_int(1, kMaxImageSidePx));
  return static_cast<int>(value);
}

std::vector<Finding> distortion(const YamlNode& root) {
  constexpr std::array<std::string_view, 3> kKeys{"distortion_coefficients", "D", "d"};
  const auto node = first_of(root, kKeys);
  if (!node) return {};
  const YamlNode list = node->find("data").value_or(*node);
  const auto items = list.as_list();
  const bool any = items && std::any_of(items->begin(), items->end(), [](const YamlNode& item) {
                     const auto value = item.as_double();
                     return !value || *value != 0.0;
                   });
  if (!any) return {};
  return {intrinsics_warning(list.error("distortion is not applied, expected images without it"))};
}

Result<Loaded<Intrinsics>> parse_camera_info(std::string_view text, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(text, SourceName{name}));
  const YamlNode root = document.root();
  Intrinsics k;
  HYPERMAP_ASSIGN_OR_RETURN(k.width_px, yaml_side(root, "image_width", "width"));
  HYPERMAP_ASSIGN_OR_RETURN(k.height_px, yaml_side(root, "image_height", "height"));
  constexpr std::array<std::string_view, 3> kMatrixKeys{"camera_matrix", "K", "k"};
  const auto matrix = first_of(root, kMatrixKeys);
  if (!matrix) return Unexpected(root.error("missing key \"camera_matrix\" or \"K\""));
  HYPERMAP_ASSIGN_OR_RETURN(const auto m, yaml_matrix(*matrix, 9));
  k.fx_px = m[0];
  k.cx_px = m[2];
  k.fy_px = m[4];
  k.cy_px = m[5];
  if (const auto scale = root.find("depth_scale")) {
    HYPERMAP_ASSIGN_OR_RETURN(k.depth_units_per_m, scale->as_double());
  }
  return Loaded<Intrinsics>{k, distortion(root)};
}

Result<std::vector<double>> parse_matrix_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (const TextLine& line : split_lines(text)) {
    for (const std::string_view word : split_words(line.text)) {
      const auto value = parse_double(word);
      if (value && std::isfinite(*value) && numbers.size() < 16) {
        numbers.push_back(*value);
        continue;
      }
      return Unexpected(
          Error{.code = ErrorCode::kMalformedFile,
                .what = "must be a 3x3 or 4x4 matrix of finite numbers, has " + printable(word, 60),
                .field = "matrix",
                .line = line.number});
    }
  }
  return numbers;
}

Result<Loaded<Intrinsics>> parse_matrix(std::string_view text) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> m, parse_matrix_numbers(text));
  if (m.size() != 9 && m.size() != 16) {
    return fail(ErrorCode::kMalformedFile,
                "must be a 3x3 or 4x4 matrix, has " + std::to_string(m.size()) + " numbers",
                "matrix");
  }
  const std::size_t row = m.size() == 9 ? 3 : 4;
  if (m[row] != 0.0 || m[2 * row] != 0.0 || m[2 * row + 1] != 0.0 || m[2 * row + 2] != 1.0) {
    return fail(
        ErrorCode::kMalformedFile, "must have the form [fx s cx; 0 fy cy; 0 0 1]", "matrix");
  }
  Intrinsics k;
  k.fx_px = m[0];
  k.fy_px = m[row + 1];
  k.cx_px = m[2];
  k.cy_px = m[row + 2];
  return Loaded<Intrinsics>{k, {}};
}

Result<Loaded<Intrinsics>> parse(std::string_view text, const std::string& name) {
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  const std::size_t first = rest.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) {
    return fail(ErrorCode::kMalformedFile, "is empty, expected camera intrinsics");
  }
  rest = rest.substr(first);
  if (rest.front() == '{' || rest.front() == '[') return parse_json(text, name);
  const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
  return parse_double(word) ? parse_matrix(text) : parse_camera_info(text, name);
}

}  // namespace

std::string rows_up_hint(double fy_px) {
  if (!(fy_px < 0.0)) return "";
  return ": negative fy (y of the camera points up) is not read; give its amount when the poses "
         "are "
         "of a camera whose y points down, or turn them so";
}

Result<Loaded<Intrinsics>> read_intrinsics(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxBytes));
  auto loaded = parse(text, path.string());
  if (loaded) {
    if (auto ok = check(loaded->value); !ok) loaded = Unexpected(std::move(ok).error());
  }
  if (!loaded) {
    Error error = std::move(loaded).error();
    error.file = path.string();
    return Unexpected(std::move(error));
  }
  return loaded;
}

Result<PinholeCamera> camera_of(const Intrinsics& intrinsics, int width_px, int height_px) {
  const int width = intrinsics.width_px.value_or(width_px);
  const int height = intrinsics.height_px.value_or(height_px);
  if ((width_px > 0 && width != width_px) || (height_px > 0 && height != height_px)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be the images' " + std::to_string(width_px) + " x " +
                    std::to_string(height_px) + ", is " + std::to_string(width) + " x " +
                    std::to_string(height),
                "width, height");
  }
  const PinholeCamera camera{
      width, height, intrinsics.fx_px, intrinsics.fy_px, intrinsics.cx_px, intrinsics.cy_px};
  HYPERMAP_TRY(validate(camera));
  return camera;
}

std::string to_intrinsics_json(const PinholeCamera& camera, double depth_units_per_m) {
  return "{\"width\": " + std::to_string(camera.width_px) +
         ", \"height\": " + std::to_string(camera.height_px) +
         ", \"fx\": " + json_number(camera.fx_px) + ", \"fy\": " + json_number(camera.fy_px) +
         ", \"cx\": " + json_number(camera.cx_px) + ", \"cy\": " + json_number(camera.cy_px) +
         ", \"depth_scale\": " + json_number(depth_units_per_m) + "}\n";
}

}  // namespace hypermap
