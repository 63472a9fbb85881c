// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/point_cloud_file.hpp"

#include "support/pcd_file.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const SourceName kCloudSource{.file = "a.pcd"};

LabelledPoints parsed_cloud(const std::string& bytes) {
  auto cloud = parse_point_cloud(bytes, kCloudSource);
  EXPECT_TRUE(cloud) << (cloud ? "" : to_string(cloud.error()));
  return cloud ? *std::move(cloud) : LabelledPoints{};
}

std::string cloud_refusal(const std::string& bytes) {
  const auto cloud = parse_point_cloud(bytes, kCloudSource);
  return cloud ? "none" : to_string(cloud.error());
}

/// The bytes of numbers, of this machine's order.
template <class... T>
std::string raw(T... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

std::string swapped(std::string bytes) {
  return {bytes.rbegin(), bytes.rend()};
}

std::string pcd(const std::string& data, const std::string& body, const std::string& points = "2") {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z normal label\n"
         "SIZE 4 4 4 4 2\nTYPE F F F F U\nCOUNT 1 1 1 3 1\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data +
         "\n" + body;
}

/// Two points, (1, 2, 3) of label 7 and (-4, 5, 6.5) of label 65535.
LabelledPoints two_points() {
  return {.points = {{1, 2, 3}, {-4, 5, 6.5F}}, .labels = {7, 65535}};
}

TEST(PointCloudFile, PcdAsText) {
  EXPECT_EQ(parsed_cloud(pcd("ascii", "1 2 3 0 0 1 7\n\n-4 5.0 65e-1 nan nan 1 65535")),
            two_points());
}

TEST(PointCloudFile, PcdAsRows) {
  const auto label = [](int value) { return raw(static_cast<std::uint16_t>(value)); };
  EXPECT_EQ(parsed_cloud(pcd("binary",
                             raw(1.F, 2.F, 3.F, 0.F, 0.F, 1.F) + label(7) +
                                 raw(-4.F, 5.F, 6.5F, 0.F, 0.F, 1.F) + label(65535))),
            two_points());
}

/// Columns, packed as literals, but for the six zeros of the normals, which repeat the first byte.
TEST(PointCloudFile, PcdPacked) {
  const auto literal = [](const std::string& bytes) {
    return std::string(1, static_cast<char>(bytes.size() - 1)) + bytes;
  };
  const std::string places = raw(1.F, -4.F, 2.F, 5.F, 3.F, 6.5F);
  // After one zero a reference one byte back, of length 23 = 7 + 14 + 2.
  const std::string packed = literal(places) + literal(std::string(1, '\0')) +
                             std::string("\xE0\x0E\x00", 3) +
                             literal(raw(std::uint16_t{7}, std::uint16_t{65535}));
  const auto packed_size = static_cast<std::uint32_t>(packed.size());
  EXPECT_EQ(parsed_cloud(pcd("binary_compressed", raw(packed_size, std::uint32_t{52}) + packed)),
            two_points());
  EXPECT_THAT(cloud_refusal(pcd("binary_compressed", raw(packed_size, std::uint32_t{56}) + packed)),
              HasSubstr("unpacks to another size"));
  EXPECT_THAT(
      cloud_refusal(pcd("binary_compressed", raw(packed_size - 1, std::uint32_t{52}) + packed)),
      HasSubstr("DATA: is not what its size says"));
}

std::string ply(const std::string& format, const std::string& body) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\ncomment label 7 dining table\nelement camera 1\n"
         "property uchar id\nelement vertex 2\nproperty double x\nproperty float y\n"
         "property float z\nproperty ushort scalar_Label\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n" +
         body;
}

LabelledPoints named_points() {
  LabelledPoints points = two_points();
  points.names[7] = "dining table";
  return points;
}

TEST(PointCloudFile, PlyOfEveryForm) {
  EXPECT_EQ(parsed_cloud(ply("ascii", "9\n1 2 3 7\n-4 5 6.5 65535\n3 0 1 0\n")), named_points());
  const std::string first = raw(1.0) + raw(2.F, 3.F) + raw(std::uint16_t{7});
  const std::string second = raw(-4.0) + raw(5.F, 6.5F) + raw(std::uint16_t{65535});
  EXPECT_EQ(parsed_cloud(ply("binary_little_endian", "\t" + first + second + "faces")),
            named_points());
  const auto big = [](double x, float y, float z, std::uint16_t label) {
    return swapped(raw(x)) + swapped(raw(y)) + swapped(raw(z)) + swapped(raw(label));
  };
  EXPECT_EQ(
      parsed_cloud(ply("binary_big_endian", "\t" + big(1, 2, 3, 7) + big(-4, 5, 6.5F, 65535))),
      named_points());
}

TEST(PointCloudFile, WhatWasNotMeasuredIsLeftOut) {
  const LabelledPoints cloud = parsed_cloud(pcd("ascii", "1 2 nan 0 0 1 7\n1 2 3 0 0 1 8\n"));
  EXPECT_EQ(cloud.points.size(), 1U);
  EXPECT_THAT(cloud.labels, ElementsAre(8));
  EXPECT_EQ(cloud.num_unmeasured, 1U);
}

