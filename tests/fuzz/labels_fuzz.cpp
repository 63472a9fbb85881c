// SPDX-License-Identifier: BSD-3-Clause
// Images of labels and of instances.
#include "fuzz_target.hpp"
#include "image_oracle.hpp"
#include "label_images.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_labels(std::string_view bytes) {
  if (is_large_image(bytes)) return;
  const std::filesystem::path image = file_of(bytes, "labels.png");
  const LabelNames names{.of_number = {{1, "wall"}, {5, "chair"}, {255, "lamp"}}};
  static_cast<void>(read_label_detections(image, {}, names));
  static_cast<void>(read_label_detections({}, image, names));
  static_cast<void>(read_label_detections(image, image, names));
}

}  // namespace hypermap::fuzz
