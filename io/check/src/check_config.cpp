// SPDX-License-Identifier: BSD-3-Clause
// Checks of bare map configurations and of files of options.
#include "file_checks.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxConfigBytes = std::size_t{16} << 20U;

/// Files that the configuration names and that are not there.
void note_absent(const fs::path& file,
                 const std::string& field,
                 const fs::path& config,
                 std::vector<Finding>& findings) {
  std::error_code ec;
  const fs::path place = file.is_absolute() ? file : config.parent_path() / file;
  if (fs::is_regular_file(place, ec)) return;
  findings.push_back({Severity::kWarning,
                      {.code = ErrorCode::kNotFound,
                       .what = "names " + printable(place.string()) + ", which is not there",
                       .file = config.string(),
                       .field = field}});
}

void note_absent_files(const HypermapConfig& config,
                       const fs::path& path,
                       std::vector<Finding>& findings) {
  for (std::size_t i = 0; i < config.layers.size(); ++i) {
    const LayerEntry& layer = config.layers[i];
    const bool is_occupancy = layer.class_name == kOccupancyLayerClass;
    if (!layer.info.load_file || (!is_occupancy && layer.class_name != kSemanticLayerClass))
      continue;
    const std::string file = layer.info.file.value_or(layer.info.name);
    note_absent(is_occupancy ? file + ".yaml" : file,
                "layers[" + std::to_string(i) + "].file",
                path,
                findings);
  }
  for (std::size_t i = 0; i < config.extensions.size(); ++i) {
    const ExtensionEntry& extension = config.extensions[i];
    const bool is_grid = extension.format == kClassGridFormat;
    note_absent(is_grid ? extension.file + ".yaml" : extension.file,
                "extensions[" + std::to_string(i) + "].file",
                path,
                findings);
  }
}

/// Options have their sections at the top, configurations their layers.
bool is_options_file(std::string_view text) {
  const auto document = parse_yaml(text, {});
  if (!document || document->root().find("layers")) return false;
  for (const OptionDescription& option : describe_options({})) {
    if (document->root().find(option.name.substr(0, option.name.find('.')))) return true;
  }
  return document->root().find("preset").has_value();
}

}  // namespace

Result<FileSummary> check_config(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxConfigBytes));
  if (is_options_file(text)) {
    HYPERMAP_TRY(read_options(path, {}));
    return FileSummary{"options", {}};
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_hypermap_config(text, SourceName{path.string()}));
  FileSummary out{"configuration of " + std::to_string(loaded.value.layers.size()) + " layer(s)",
                  std::move(loaded.findings)};
  note_absent_files(loaded.value, path, out.findings);
  return out;
}

}  // namespace hypermap
