// SPDX-License-Identifier: BSD-3-Clause
// Checks of bare map configurations and of files of options.
#include "file_checks.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/file_reach.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxConfigBytes = std::size_t{16} << 20U;

/// What is wrong with the files that a configuration names.
class NamedFiles {
 public:
  NamedFiles(fs::path config, FileReach reach) : config_(std::move(config)), reach_(reach) {}

  void check(const fs::path& file, const char* list, std::size_t index) {
    const std::string field = list + ("[" + std::to_string(index) + "].file");
    const fs::path folder = config_.parent_path();
    if (const auto within = check_reach(reach_, folder, file); !within)
      return note(Severity::kError, within.error().code, within.error().what, field);
    std::error_code ec;
    const fs::path place = folder / file;
    if (fs::is_regular_file(place, ec)) return;
    note(Severity::kWarning,
         ErrorCode::kNotFound,
         "names " + printable(place.string()) + ", which is not there",
         field);
  }

  [[nodiscard]] std::vector<Finding> take_findings() { return std::move(findings_); }

 private:
  void note(Severity severity, ErrorCode code, std::string what, const std::string& field) {
    findings_.push_back(
        {severity,
         {.code = code, .what = std::move(what), .file = config_.string(), .field = field}});
  }

  fs::path config_;
  FileReach reach_;
  std::vector<Finding> findings_;
};

std::vector<Finding> check_named_files(const HypermapConfig& config,
                                       const fs::path& path,
                                       FileReach reach) {
  NamedFiles named(path, reach);
  for (std::size_t i = 0; i < config.layers.size(); ++i) {
    const LayerEntry& layer = config.layers[i];
    const bool is_occupancy = layer.class_name == kOccupancyLayerClass;
    if (!layer.info.load_file || (!is_occupancy && layer.class_name != kSemanticLayerClass))
      continue;
    const std::string file = layer.info.file.value_or(layer.info.name);
    named.check(is_occupancy ? file + ".yaml" : file, "layers", i);
  }
  for (std::size_t i = 0; i < config.extensions.size(); ++i) {
    const ExtensionEntry& extension = config.extensions[i];
    const bool is_grid = extension.format == kClassGridFormat;
    named.check(is_grid ? extension.file + ".yaml" : extension.file, "extensions", i);
  }
  return named.take_findings();
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

Result<FileSummary> check_config(const fs::path& path, FileReach reach) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxConfigBytes));
  if (is_options_file(text)) {
    HYPERMAP_TRY(read_options(path, {}));
    return FileSummary{"options", {}};
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_hypermap_config(text, SourceName{path.string()}));
  FileSummary out{"configuration of " + std::to_string(loaded.value.layers.size()) + " layer(s)",
                  std::move(loaded.findings)};
  for (Finding& finding : check_named_files(loaded.value, path, reach))
    out.findings.push_back(std::move(finding));
  return out;
}

}  // namespace hypermap
