// SPDX-License-Identifier: BSD-3-Clause
// What `export_map` writes of a topological map.
#include "hypermap/io/exports/map_export.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

Result<std::string> exported_topology(const MapArchive& archive, const std::string& name) {
  const test::TempDir dir;
  ExportRequest request;
  request.format = ExportFormat::kTopologicalMap;
  request.output = dir / name;
  const auto written = export_map(archive, request);
  if (!written) return Unexpected(written.error());
  if (written->empty()) return std::string("nothing");
  std::ostringstream text;
  text << std::ifstream(written->front()).rdbuf();
  return text.str();
}

TEST(ExportTopologicalMap, AHandWorkedGraphAsDot) {
  MapArchive archive;
  const ClassId cup = archive.classes.add("cup").value();
  Object object;
  object.belief.observe(std::vector<ClassEvidence>{{cup, Probability(0.9)}}, Probability(0.5));
  object.box = {{-0.1, 1.9, 1.15}, {0.1, 2.1, 1.35}};
  object.centroid_in_map = {0, 2, 1.25};
  archive.objects.add(object);
  archive.topological_map.emplace();
  archive.topological_map->observe({0, 0, 1.25});
  archive.topological_map->observe({1.5, 0, 1.25});
  archive.topological_map->cover(object.centroid_in_map);
  EXPECT_EQ(exported_topology(archive, "a.dot").value(),
            "graph topological_map {\n"
            "  0 [label=\"0\", pos=\"0,0!\"];\n"
            "  1 [label=\"1\", pos=\"0.95,0!\"];\n"
            "  2 [label=\"2\", pos=\"0,0.95!\", style=dashed];\n"
            "  3 [label=\"3: cup 1\", pos=\"0,1.9!\", style=dashed];\n"
            "  0 -- 1 [len=0.95];\n"
            "  0 -- 2 [len=0.95];\n"
            "  2 -- 3 [len=0.95];\n"
            "}\n");
}

TEST(ExportTopologicalMap, OtherNamesAreRefusedAndNothingIsWrittenOfNothing) {
  EXPECT_THAT(to_string(exported_topology({}, "a.json").error()), HasSubstr("must end in .dot"));
  EXPECT_EQ(exported_topology({}, "a.dot").value(), "nothing");
}

}  // namespace
}  // namespace hypermap
