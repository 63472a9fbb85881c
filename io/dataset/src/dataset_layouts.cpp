// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_description.hpp"
#include "images/image_list.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

// What cannot be looked at is not absent: these throw fs::filesystem_error, which find_layout ends.
bool has_file(const fs::path& folder, const std::string& name) {
  return fs::is_regular_file(folder / name);
}

bool has_folder(const fs::path& folder, const std::string& name) {
  return fs::is_directory(folder / name);
}

/// The first of `names` that is a file in the folder; empty when none is.
template <std::size_t N>
std::string first_file(const fs::path& folder, const std::array<const char*, N>& names) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const char* n) { return has_file(folder, n); });
  return found == names.end() ? std::string{} : std::string(*found);
}

constexpr std::array<const char*, 9> kIntrinsicsFiles{"intrinsics.json",
                                                      "intrinsic.json",
                                                      "camera_intrinsic.json",
                                                      "camera_intrinsics.json",
                                                      "camera.json",
                                                      "camera_info.yaml",
                                                      "camera.yaml",
                                                      "camera-intrinsics.txt",
                                                      "intrinsics.txt"};

Intrinsics published_intrinsics(double fx, double fy, double cx, double cy) {
  Intrinsics k;
  k.fx_px = fx;
  k.fy_px = fy;
  k.cx_px = cx;
  k.cy_px = cy;
  k.width_px = 640;
  k.height_px = 480;
  return k;
}

/// Takes the folder's intrinsics, or else the published ones, which is a finding.
void take_intrinsics(const fs::path& folder,
                     const Intrinsics& otherwise,
                     const std::string& origin,
                     Loaded<DatasetDescription>& out) {
  out.value.intrinsics_file = first_file(folder, kIntrinsicsFiles);
  if (!out.value.intrinsics_file.empty()) return;
  out.value.intrinsics = otherwise;
  out.findings.push_back({Severity::kWarning,
                          {.code = ErrorCode::kNotFound,
                           .what = "the folder has none, those of " + origin + " are taken",
                           .file = folder.string(),
                           .field = "intrinsics"}});
}

/// Pattern `*suffix` of the first file in `folder` that ends in an image's extension; empty: none.
std::string image_files_in(const fs::path& root, const std::string& folder, std::string_view stem) {
  for (const char* extension : {".png", ".jpg", ".jpeg", ".pgm", ".bmp"}) {
    std::string pattern = (folder.empty() ? "" : folder + "/") + std::string(stem) + extension;
    if (const auto list = list_image_files(root, pattern); list && !list->empty()) return pattern;
  }
  return {};
}

/// The published calibrations of the three cameras of the TUM benchmark, by the folder's name.
std::pair<Intrinsics, std::string> tum_camera(const fs::path& folder) {
  const std::string name = fs::absolute(folder).lexically_normal().string();
  if (name.find("freiburg1") != std::string::npos) {
    return {published_intrinsics(517.3, 516.5, 318.6, 255.3), "freiburg1"};
  }
  if (name.find("freiburg2") != std::string::npos) {
    return {published_intrinsics(520.9, 521.0, 325.1, 249.7), "freiburg2"};
  }
  if (name.find("freiburg3") != std::string::npos) {
    return {published_intrinsics(535.4, 539.2, 320.1, 247.6), "freiburg3"};
  }
  return {published_intrinsics(525.0, 525.0, 319.5, 239.5), "the TUM benchmark's default camera"};
}

std::optional<Loaded<DatasetDescription>> find_tum_layout(const fs::path& folder) {
  if (!has_file(folder, "depth.txt")) return std::nullopt;
  Loaded<DatasetDescription> out;
  out.value.layout = "tum";
  out.value.depth = "depth.txt";
  if (has_file(folder, "rgb.txt")) out.value.color = "rgb.txt";
  out.value.trajectory = "groundtruth.txt";
  out.value.depth_format.units_per_m = 5000.0;
  out.value.up_axis = "z";  // the world of the motion capture system stands upright
  const auto [camera, origin] = tum_camera(folder);
  take_intrinsics(folder, camera, origin, out);
  return out;
}

std::optional<Loaded<DatasetDescription>> find_7scenes_layout(const fs::path& folder) {
  Loaded<DatasetDescription> out;
  out.value.layout = "7scenes";
  out.value.depth = image_files_in(folder, "", "frame-*.depth");
  if (out.value.depth.empty()) return std::nullopt;
  out.value.color = image_files_in(folder, "", "frame-*.color");
  out.value.trajectory = "frame-*.pose.txt";
  out.value.trajectory_format = TrajectoryFormat::kMatrix;
  out.value.pair_by = PosePairing::kNumber;
  out.value.may_be_unregistered = true;  // 7-Scenes is not, others in its layout are
  take_intrinsics(folder, published_intrinsics(585.0, 585.0, 320.0, 240.0), "7-Scenes", out);
  return out;
}

