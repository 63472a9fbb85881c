// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_export.hpp"

#include <gmock/gmock.h>

#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(OutputEnding, AnOutputEndsAsFilesOfItsFormatDo) {
  const auto said = [](ExportFormat format, const char* output) {
    ExportRequest request;
    request.format = format;
    request.output = output;
    const auto fits = validate(request);
    return fits ? std::string() : to_string(fits.error());
  };
  for (const char* name : {"a.ot", "a.bt", "a.OT", "b.c/a.b.bt"})
    EXPECT_THAT(said(ExportFormat::kOctomap, name), IsEmpty()) << name;
  for (const char* name : {"a.o", "a.o ", "a.t or", "ot", "a", "a.ot/b", "a.obt"})
    EXPECT_THAT(said(ExportFormat::kOctomap, name), HasSubstr("must end in .ot or .bt")) << name;
  EXPECT_THAT(said(ExportFormat::kColorOctomap, "a.bt"), HasSubstr("must end in .ot, is 'a.bt'"));
  for (const char* name : {"a", "a.ply", "a.Ply"})
    EXPECT_THAT(said(ExportFormat::kPly, name), IsEmpty()) << name;
  EXPECT_THAT(said(ExportFormat::kPly, "a.ply.txt"), HasSubstr("must end in .ply"));
  EXPECT_THAT(said(ExportFormat::kGeojson, "a.geojson"), HasSubstr("metres of the map"));
  EXPECT_THAT(said(ExportFormat::kRelations, "a.dot"), IsEmpty());
  EXPECT_THAT(said(ExportFormat::kRelations, "a.txt"), HasSubstr(".dot or .local.geojson"));
  EXPECT_THAT(said(ExportFormat::kClassGrids, "any.thing"), IsEmpty());
}

}  // namespace
}  // namespace hypermap
