// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_repair.hpp"

#include "archive_checks.hpp"
#include "archive_extensions.hpp"
#include "guessed_config.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/archive_size.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_salvage.hpp"
#include "layers/layer_files.hpp"
#include "named_classes.hpp"
#include "part_reader.hpp"
#include "repair_text.hpp"
#include "reserved_names.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace hypermap {
namespace {

/// Reads a map part by part from members that are sound.
class RepairingReader {
 public:
  RepairingReader(SalvagedContents contents,
                  const std::string& file,
                  const ArchiveLimits& limits,
                  const LayerRegistry& layers,
                  const StopCheck& stop)
      : parts_(std::move(contents), file, limits, layers, stop),
        file_(file),
        limits_(limits),
        layers_(layers) {}

  Result<RepairedArchive> read() {
    HYPERMAP_ASSIGN_OR_RETURN(const HypermapConfig config, read_config());
    MapArchive& map = repaired_.map;
    map.hypermap.frames() = config.frames;
    map.hypermap.set_extra(config.extra);
    map.foreign_extensions = config.foreign_extensions;
    for (const LayerEntry& entry : config.layers) repaired_.order.push_back(entry.info.name);
    for (const ExtensionEntry& entry : config.extensions)
      repaired_.order.push_back(name_of_part(entry));
    for (std::size_t i = 0; i < config.layers.size(); ++i)
      HYPERMAP_TRY(take_layer(config.layers[i], i));
    HYPERMAP_TRY(take_extensions(config));
    if (const std::string named = name_absent_classes(map); !named.empty())
      note("extension classes", RepairOutcome::kRepaired, named);
    HYPERMAP_TRY(check_classes(map));
    if (const auto finding = forget_absent_objects(map))
      note("extension octomap", RepairOutcome::kRepaired, text_of(finding->error));
    HYPERMAP_TRY(keep_the_rest(config));
    const bool is_empty = map.hypermap.layers().empty() && !map.octree && map.octomaps.empty() &&
                          map.objects.empty() && map.class_grids.empty();
    if (is_empty)
      return fail(ErrorCode::kMalformedFile, "no layer, octree or object is left: " + losses());
    return std::move(repaired_);
  }

 private:
  void note(std::string subject, RepairOutcome outcome, std::string what = {}) {
    repaired_.notes.push_back({std::move(subject), outcome, std::move(what)});
  }

  [[nodiscard]] std::string losses() const {
    std::string text;
    for (const RepairNote& one : repaired_.notes) {
      if (one.outcome == RepairOutcome::kLost)
        text += (text.empty() ? "" : "; ") + one.subject + ": " + one.what;
    }
    return text.empty() ? "the configuration names none" : text;
  }

  /// The configuration, or one that is guessed. Errors: that of a newer version, limits.
  Result<HypermapConfig> read_config() {
    parts_.use({std::string(kConfigName)});
    const std::string subject = "member " + std::string(kConfigName);
    const auto found = parts_.contents().find(kConfigName);
    std::string why = "is not there";
    if (found != parts_.contents().end()) {
      auto config = parse_hypermap_config(
          found->second, {.file = file_, .entry = std::string(kConfigName)}, layers_);
      if (config) {
        if (!config->findings.empty())
          note(subject, RepairOutcome::kRepaired, text_of(config->findings));
        return std::move(config->value);
      }
      if (config.error().code != ErrorCode::kMalformedFile) return Unexpected(config.error());
      why = text_of(config.error());
    }
    note(subject,
         RepairOutcome::kRebuilt,
         "from names and contents of members; frames, transforms, flags and unknown keys are "
         "lost: " +
             why);
    repaired_.is_config_guessed = true;
    return guess_config(parts_.contents());
  }

  /// Notes what became of a part, and that its members belong to it.
  template <class T>
  void take_part(const std::string& subject, ReadPart<T>& part) {
    parts_.use(part.used);
    if (part.loaded.findings.empty()) {
      note(subject, RepairOutcome::kKept);
    } else {
      note(subject, RepairOutcome::kRepaired, text_of(part.loaded.findings));
    }
  }

