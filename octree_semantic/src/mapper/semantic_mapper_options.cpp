// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kMapperRows[] = {
    option::section<&SemanticMapperOptions::octree>("octree"),
    option::section<&SemanticMapperOptions::integration>("integration"),
    option::section<&SemanticMapperOptions::deadline>("deadline"),
    option::section<&SemanticMapperOptions::visibility>("visibility"),
    option::section<&SemanticMapperOptions::objects>(""),
    option::count<&SemanticMapperOptions::num_threads>(
        "num_threads",
        {1, 256},
        {.effect = "Threads for the detections of a frame and for rays.", .is_listed = false}),
};

}  // namespace

const OptionTable& option_table(const SemanticMapperOptions&) {
  static constexpr OptionTable kTable{kMapperRows};
  return kTable;
}

Result<void> validate(const SemanticMapperOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
