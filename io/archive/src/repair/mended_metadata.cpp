// SPDX-License-Identifier: BSD-3-Clause
#include "mended_metadata.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "layers/layer_files.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr double kUsualOccupied = 0.65;
constexpr double kUsualFree = 0.196;

/// The keys of one grid, and what became of them.
class MetadataMender {
 public:
  MetadataMender(ValueTree tree, const SourceName& source)
      : tree_(std::move(tree)), source_(source) {}

  void mend_thresholds() {
    const auto occupied = number("occupied_thresh");
    const auto free = number("free_thresh");
    if (occupied && free && *occupied >= *free) return;
    if (occupied && free) {
      set("occupied_thresh", make_number(*free), "was below free_thresh; both are exchanged");
      set("free_thresh", make_number(*occupied), "");
      return;
    }
    const std::string values = number_text(kUsualOccupied) + " and " + number_text(kUsualFree);
    set("occupied_thresh",
        make_number(kUsualOccupied),
        "is no pair of numbers in 0 .. 1 with free_thresh; they are now " + values);
    set("free_thresh", make_number(kUsualFree), "");
  }

  void mend_negate() {
    const auto node = YamlNode(tree_, "", source_).find("negate");
    if (node && (node->as_bool() || node->as_int(0, 1))) return;
    set("negate", make_number(0), "is missing or no truth value; it is now 0");
  }

  void mend_mode() {
    const auto node = YamlNode(tree_, "", source_).find("mode");
    const auto mode = node ? node->as_string() : Result<std::string>("trinary");
    if (mode && (*mode == "trinary" || *mode == "scale" || *mode == "raw")) return;
    std::erase_if(tree_.entries, [](const auto& entry) { return entry.first == "mode"; });
    mended_.emplace_back("mode: was none; it is now trinary");
  }

  void mend_image(const std::string& stem, const SalvagedContents& members) {
    const auto node = YamlNode(tree_, "", source_).find("image");
    const auto image = node ? node->as_string() : Result<std::string>("");
    if (image && members.contains(image_member(stem + ".yaml", *image))) return;
    for (const char* suffix : {".png", ".pgm"}) {
      if (!members.contains(stem + suffix)) continue;
      const std::string name = stem.substr(stem.rfind('/') + 1) + suffix;
      set("image", make_text(name), "named no member; it is now " + name);
      return;
    }
  }

  [[nodiscard]] MendedMetadata result() && {
    return {.yaml = write_yaml(tree_), .mended = std::move(mended_)};
  }

 private:
  [[nodiscard]] std::optional<double> number(std::string_view key) const {
    const auto node = YamlNode(tree_, "", source_).find(key);
    const auto value = node ? node->as_double(0.0, 1.0) : Result<double>(-1.0);
    return value && *value >= 0.0 ? std::optional(*value) : std::nullopt;
  }

  void set(std::string_view key, ValueTree value, const std::string& why) {
    const auto entry = std::ranges::find(tree_.entries, key, &ValueTree::Entry::first);
    if (entry == tree_.entries.end()) {
      tree_.entries.emplace_back(key, std::move(value));
    } else {
      entry->second = std::move(value);
    }
    if (!why.empty()) mended_.push_back(std::string(key) + ": " + why);
  }

  ValueTree tree_;
  const SourceName& source_;
  std::vector<std::string> mended_;
};

}  // namespace

Result<MendedMetadata> mend_metadata(std::string_view yaml,
                                     const std::string& stem,
                                     const SourceName& source,
                                     const SalvagedContents& members) {
  HYPERMAP_ASSIGN_OR_RETURN(YamlDocument document, parse_yaml(yaml, source));
  HYPERMAP_TRY(document.root().as_map());
  MetadataMender mender(std::move(document.value), source);
  mender.mend_image(stem, members);
  mender.mend_thresholds();
  mender.mend_negate();
  mender.mend_mode();
  return std::move(mender).result();
}

}  // namespace hypermap
