// SPDX-License-Identifier: BSD-3-Clause
#include "sizes_text.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"

namespace hypermap::app {
namespace {

std::string percent_of(std::uint64_t part, std::uint64_t whole) {
  return fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1);
}

std::string kilobytes(double bytes) {
  return fixed(bytes / 1024.0, 2);
}

std::string kilobytes(std::uint64_t bytes) {
  return kilobytes(static_cast<double>(bytes));
}

std::string parts_table(const ArchiveSizes& sizes) {
  Table table({"part", "kind", "KiB", "packed", "per cent"});
  for (const PartSize& part : sizes.parts) {
    table.add({printable(part.name),
               part.kind.empty() ? "-" : printable(part.kind),
               kilobytes(part.num_bytes),
               kilobytes(part.num_packed_bytes),
               percent_of(part.num_packed_bytes, sizes.num_bytes)});
  }
  return table.text() + "archive: " + kilobytes(sizes.num_bytes) + " KiB\n";
}

std::string objects_table(const ObjectSizes& objects) {
  const auto count = static_cast<double>(objects.num_objects);
  Table table({"of an object", "KiB", "packed"});
  for (const ObjectFieldSize& field : objects.fields) {
    table.add({field.key,
               kilobytes(static_cast<double>(field.num_bytes) / count),
               kilobytes(static_cast<double>(field.num_packed_bytes) / count)});
  }
  return "\n" + table.text() + count_text(objects.num_objects, "object") + ": packed " +
         kilobytes(objects.mean) + " KiB each; one by one the median is " +
         kilobytes(objects.median_alone) + ", the largest, object " +
         std::to_string(objects.largest.value) + ", " + kilobytes(objects.largest_alone) + "; " +
         std::to_string(objects.num_large) + " take more than " +
         std::to_string(kLargeObjectBytes / 1024) + " KiB\n";
}

std::string grids_line(const GridSizes& grids) {
  return "as grids of " + fixed(grids.cell_edge_m, 3) + " m, a byte a cell, for " +
         std::to_string(grids.num_classes) + (grids.num_classes == 1 ? " class" : " classes") +
         ": " + kilobytes(grids.flat_bytes) + " KiB in the plane, " +
         kilobytes(grids.volume_bytes) + " KiB in space\n";
}

}  // namespace

std::string sizes_text(const ArchiveSizes& sizes) {
  std::string text = parts_table(sizes);
  if (sizes.objects) text += objects_table(*sizes.objects);
  if (sizes.as_grids) text += "\n" + grids_line(*sizes.as_grids);
  return text;
}

}  // namespace hypermap::app
