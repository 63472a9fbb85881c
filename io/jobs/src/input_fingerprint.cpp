// SPDX-License-Identifier: BSD-3-Clause
#include "input_fingerprint.hpp"

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// The bytes of numbers in memory; all hosts that are supported are little-endian.
template <class T>
std::string_view bytes_of(std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void add(InputHash& hash, const Detection& detection) {
  const PixelBox& box = detection.box_px;
  const std::array numbers{box.u_min_px,
                           box.v_min_px,
                           box.u_max_px,
                           box.v_max_px,
                           detection.score.value(),
                           static_cast<double>(detection.detector.value)};
  hash.add(bytes_of(std::span<const double>(numbers)));
  std::vector<double> scores;
  for (const auto& [id, probability] : detection.class_scores) {
    scores.push_back(static_cast<double>(id.value));
    scores.push_back(probability.value());
  }
  hash.add(bytes_of(std::span<const double>(scores)));
  if (detection.mask) hash.add(bytes_of(detection.mask->pixels()));
  for (const Embedding& embedding : detection.embeddings) {
    hash.add(embedding.model);
    hash.add(bytes_of(std::span<const float>(embedding.vector)));
  }
}

void add_stamp(InputHash& hash, Stamp stamp) {
  const std::array number{stamp.ns};
  hash.add(bytes_of(std::span<const std::int64_t>(number)));
}

void add_camera(InputHash& hash, const PinholeCamera& camera) {
  const std::array numbers{static_cast<double>(camera.width_px),
                           static_cast<double>(camera.height_px),
                           camera.fx_px,
                           camera.fy_px,
                           camera.cx_px,
                           camera.cy_px};
  hash.add(bytes_of(std::span<const double>(numbers)));
}

}  // namespace

std::string recording_hash(const RgbdFrame& frame) {
  InputHash hash;
  add_stamp(hash, frame.stamp);
  add_camera(hash, frame.camera);
  hash.add(bytes_of(frame.depth_m.pixels()));
  return hash.text();
}

std::string frame_hash(const RgbdFrame& frame) {
  InputHash hash;
  const Eigen::Matrix4d pose = frame.map_from_camera.isometry().matrix();
  add_stamp(hash, frame.stamp);
  add_camera(hash, frame.camera);
  hash.add(bytes_of(std::span<const double>(pose.data(), 16)));
  hash.add(bytes_of(frame.depth_m.pixels()));
  for (const Detection& detection : frame.detections) add(hash, detection);
  return hash.text();
}

InputFingerprint::InputFingerprint(std::string text, std::string first_frame)
    : text_(std::move(text)), first_frame_(std::move(first_frame)) {}

std::string InputFingerprint::add(const RgbdFrame& frame) {
  if (first_frame_.empty()) first_frame_ = recording_hash(frame);
  std::string added = frame_hash(frame);
  InputHash hash;
  hash.add(text_);
  hash.add(added);
  text_ = hash.text();
  return added;
}

}  // namespace hypermap
