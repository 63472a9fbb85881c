// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/palette_file.hpp"

#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace hypermap {
namespace {

class PaletteFile : public testing::Test {
 protected:
  Result<ClassPalette> read(const std::string& text) {
    std::ofstream(dir_ / "palette.yaml") << text;
    return read_palette(dir_ / "palette.yaml");
  }

  test::TempDir dir_;
};

TEST_F(PaletteFile, NamesColorsByClassInAnySpelling) {
  const auto palette = read("Dining Table: \"#ff8000\"\nchair: '#0A0b0C'\n");
  ASSERT_TRUE(palette) << to_string(palette.error());
  EXPECT_EQ(palette->color_of("diningtable"), (Rgb8{255, 128, 0}));
  EXPECT_EQ(palette->color_of("chair"), (Rgb8{10, 11, 12}));
  EXPECT_EQ(palette->color_of("sofa"), class_color("sofa"));
}

TEST_F(PaletteFile, WhatIsNoColorIsNamedWithItsLine) {
  for (const char* color :
       {"\"#ff80\"", "red", "\"#gg0000\"", "\"#-1-1-1\"", "[1, 2, 3]", "\"\""}) {
    const auto palette = read("sofa: \"#000000\"\nchair: " + std::string(color) + "\n");
    ASSERT_FALSE(palette) << color;
    EXPECT_EQ(palette.error().line, 2) << color;
    EXPECT_EQ(palette.error().field, "chair") << color;
  }
  EXPECT_FALSE(read("tv: \"#000000\"\ntvmonitor: \"#ffffff\"\n"));
  EXPECT_FALSE(read("- chair\n"));
  EXPECT_EQ(read_palette(dir_ / "absent.yaml").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
