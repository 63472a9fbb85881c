// SPDX-License-Identifier: BSD-3-Clause
// The description of a folder, read by itself and with the folder that it describes.
#include "fuzz_target.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_dataset(std::string_view bytes) {
  const std::filesystem::path path = file_of(bytes, "dataset.yaml");
  if (!read_dataset_description(path)) return;
  ClassRegistry registry;
  static_cast<void>(open_dataset(path.parent_path(), {}, registry));
}

}  // namespace hypermap::fuzz
