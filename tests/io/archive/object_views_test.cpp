// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_views.hpp"

#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/codec/jpeg_writer.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace hypermap {
namespace {

using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::sample_archive;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const SourceName kViewsSource{.file = "a.hmap", .entry = "views.bin"};

ObjectView view_of(int width_px, int height_px) {
  return {.quality = 123.5,
          .frame_index = 7,
          .jpeg = encode_jpeg(ColorImage(width_px, height_px, Rgb8{200, 100, 0}), 85).value()};
}

std::string views_refusal(const std::string& bytes) {
  const auto parsed = parse_object_views(bytes, kViewsSource);
  return parsed ? "none" : to_string(parsed.error());
}

MapArchive archive_with_view() {
  MapArchive archive = sample_archive();
  archive.views = {{ObjectId{1}, view_of(12, 9)}};
  return archive;
}

TEST(ObjectViews, WhatIsReadEqualsWhatWasWritten) {
  const ObjectViews views{{ObjectId{2}, view_of(160, 3)}, {ObjectId{9}, view_of(1, 160)}};
  const std::string bytes = write_object_views(views).value();
  EXPECT_EQ(parse_object_views(bytes, kViewsSource).value(), views);
  EXPECT_TRUE(parse_object_views(write_object_views({}).value(), kViewsSource).value().empty());
}

TEST(ObjectViews, EveryCutIsRefusedAtItsByte) {
  const std::string bytes = write_object_views({{ObjectId{2}, view_of(8, 8)}}).value();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(views_refusal(bytes.substr(0, size)), HasSubstr("a.hmap!views.bin: byte "));
  EXPECT_THAT(views_refusal(bytes + "x"), HasSubstr("must end here, has 1 bytes more"));
}

TEST(ObjectViews, WhatIsNoViewIsRefused) {
  const auto refusal = [](const ObjectView& view) {
    const auto valid = validate(view);
    return valid ? "none" : to_string(valid.error());
  };
  EXPECT_EQ(refusal(view_of(160, 160)), "none");
  EXPECT_THAT(refusal(view_of(161, 1)), HasSubstr("at most 160, is 161 x 1"));
  ObjectView view = view_of(4, 4);
  view.quality = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(view), HasSubstr("quality: must be finite and > 0"));
  view = view_of(4, 4);
  view.jpeg.resize(kMaxViewBytes + 1);
  EXPECT_THAT(refusal(view), HasSubstr("at most 16384 bytes"));
  view.jpeg = "no image";
  EXPECT_THAT(refusal(view), HasSubstr("must be a JPEG"));
  const std::string bytes = write_object_views({{ObjectId{2}, view_of(8, 8)}}).value();
  std::string without_id = bytes;
  without_id[12] = '\0';
  EXPECT_THAT(views_refusal(without_id), HasSubstr("byte 12: ids of objects must ascend"));
}

TEST(ObjectViews, AnArchiveKeepsThemAndCountsThem) {
  const MapArchive archive = archive_with_view();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, IsEmpty());
  EXPECT_EQ(loaded->value.views, archive.views);
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  EXPECT_EQ(describe(loaded->value).num_views, 1U);
  EXPECT_THAT(load_error(changed(bytes, {{"views.bin", "HMVIEWS1"}})),
              HasSubstr("a.hmap!views.bin: byte 8: is cut"));
}

TEST(ObjectViews, OfObjectsThatAreNotThereAreLeftOutAndNotWritten) {
  MapArchive archive = archive_with_view();
  const std::string others = write_object_views({{ObjectId{8}, view_of(5, 5)}}).value();
  const std::string bytes = changed(write_archive(archive).value(), {{"views.bin", others}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, SizeIs(1));
  EXPECT_TRUE(loaded->value.views.empty());
  archive.views = {{ObjectId{8}, view_of(5, 5)}};
  EXPECT_THAT(to_string(write_archive(archive).error()), HasSubstr("views: shows object 8"));
}

}  // namespace
}  // namespace hypermap