TEST(PointCloudFile, LabelsMayBeMissingAndMayBeFloats) {
  const std::string head = "VERSION .7\nFIELDS x y z";
  const std::string tail = "\nWIDTH 2\nHEIGHT 1\nDATA ascii\n";
  EXPECT_THAT(parsed_cloud(head + "\nSIZE 4 4 4\nTYPE F F F" + tail + "1 2 3\n4 5 6\n").labels,
              IsEmpty());
  const std::string with = head + " Scalar_Classification\nSIZE 4 4 4 4\nTYPE F F F F" + tail;
  EXPECT_THAT(parsed_cloud(with + "1 2 3 12\n4 5 6 nan\n").labels,
              ElementsAre(12, LabelledPoints::kNoLabel));
  EXPECT_THAT(cloud_refusal(with + "1 2 3 12.5\n4 5 6 1\n"),
              HasSubstr("a.pcd:8: label of point 0: must be a whole number, is 12.5"));
}

TEST(PointCloudFile, NamesWhatIsWrong) {
  EXPECT_THAT(cloud_refusal(pcd("ascii", "1 2 3 0 0 1 7\n1 2 3 0 0 1\n")),
              HasSubstr("a.pcd:13: point 1: has 6 values, expected 7"));
  EXPECT_THAT(cloud_refusal(pcd("ascii", "1 2 3 0 0 1 7\n1 2 x 0 0 1 8\n")),
              HasSubstr("a.pcd:13: point 1: is no number: 'x'"));
  EXPECT_THAT(cloud_refusal(pcd("ascii", "1 2 3 0 0 1 7\n")), HasSubstr("too few"));
  EXPECT_THAT(cloud_refusal(pcd("ascii", "2e6 2 3 0 0 1 7\n1 2 3 0 0 1 8\n")),
              HasSubstr("a coordinate is beyond 1e+06"));
  EXPECT_THAT(cloud_refusal(pcd("binary", "")), HasSubstr("too few"));
  EXPECT_THAT(cloud_refusal(pcd("zipped", "")), HasSubstr("DATA: must be ascii"));
  EXPECT_THAT(cloud_refusal(pcd("binary", "", "100000001")), HasSubstr("the limit is 100000000"));
  EXPECT_THAT(cloud_refusal(pcd("binary", "", "18446744073709551615")), HasSubstr("WIDTH"));
  EXPECT_THAT(cloud_refusal(pcd("ascii", "", "9999999")), HasSubstr("too few"));
  EXPECT_THAT(cloud_refusal("VERSION 0.7\nFIELDS x y z\n"), HasSubstr("ends before DATA"));
  EXPECT_THAT(cloud_refusal("VERSION 0.8\n"), HasSubstr("VERSION: must be 0.6 or 0.7"));
  EXPECT_THAT(cloud_refusal("ply\nformat ascii 1.0\nend_header\n"),
              HasSubstr("vertex: is missing"));
  EXPECT_THAT(cloud_refusal("ply\nelement vertex 0\nend_header\n"),
              HasSubstr("format: is missing"));
  EXPECT_THAT(
      cloud_refusal("ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nend_header\n"),
      HasSubstr("y: the cloud has no such field"));
  EXPECT_THAT(
      cloud_refusal("ply\nformat binary_little_endian 1.0\nelement face 2\nproperty list uchar "
                    "int i\nelement vertex 0\nend_header\n"),
      HasSubstr("face: has lists"));
  EXPECT_THAT(cloud_refusal("PNG"), HasSubstr("is neither PCD nor PLY"));
  EXPECT_EQ(read_point_cloud("/nowhere/a.ply").error().code, ErrorCode::kIo);
}

TEST(PointCloudFile, CutAnywhereItIsRefused) {
  const std::string whole = ply("binary_little_endian",
                                "\t" + raw(1.0) + raw(2.F, 3.F) + raw(std::uint16_t{7}) +
                                    raw(-4.0) + raw(5.F, 6.5F) + raw(std::uint16_t{65535}));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(parse_point_cloud(whole.substr(0, size), kCloudSource)) << size;
  EXPECT_TRUE(parse_point_cloud(whole, kCloudSource));
}

TEST(PointCloudFile, RecordedCloudsAreRead) {
  HYPERMAP_REQUIRE_SHARED_DATA("clouds/mOSD/learn0.pcd");
  const auto path = test::shared_data("clouds/mOSD/learn0.pcd");
  const auto cloud = read_point_cloud(path);
  ASSERT_TRUE(cloud) << to_string(cloud.error());
  const test::PcdCloud expected = test::read_pcd(path);
  std::size_t next = 0;
  for (std::size_t i = 0; i < expected.fields.at("label").size(); ++i) {
    const Eigen::Vector3f point(
        expected.number("x", i), expected.number("y", i), expected.number("z", i));
    if (!point.allFinite()) continue;
    ASSERT_LT(next, cloud->points.size());
    ASSERT_EQ(cloud->points[next], point);
    ASSERT_EQ(cloud->labels[next], expected.fields.at("label")[i]);
    ++next;
  }
  EXPECT_EQ(next, cloud->points.size());
  EXPECT_EQ(cloud->points.size() + cloud->num_unmeasured, 640U * 480U);
  const auto colored =
      read_point_cloud(test::shared_data("clouds/pcl_data_kinect/region_growing_rgb_tutorial.pcd"));
  ASSERT_TRUE(colored) << to_string(colored.error());
  EXPECT_THAT(colored->labels, IsEmpty());
  EXPECT_GT(colored->points.size(), 10'000U);
}

}  // namespace
}  // namespace hypermap
