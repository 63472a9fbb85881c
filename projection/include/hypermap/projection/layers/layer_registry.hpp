// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which types of layers a program can load.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/layers/layer_members.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace hypermap {

/// Makes a layer of its members. Errors: kMalformedFile or kLimit with the field.
using LayerLoader = std::function<Result<LayerContent>(LayerReader& reader)>;

struct LayerType {
  LayerContent empty;  ///< What a layer starts with that has no file.
  LayerLoader load;
};

/// Types of layers by class name. A value: each program, each call may have its own.
class LayerRegistry {
 public:
  /// The two types of the strict form: occupancy grid and semantic layer.
  LayerRegistry();

  /// Adds a type under the class name and with the version of `empty`.
  /// Errors: kInvalidArgument when the class name is taken or not plain (validate_layer_name).
  [[nodiscard]] Result<void> add(LayerContent empty, LayerLoader load);

  /// Null for a class that nobody registered.
  [[nodiscard]] const LayerType* find(std::string_view class_name) const;

 private:
  std::map<std::string, LayerType, std::less<>> types_;
};

}  // namespace hypermap
