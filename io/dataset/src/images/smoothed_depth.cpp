// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/smoothed_depth.hpp"

#include <string>
#include <utility>

namespace hypermap {
namespace {

class SmoothedDataset final : public DatasetReader {
 public:
  SmoothedDataset(std::unique_ptr<DatasetReader> recorded, const DepthSmoothingOptions& options)
      : recorded_(std::move(recorded)), options_(options) {
    set_map_from_input(recorded_->map_from_input());
  }

  [[nodiscard]] std::size_t size() const noexcept override { return recorded_->size(); }
  [[nodiscard]] std::string frame_name(std::size_t index) const override {
    return recorded_->frame_name(index);
  }
  [[nodiscard]] const DatasetSummary& summary() const noexcept override {
    return recorded_->summary();
  }
  [[nodiscard]] Result<RgbdFrame> read(std::size_t index) const override {
    HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, recorded_->read(index));
    frame.depth_m = DepthSmoother(options_).smoothed(frame.depth_m, 1);
    return frame;
  }

 private:
  std::unique_ptr<DatasetReader> recorded_;
  DepthSmoothingOptions options_;
};

}  // namespace

std::unique_ptr<DatasetReader> with_smoothed_depth(std::unique_ptr<DatasetReader> dataset,
                                                   const DepthSmoothingOptions& options) {
  if (options.rule == DepthSmoothingRule::kNone) return dataset;
  return std::make_unique<SmoothedDataset>(std::move(dataset), options);
}

}  // namespace hypermap
