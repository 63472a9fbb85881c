// SPDX-License-Identifier: BSD-3-Clause
// How do I load a map, go on with it and save it? Usage: resume_map MAP.hmap DATASET
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/io/archive/map_layers.hpp>
#include <hypermap/io/dataset/dataset_reader.hpp>
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>

#include <cstdio>

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

static int complain(const Error& error) {
  std::fprintf(stderr, "%s\n", to_string(error).c_str());
  return 2;
}

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  auto loaded = load_archive(argv[1]);
  if (!loaded) return complain(loaded.error());
  MapArchive& map = loaded->value;
  if (!map.octree) return 2;

  SemanticMapperOptions options;
  options.octree = map.octree->options();
  auto mapper = SemanticMapper::resume(options, *map.octree, map.objects, map.classes);
  if (!mapper) return complain(mapper.error());

  // Classes that the dataset names come after those of the map.
  const auto dataset = open_dataset(argv[2], {}, map.classes);
  if (!dataset) return complain(dataset.error());
  for (std::size_t i = 0; i < (*dataset)->size(); ++i) {
    const auto frame = (*dataset)->read(i);
    const auto report = frame ? mapper->integrate(*frame) : Result<FrameReport>();
    if (!frame || !report) return complain(frame ? report.error() : frame.error());
  }

  map.octree = mapper->octree();
  map.objects = mapper->objects();
  Provenance run;  // the map tells of every run that put frames into it
  run.tool = "resume_map";
  run.input = (*dataset)->summary().name;
  map.provenance.push_back(run);
  if (const auto derived = derive_layers(map, options.objects, {}); !derived) {
    return complain(derived.error());
  }
  if (const auto saved = save_archive(map, argv[1]); !saved) return complain(saved.error());
  std::printf("%zu frames more, %zu objects\n", (*dataset)->size(), map.objects.size());
}
