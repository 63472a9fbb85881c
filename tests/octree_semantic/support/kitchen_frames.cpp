// SPDX-License-Identifier: BSD-3-Clause
#include "octree_semantic/support/labelled_frame.hpp"
#include "support/test_data.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace hypermap::test {
namespace {

constexpr int kNumCocoClasses = 80;
const PinholeCamera kCamera{640, 480, 585.0, 585.0, 320.0, 240.0};

std::map<std::string, nlohmann::json> read_detections(const std::filesystem::path& folder) {
  std::map<std::string, nlohmann::json> by_image;
  std::ifstream lines(folder / "detections_yolox_nano.jsonl");
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json parsed = nlohmann::json::parse(line);
    by_image[parsed.at("image").get<std::string>()] = parsed.at("detections");
  }
  return by_image;
}

bool read_frame(const std::filesystem::path& folder, const std::string& stem, RgbdFrame& frame) {
  const cv::Mat image = cv::imread((folder / (stem + ".depth.png")).string(), cv::IMREAD_UNCHANGED);
  std::ifstream pose_file(folder / (stem + ".pose.txt"));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) pose_file >> pose.matrix()(row, column);
  }
  if (image.empty() || !pose_file) return false;
  frame.camera = kCamera;
  frame.name = stem;
  frame.map_from_camera = MapFromCamera(pose);
  frame.depth_m = DepthImage(kCamera.width_px, kCamera.height_px);
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const auto millimetres = image.at<std::uint16_t>(v, u);
      if (millimetres == 65535) continue;
      frame.depth_m.at(u, v) = static_cast<float>(millimetres) * 0.001F;
    }
  }
  return true;
}

PixelLabels label_box(const nlohmann::json& detection, std::uint32_t object) {
  const auto id = detection.at("class_id").get<std::uint32_t>();
  const double score = detection.at("score").get<double>();
  PixelLabels labels{ObjectId{object}, class_vector(ClassId{id}, score, kNumCocoClasses), {}};
  const auto box = detection.at("bbox_xywh").get<std::vector<double>>();
  const int u_min = std::max(0, static_cast<int>(box[0]));
  const int v_min = std::max(0, static_cast<int>(box[1]));
  const int u_max = std::min(kCamera.width_px, static_cast<int>(box[0] + box[2]));
  const int v_max = std::min(kCamera.height_px, static_cast<int>(box[1] + box[3]));
  for (int v = v_min; v < v_max; ++v) {
    for (int u = u_min; u < u_max; ++u) {
      labels.pixel_indices.push_back(static_cast<std::uint32_t>(v * kCamera.width_px + u));
    }
  }
  return labels;
}

}  // namespace

std::vector<LabelledFrame> kitchen_frames(std::size_t stride, std::size_t max_frames) {
  const std::filesystem::path folder = shared_data("rgbd/7scenes_redkitchen");
  std::vector<std::string> stems;
  if (std::filesystem::exists(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".depth.png")) stems.push_back(name.substr(0, name.find('.')));
    }
  }
  std::sort(stems.begin(), stems.end());
  const auto detections =
      stems.empty() ? std::map<std::string, nlohmann::json>{} : read_detections(folder);
  std::vector<LabelledFrame> frames;
  for (std::size_t i = 0; i < stems.size() && frames.size() < max_frames; i += stride) {
    LabelledFrame labelled;
    if (!read_frame(folder, stems[i], labelled.frame)) continue;
    labelled.frame.index = i;
    const auto found = detections.find(stems[i] + ".color.jpg");
    if (found != detections.end()) {
      for (const nlohmann::json& detection : found->second) {
        labelled.labels.push_back(
            label_box(detection, static_cast<std::uint32_t>(labelled.labels.size() + 1)));
      }
    }
    frames.push_back(std::move(labelled));
  }
  return frames;
}

}  // namespace hypermap::test
