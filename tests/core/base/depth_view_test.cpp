// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/depth_view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

TEST(DepthView, FloatsRowByRowAreBorrowed) {
  const std::vector<float> metres{1, 2, 3, 4, 5, 6};
  const DepthImage image =
      depth_image({.buffer = bytes_of(metres), .width_px = 3, .height_px = 2}).value();
  EXPECT_EQ(image.pixels().data(), metres.data());
  EXPECT_EQ(image.at(2, 1), 6.0F);
}

TEST(DepthView, ACopyOfABorrowerOwnsItsPixelsAndSoDoesOneThatIsWrittenTo) {
  std::vector<float> metres{1, 2, 3, 4};
  DepthImage image =
      depth_image({.buffer = bytes_of(metres), .width_px = 2, .height_px = 2}).value();
  const DepthImage copy = image;
  DepthImage moved = std::move(image);
  EXPECT_TRUE(moved.is_borrowed());
  EXPECT_FALSE(copy.is_borrowed());
  metres[0] = 9;
  EXPECT_EQ(std::as_const(moved).at(0, 0), 9.0F);
  EXPECT_EQ(copy.at(0, 0), 1.0F);
  moved.at(1, 0) = 7;
  EXPECT_FALSE(moved.is_borrowed());
  EXPECT_EQ(metres[1], 2.0F) << "the foreign buffer is never written";
  EXPECT_EQ(moved.at(0, 0), 9.0F);
}

TEST(DepthView, RowsWithAGapAreCopied) {
  // Two pixels and a gap of one float; the last row ends with its pixels.
  const std::vector<float> metres{1, 2, -1, 3, 4};
  const DepthImage image =
      depth_image(
          {.buffer = bytes_of(metres), .width_px = 2, .height_px = 2, .row_stride_bytes = 12})
          .value();
  EXPECT_FALSE(image.is_borrowed());
  EXPECT_EQ(std::vector<float>(image.pixels().begin(), image.pixels().end()),
            (std::vector<float>{1, 2, 3, 4}));
}

TEST(DepthView, AddressesThatAreNotAlignedAreCopied) {
  const std::array<float, 2> metres{1.5F, 2.5F};
  std::array<std::byte, 9> buffer{};
  std::memcpy(buffer.data() + 1, metres.data(), sizeof(metres));
  const std::span<const std::byte> off(buffer.data() + 1, 8);
  const DepthImage image = depth_image({.buffer = off, .width_px = 2, .height_px = 1}).value();
  EXPECT_EQ(image.at(1, 0), 2.5F);
}

TEST(DepthView, WholeNumbersAreDividedByTheirUnit) {
  const std::vector<std::uint16_t> units{0, 1234, 65535, 5000};
  DepthView view{
      .buffer = bytes_of(units), .width_px = 2, .height_px = 2, .encoding = DepthEncoding::kUint16};
  const DepthImage millimetres = depth_image(view).value();
  EXPECT_EQ(millimetres.at(0, 0), 0.0F) << "no measurement";
  EXPECT_EQ(millimetres.at(1, 0), 1.234F);
  EXPECT_EQ(millimetres.at(0, 1), 65.535F);
  view.units_per_m = 5000.0;
  EXPECT_EQ(depth_image(view)->at(1, 1), 1.0F);
}

TEST(DepthView, NamesWhatDoesNotFit) {
  const std::vector<float> metres(6);
  const DepthView good{.buffer = bytes_of(metres), .width_px = 3, .height_px = 2};
  const auto field = [](const DepthView& view) { return depth_image(view).error().field; };
  DepthView bad = good;
  bad.width_px = 0;
  EXPECT_EQ(field(bad), "width_px");
  bad = good;
  bad.height_px = 65536;
  EXPECT_EQ(field(bad), "height_px");
  bad = good;
  bad.height_px = 3;
  EXPECT_EQ(field(bad), "buffer");
  EXPECT_EQ(depth_image(bad).error().what, "must hold 3 rows of 12 bytes, has 24 bytes");
  bad = good;
  bad.row_stride_bytes = 11;
  EXPECT_EQ(field(bad), "row_stride_bytes");
  bad.row_stride_bytes = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(field(bad), "buffer") << "no overflow";
  bad = good;
  bad.buffer = {};
  EXPECT_EQ(field(bad), "buffer");
  for (const double units : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    bad = good;
    bad.units_per_m = units;
    EXPECT_EQ(field(bad), "units_per_m");
  }
}

}  // namespace
}  // namespace hypermap
