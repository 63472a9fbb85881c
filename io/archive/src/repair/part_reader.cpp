// SPDX-License-Identifier: BSD-3-Clause
#include "part_reader.hpp"

#include "hypermap/io/archive/semantic_yaml.hpp"
#include "layers/layer_files.hpp"
#include "mended_metadata.hpp"

namespace hypermap {

bool is_of_the_system(const Error& error) {
  return error.code == ErrorCode::kIo || error.code == ErrorCode::kOutOfMemory ||
         error.code == ErrorCode::kInterrupted;
}

Result<ReadPart<LayerContent>> PartReader::read_layer_part(const LayerEntry& entry,
                                                           std::size_t index) {
  auto part = read_as_it_is(entry, index);
  if (part || is_of_the_system(part.error())) return part;
  if (entry.class_name == "SemanticLayer") {
    auto mended = read_sound_shapes(entry);
    if (mended) return mended;
  } else if (entry.class_name == "OccupancyGridLayer") {
    auto mended = read_mended_grid(entry, index);
    if (mended) return mended;
  }
  return part;
}

Result<ReadPart<LayerContent>> PartReader::read_as_it_is(const LayerEntry& entry,
                                                         std::size_t index) const {
  return read<LayerContent>([&](SalvagedMembers& members) {
    return read_layer(members, entry, index, limits_, layers_);
  });
}

Result<ReadPart<LayerContent>> PartReader::read_sound_shapes(const LayerEntry& entry) const {
  return read<LayerContent>([&](SalvagedMembers& members) -> Result<Loaded<LayerContent>> {
    const std::string name = stem_of(entry.info);
    HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml,
                              members.take(name, "file", limits_.max_shapes_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(
        auto layer,
        parse_semantic_layer(yaml, members.source_of(name), {.skip_bad = true}, budget_));
    if (layer.value.objects().empty())
      return fail(ErrorCode::kMalformedFile, "no shape of it is right");
    return Loaded<LayerContent>{.value = LayerContent(std::move(layer.value)),
                                .findings = std::move(layer.findings)};
  });
}

Result<ReadPart<LayerContent>> PartReader::read_mended_grid(const LayerEntry& entry,
                                                            std::size_t index) {
  const std::string stem = stem_of(entry.info);
  const std::string name = stem + ".yaml";
  const auto found = contents_.find(name);
  if (found == contents_.end()) return fail(ErrorCode::kMalformedFile, name + " is not there");
  const SourceName source{.file = file_, .entry = name};
  HYPERMAP_ASSIGN_OR_RETURN(MendedMetadata mended,
                            mend_metadata(found->second, stem, source, contents_));
  std::string before = std::exchange(found->second, std::move(mended.yaml));
  auto part = read_as_it_is(entry, index);
  if (!part) {
    found->second = std::move(before);
    return part;
  }
  for (std::string& what : mended.mended) {
    part->loaded.findings.push_back({.error = {.code = ErrorCode::kMalformedFile,
                                               .what = std::move(what),
                                               .file = file_,
                                               .entry = name}});
  }
  return part;
}

}  // namespace hypermap