  /// Errors: of the system.
  Result<void> lose_part(const std::string& subject, LostPart part, const Error& error) {
    if (is_of_the_system(error)) return Unexpected(error);
    note(subject, RepairOutcome::kLost, text_of(error));
    repaired_.lost.push_back(std::move(part));
    return {};
  }

  Result<void> take_layer(const LayerEntry& entry, std::size_t index) {
    const std::string subject = "layer " + printable(entry.info.name);
    auto part = parts_.read_layer_part(entry, index);
    if (part) {
      auto added =
          repaired_.map.hypermap.add_layer({.info = entry.info, .content = part->loaded.value});
      if (added) {
        take_part(subject, *part);
        return {};
      }
      return lose_part(subject, {entry.info.name, entry.class_name}, added.error());
    }
    return lose_part(subject, {entry.info.name, entry.class_name}, part.error());
  }

  /// Embeddings and views speak of objects, which may stand behind them.
  Result<void> take_extensions(const HypermapConfig& config) {
    for (const bool of_objects : {false, true}) {
      for (std::size_t i = 0; i < config.extensions.size(); ++i) {
        const std::string& format = config.extensions[i].format;
        const bool is_of_objects = format == kEmbeddingsFormat || format == kViewsFormat;
        if (is_of_objects == of_objects) HYPERMAP_TRY(take_extension(config.extensions[i], i));
      }
    }
    return {};
  }

  Result<void> take_extension(const ExtensionEntry& entry, std::size_t position) {
    const std::string subject = "extension " + printable(entry.name);
    const std::string owner = "extensions[" + std::to_string(position) + "].file";
    if (layers_.find(entry.format) != nullptr) return take_extension_layer(entry, owner, subject);
    const bool is_twin = entry.format == kOctreeTwinFormat;
    if (is_twin && !repaired_.map.octree) return take_twin(entry, owner, subject);
    MapArchive& map = repaired_.map;
    const ClassRegistry classes = map.classes;
    const auto read = [&](SalvagedMembers& members) -> Result<Loaded<bool>> {
      HYPERMAP_ASSIGN_OR_RETURN(auto findings, read_extension(map, members, entry, owner, limits_));
      return Loaded<bool>{.value = true, .findings = std::move(findings)};
    };
    auto part = parts_.read<bool>(read);
    if (!part) {
      map.classes = classes;  // all other readers change the map at their end
      // Made anew with each archive.
      if (is_twin && !is_of_the_system(part.error())) {
        note(subject, RepairOutcome::kRebuilt, "from the octree: " + text_of(part.error()));
        return {};
      }
      return lose_part(subject, {name_of_part(entry), entry.format}, part.error());
    }
    take_part(subject, *part);
    return {};
  }

  /// The twin of an octree that is lost is an octree of another program.
  Result<void> take_twin(ExtensionEntry entry,
                         const std::string& owner,
                         const std::string& subject) {
    LostPart lost{.name = entry.name, .class_name = entry.format};
    entry.format = kOctomapFormat;
    entry.name = "octree";
    const auto read = [&](SalvagedMembers& members) -> Result<Loaded<bool>> {
      HYPERMAP_ASSIGN_OR_RETURN(auto findings,
                                read_extension(repaired_.map, members, entry, owner, limits_));
      return Loaded<bool>{.value = true, .findings = std::move(findings)};
    };
    auto part = parts_.read<bool>(read);
    if (!part) return lose_part(subject, std::move(lost), part.error());
    parts_.use(part->used);
    note(subject,
         RepairOutcome::kRepaired,
         "stands for the octree, which is lost: occupied and free space without classes");
    return {};
  }

  /// Of a class grid the class.
  static std::string name_of_part(const ExtensionEntry& entry) {
    const ValueTree* name = entry.format == kClassGridFormat ? entry.extra.find("class") : nullptr;
    return name == nullptr ? entry.name : name->text;
  }

