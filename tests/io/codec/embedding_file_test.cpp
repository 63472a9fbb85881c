// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/embedding_file.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using namespace std::string_view_literals;

const SourceName kVectorSource{.file = "mug.npy"};

/// A NumPy file of version 1 with this header and these numbers.
std::string npy(const std::string& header, const std::string& numbers) {
  std::string bytes("\x93NUMPY\x01\x00"sv);
  bytes += static_cast<char>(static_cast<unsigned char>(header.size() & 0xffU));
  bytes += static_cast<char>(static_cast<unsigned char>(header.size() >> 8U));
  return bytes + header + numbers;
}

/// As NumPy writes it: padded, and ended by a line.
std::string npy_of(const std::string& type, const std::string& shape, const std::string& numbers) {
  return npy("{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }      \n",
             numbers);
}

std::string vector_refusal(const std::string& bytes) {
  const auto file = parse_embedding_file(bytes, kVectorSource);
  return file ? "none" : to_string(file.error());
}

const std::vector<float> kTwoNumbers{1.0F, -2.0F};

TEST(EmbeddingFile, NumpysVectorsAreRead) {
  const std::string floats = bytes_of_floats(kTwoNumbers);
  const std::string doubles("\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\xc0"sv);
  for (const std::string& bytes :
       {npy_of("<f4", "(2,)", floats),
        npy_of("<f4", "(1, 2)", floats),
        npy_of("<f8", "(2,)", doubles),
        npy("{\"shape\":(2,),\"descr\":\"<f4\",\"fortran_order\":True}", floats)}) {
    const auto file = parse_embedding_file(bytes, kVectorSource);
    ASSERT_TRUE(file) << to_string(file.error());
    EXPECT_EQ(file->vector, kTwoNumbers);
    EXPECT_EQ(file->model, std::nullopt);
  }
}

TEST(EmbeddingFile, AVersionTwoHeaderHasALongerSize) {
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2,)}";
  std::string bytes("\x93NUMPY\x02\x00"sv);
  append_uint32(bytes, static_cast<std::uint32_t>(header.size()));
  bytes += header + bytes_of_floats(kTwoNumbers);
  EXPECT_EQ(parse_embedding_file(bytes, kVectorSource)->vector, kTwoNumbers);
}

TEST(EmbeddingFile, JsonIsAListOrNamesItsModel) {
  EXPECT_EQ(parse_embedding_file("[1, -2]", kVectorSource)->vector, kTwoNumbers);
  const auto named =
      parse_embedding_file(R"({"model": "clip", "vector": "AACAPwAAAMA="})", kVectorSource);
  EXPECT_EQ(named->vector, kTwoNumbers);
  EXPECT_EQ(named->model, "clip");
}

TEST(EmbeddingFile, OtherTypesAndShapesAreNamed) {
  const std::string floats = bytes_of_floats(kTwoNumbers);
  EXPECT_THAT(vector_refusal(npy_of(">f4", "(2,)", floats)),
              HasSubstr("mug.npy: descr: must be <f4 or <f8 (float32, float64), is >f4"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "(2, 1)", floats)), HasSubstr("one vector, is (2, 1)"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "()", floats)), HasSubstr("one vector, is ()"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "(4097,)", floats)), HasSubstr("at most 4096 numbers"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "(3,)", floats)), HasSubstr("must have 12 bytes"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "(0,)", "")), HasSubstr("1 .. 4096 numbers, has 0"));
  EXPECT_THAT(vector_refusal(npy_of("<f4", "(1,)", std::string(4, '\0'))), HasSubstr("all 0"));
}

TEST(EmbeddingFile, WhatIsNoneIsRefused) {
  const std::string whole = npy_of("<f4", "(2,)", bytes_of_floats(kTwoNumbers));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(vector_refusal(whole.substr(0, size)), "none") << size;
  }
  EXPECT_NE(vector_refusal(whole + "x"), "none");
  for (const char* header : {"",
                             "{",
                             "{}",
                             "{'descr': '<f4'}",
                             "{'descr': [('a', '<f4')], 'shape': (1,)}",
                             "{'descr': '<f4', 'shape': (2}",
                             "{'descr': '<f4', 'shape': (2,), 'x': 1}"}) {
    EXPECT_NE(vector_refusal(npy(header, bytes_of_floats(kTwoNumbers))), "none") << header;
  }
  EXPECT_THAT(vector_refusal(std::string("\x93NUMPY\x04\x00\x00\x00\x00\x00"sv)),
              HasSubstr("1 .. 3, is 4"));
  EXPECT_NE(vector_refusal("1 2"), "none");
  EXPECT_THAT(vector_refusal(std::string(kMaxEmbeddingFileBytes + 1, ' ')),
              HasSubstr("at most 1048576"));
}

}  // namespace
}  // namespace hypermap
