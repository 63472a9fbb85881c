// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_sizes.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"

namespace hypermap {
namespace {

std::string part_json(const PartSize& part) {
  return json_object({{"name", json_quoted(part.name)},
                      {"kind", json_quoted(part.kind)},
                      {"bytes", std::to_string(part.num_bytes)},
                      {"packed_bytes", std::to_string(part.num_packed_bytes)}});
}

std::string field_json(const ObjectFieldSize& field) {
  return json_object({{"key", json_quoted(field.key)},
                      {"bytes", std::to_string(field.num_bytes)},
                      {"packed_bytes", std::to_string(field.num_packed_bytes)}});
}

std::string objects_json(const ObjectSizes& objects) {
  return json_object({{"count", std::to_string(objects.num_objects)},
                      {"mean_packed_bytes", json_number(objects.mean)},
                      {"median_alone", std::to_string(objects.median_alone)},
                      {"largest_alone", std::to_string(objects.largest_alone)},
                      {"largest", std::to_string(objects.largest.value)},
                      {"num_large", std::to_string(objects.num_large)},
                      {"fields", json_array(objects.fields, [](const auto& field) {
                         return field_json(field);
                       })}});
}

std::string grids_json(const GridSizes& grids) {
  return json_object({{"classes", std::to_string(grids.num_classes)},
                      {"cell_edge_m", json_number(grids.cell_edge_m)},
                      {"flat_bytes", std::to_string(grids.flat_bytes)},
                      {"volume_bytes", std::to_string(grids.volume_bytes)}});
}

}  // namespace

std::string to_json(const ArchiveSizes& sizes) {
  return json_object(
      {{"bytes", std::to_string(sizes.num_bytes)},
       {"parts", json_array(sizes.parts, [](const auto& part) { return part_json(part); })},
       {"objects", sizes.objects ? objects_json(*sizes.objects) : "null"},
       {"as_grids", sizes.as_grids ? grids_json(*sizes.as_grids) : "null"}});
}

}  // namespace hypermap