  Result<void> take_extension_layer(const ExtensionEntry& entry,
                                    const std::string& owner,
                                    const std::string& subject) {
    const auto read = [&](SalvagedMembers& members) {
      return read_extension_layer(members, entry, owner, limits_, layers_);
    };
    auto part = parts_.read<Layer>(read);
    if (!part) return lose_part(subject, {entry.name, entry.format}, part.error());
    const auto added = repaired_.map.hypermap.add_layer(part->loaded.value);
    if (!added) return lose_part(subject, {entry.name, entry.format}, added.error());
    take_part(subject, *part);
    return {};
  }

  /// Members that nothing names are kept, as load_archive keeps them; half a part is no part.
  Result<void> keep_the_rest(const HypermapConfig& config) {
    const ReservedNames reserved(config, repaired_.is_config_guessed);
    for (const auto& [name, bytes] : parts_.contents()) {
      if (parts_.is_used(name)) continue;
      const std::string subject = "member " + printable(name);
      if (reserved.contains(name)) {
        note(subject, RepairOutcome::kLost, "belongs to a part that is lost");
        continue;
      }
      const auto drawn = parts_.budget().draw_opaque_bytes(bytes.size());
      if (drawn) {
        repaired_.map.opaque_files.push_back({.name = name, .bytes = bytes});
      } else {
        HYPERMAP_TRY(lose_part(subject, {name, ""}, drawn.error()));
      }
    }
    return {};
  }

  PartReader parts_;
  const std::string& file_;
  const ArchiveLimits& limits_;
  const LayerRegistry& layers_;
  RepairedArchive repaired_;
};

Result<RepairedArchive> repair(const std::filesystem::path& path,
                               const ArchiveLimits& limits,
                               const LayerRegistry& layers,
                               const StopCheck& stop) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::shared_ptr<const ByteSource> source,
                            open_file(path, std::numeric_limits<std::uint64_t>::max()));
  if (auto allowed = check_archive_size(source->size(), limits.zip); !allowed)
    return Unexpected(with_source(std::move(allowed).error(), {.file = path.string()}));
  std::vector<RepairNote> notes;
  if (const auto sound = ZipReader::create(source, limits.zip); !sound) {
    notes.push_back({"directory", RepairOutcome::kRebuilt, text_of(sound.error())});
  }
  const std::string file = path.string();
  HYPERMAP_ASSIGN_OR_RETURN(ZipSalvage salvage,
                            salvage_zip(*source, limits.zip, LoadBudget(limits.sums, stop)));
  if (salvage.members.empty()) {
    return fail(ErrorCode::kMalformedFile,
                "no member of it is whole" +
                    (salvage.lost.empty() ? "" : ": " + to_string(salvage.lost.front())));
  }
  SalvagedContents contents;
  for (SalvagedMember& member : salvage.members) {
    notes.push_back({"member " + printable(member.name), RepairOutcome::kKept, ""});
    contents.emplace(std::move(member.name), std::move(member.bytes));
  }
  for (Error& lost : salvage.lost) {
    const std::string subject = "member " + printable(std::exchange(lost.entry, ""));
    notes.push_back({subject, RepairOutcome::kLost, to_string(lost)});
  }
  auto repaired = RepairingReader(std::move(contents), file, limits, layers, stop).read();
  if (!repaired) return repaired;
  // What became of a member in the end stands behind.
  std::erase_if(notes, [&](const RepairNote& note) {
    return std::ranges::find(repaired->notes, note.subject, &RepairNote::subject) !=
           repaired->notes.end();
  });
  repaired->notes.insert(repaired->notes.begin(), notes.begin(), notes.end());
  return repaired;
}

}  // namespace

Result<RepairedArchive> repair_archive(const std::filesystem::path& path,
                                       const ArchiveLimits& limits,
                                       const LayerRegistry& layers,
                                       const StopCheck& stop) {
  auto repaired = guarded(
      ErrorCode::kMalformedFile, "the map", [&] { return repair(path, limits, layers, stop); });
  if (!repaired)
    return Unexpected(with_source(std::move(repaired).error(), {.file = path.string()}));
  return repaired;
}

}  // namespace hypermap
