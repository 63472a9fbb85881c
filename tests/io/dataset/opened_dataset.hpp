// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Datasets as tests open them: readable, or refused with a text.
#pragma once

#include "hypermap/io/dataset/dataset_reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace hypermap::test {

inline std::unique_ptr<DatasetReader> opened(const std::filesystem::path& folder,
                                             ClassRegistry& registry,
                                             const DatasetOptions& options = {}) {
  auto reader = open_dataset(folder, options, registry);
  EXPECT_TRUE(reader) << to_string(reader.error());
  return reader ? std::move(*reader) : nullptr;
}

inline std::string refusal(const std::filesystem::path& folder,
                           const DatasetOptions& options = {}) {
  ClassRegistry registry;
  const auto reader = open_dataset(folder, options, registry);
  return reader ? "was accepted" : to_string(reader.error());
}

}  // namespace hypermap::test