std::optional<Loaded<DatasetDescription>> find_scannet_layout(const fs::path& folder) {
  if (!has_folder(folder, "depth") || !has_folder(folder, "pose") ||
      !has_folder(folder, "intrinsic")) {
    return std::nullopt;
  }
  Loaded<DatasetDescription> out;
  out.value.layout = "scannet";
  out.value.depth = image_files_in(folder, "depth", "*");
  if (out.value.depth.empty()) return std::nullopt;
  out.value.color = image_files_in(folder, "color", "*");
  out.value.trajectory = "pose/*.txt";
  out.value.trajectory_format = TrajectoryFormat::kMatrix;
  out.value.pair_by = PosePairing::kNumber;
  const bool has_both = has_file(folder, "intrinsic/intrinsic_color.txt") &&
                        has_file(folder, "intrinsic/intrinsic_depth.txt");
  out.value.intrinsics_file = has_file(folder, "intrinsic/intrinsic_color.txt")
                                  ? "intrinsic/intrinsic_color.txt"
                                  : "intrinsic/intrinsic_depth.txt";
  if (has_both) out.value.depth_intrinsics_file = "intrinsic/intrinsic_depth.txt";
  for (const char* name : {"label-filt", "label"}) {
    if (out.value.labels.empty()) out.value.labels = image_files_in(folder, name, "*");
  }
  for (const char* name : {"instance-filt", "instance"}) {
    if (out.value.instances.empty()) out.value.instances = image_files_in(folder, name, "*");
  }
  return out;
}

/// `trajectory.log` in the folder or in one of its folders; empty: none.
std::string find_log(const fs::path& folder) {
  if (has_file(folder, "trajectory.log")) return "trajectory.log";
  std::vector<std::string> found;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec); !ec && it != fs::directory_iterator();
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    if (has_file(folder, name + "/trajectory.log")) found.push_back(name + "/trajectory.log");
  }
  return found.empty() ? std::string{} : *std::min_element(found.begin(), found.end());
}

std::optional<Loaded<DatasetDescription>> find_open3d_layout(const fs::path& folder) {
  Loaded<DatasetDescription> out;
  out.value.layout = "open3d";
  out.value.trajectory = find_log(folder);
  if (!has_folder(folder, "depth") || out.value.trajectory.empty()) return std::nullopt;
  out.value.depth = image_files_in(folder, "depth", "*");
  if (out.value.depth.empty()) return std::nullopt;
  for (const char* name : {"image", "color", "rgb"}) {
    if (out.value.color.empty()) out.value.color = image_files_in(folder, name, "*");
  }
  out.value.trajectory_format = TrajectoryFormat::kLog;
  out.value.pair_by = PosePairing::kNumber;
  take_intrinsics(
      folder, published_intrinsics(525.0, 525.0, 319.5, 239.5), "Open3D's PrimeSense default", out);
  return out;
}

Unexpected no_layout(const fs::path& folder) {
  return Unexpected(
      Error{.code = ErrorCode::kNotFound,
            .what = "is no dataset that is known here, expected dataset.yaml, or depth.txt and "
                    "groundtruth.txt (TUM), frame-*.depth.png (7-Scenes), depth/ pose/ intrinsic/ "
                    "(ScanNet), depth/ and trajectory.log (Open3D); any other folder wants a "
                    "description of its own (--dataset)",
            .file = folder.string()});
}

Unexpected system_fault(const fs::path& path, const std::string& why) {
  return Unexpected(Error{.code = ErrorCode::kIo, .what = why, .file = path.string()});
}

}  // namespace

Result<Loaded<DatasetDescription>> find_layout(const std::filesystem::path& folder) try {
  if (!fs::exists(folder)) return system_fault(folder, "does not exist");
  if (!fs::is_directory(folder)) {
    return Unexpected(
        Error{.code = ErrorCode::kNotFound, .what = "is no folder", .file = folder.string()});
  }
  if (has_file(folder, "dataset.yaml")) return read_dataset_description(folder / "dataset.yaml");
  for (const auto& look :
       {find_tum_layout, find_7scenes_layout, find_scannet_layout, find_open3d_layout}) {
    if (auto found = look(folder)) {
      for (const char* name : {"detections.jsonl", "detections.json"}) {
        if (found->value.detections.empty() && has_file(folder, name)) {
          found->value.detections.emplace_back(name);
        }
      }
      return std::move(*found);
    }
  }
  return no_layout(folder);
} catch (const fs::filesystem_error& error) {
  return system_fault(error.path1(), "cannot be looked at: " + error.code().message());
}

}  // namespace hypermap
