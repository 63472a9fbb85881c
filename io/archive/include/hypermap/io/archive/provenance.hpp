// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a map came from: enough to make it again.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace hypermap {

/// Nothing here depends on the clock or on where the files lay, so that equal runs give equal maps.
struct Provenance {
  std::string tool;             ///< "hypermap 0.1.0".
  std::string input;            ///< Name of the dataset, without its folder.
  std::string input_hash;       ///< As `InputHash` gives it.
  ValueTree options = {};       ///< What was asked for, as a map; null when unknown.
  MapFromInput map_from_input;  ///< How the input's world was aligned to gravity.
  ValueTree extra = {};         ///< Unknown keys, as a map; null when there are none.
  friend bool operator==(const Provenance& a, const Provenance& b);
};

/// Findings: unknown keys. Errors: kMalformedFile naming field and line, also for a matrix that is
/// no rigid transform.
[[nodiscard]] Result<Loaded<Provenance>> parse_provenance(std::string_view bytes,
                                                          const SourceName& source);
/// Errors: kInvalidArgument for a transform that `parse_provenance` would refuse.
[[nodiscard]] Result<std::string> write_provenance(const Provenance& provenance);

/// Hash of everything that was read, fed piece by piece, as "xxh3-128:<32 hex digits>".
class InputHash {
 public:
  InputHash();
  InputHash(InputHash&&) noexcept;
  InputHash& operator=(InputHash&&) noexcept;
  ~InputHash();

  /// Pieces are distinguished: "ab" + "c" differs from "a" + "bc".
  void add(std::string_view piece);
  [[nodiscard]] std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hypermap
