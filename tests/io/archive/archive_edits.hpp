// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Archives taken apart, changed and put together again, and what loading says of them.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_writer.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {

inline const SourceName kArchiveSource{.file = "a.hmap"};

using Files = std::vector<std::pair<std::string, std::string>>;

inline std::string zip_of(const Files& files) {
  ZipWriter writer;
  for (const auto& [name, content] : files) EXPECT_TRUE(writer.add(name, content));
  return writer.finish().value();
}

/// The members of an archive, some of them changed or left out (empty content).
inline std::string changed(const std::string& bytes, const Files& changes) {
  const auto zip = ZipReader::create(view_bytes(bytes));
  Files files;
  for (const ZipMember& member : zip->members()) {
    std::string content = zip->read(member.name).value();
    bool left_out = false;
    for (const auto& [name, new_content] : changes) {
      if (name != member.name) continue;
      content = new_content;
      left_out = new_content.empty();
    }
    if (!left_out) files.emplace_back(member.name, content);
  }
  return zip_of(files);
}

inline std::string member_of(const std::string& bytes, const std::string& name) {
  return ZipReader::create(view_bytes(bytes))->read(name).value();
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string load_error(const std::string& bytes) {
  const auto archive = parse_archive(bytes, kArchiveSource);
  return archive ? "no error" : to_string(archive.error());
}

inline std::string all_findings(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += to_string(finding.error) + "\n";
  return text;
}

}  // namespace hypermap::test
