// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a map came from: enough to make it again.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// One run that put frames into a map.
///
/// Nothing here depends on the clock or on where the files lay, so that equal runs give equal maps.
struct Provenance {
  std::string tool;             ///< "hypermap 0.1.0".
  std::string input;            ///< Name of the dataset, without its folder.
  std::string input_hash;       ///< As `InputHash` gives it.
  ValueTree options = {};       ///< What was asked for, as a map; null when unknown.
  MapFromInput map_from_input;  ///< Where the input's world lies in the map.
  /// What the input's description calls its world; empty: it has no name.
  std::string world = {};
  /// `recording_hash` of the first frame that was mapped; empty: unknown.
  std::string first_frame_hash = {};
  /// Frames of later runs count from here on, 0 .. 2^62; 0: unknown.
  std::uint64_t next_frame_index = 0;
  /// What people call the run; empty: it has no name. See `check_session_name`.
  std::string session = {};
  /// Stamps of its earliest and its latest frame in the map; none: unknown.
  std::optional<Stamp> first_stamp = std::nullopt;
  std::optional<Stamp> last_stamp = std::nullopt;
  ValueTree extra = {};  ///< Unknown keys, as a map; null when there are none.
  friend bool operator==(const Provenance& a, const Provenance& b);
};

/// Errors: kInvalidArgument naming `session` for a name that is empty, longer than 100 bytes,
/// begins or ends with a blank, has characters that do not print, or is a number: those stand for
/// runs without a name.
[[nodiscard]] Result<void> check_session_name(std::string_view name);

/// Runs that a file holds at most.
inline constexpr std::size_t kMaxRuns = 256;

/// The runs of a map, oldest first, at least one. The file is the newest run's, with the others in
/// its list `earlier`.
/// Findings: unknown keys. Errors: kMalformedFile naming field and line, also for a matrix that is
/// no rigid transform; kLimit for more than `kMaxRuns`.
[[nodiscard]] Result<Loaded<std::vector<Provenance>>> parse_provenance(std::string_view bytes,
                                                                       const SourceName& source);
/// Errors: kInvalidArgument for what `parse_provenance` would refuse. Requires: `runs` not empty.
[[nodiscard]] Result<std::string> write_provenance(std::span<const Provenance> runs);

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
