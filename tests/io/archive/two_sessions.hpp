// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Two runs of a map.
#pragma once

#include "hypermap/io/archive/provenance.hpp"

#include <cstdint>
#include <vector>

namespace hypermap::test {

inline Stamp history_stamp(std::int64_t second) {
  return Stamp{second * 1'000'000'000};
}

/// Runs of 30 frames each, the first named morning.
inline std::vector<Provenance> two_sessions(std::int64_t second_begins) {
  std::vector<Provenance> runs(2);
  runs[0].input = "lab";
  runs[0].session = "morning";
  runs[0].next_frame_index = 30;
  runs[0].first_stamp = history_stamp(0);
  runs[0].last_stamp = history_stamp(29);
  runs[1].input = "lab2";
  runs[1].next_frame_index = 60;
  runs[1].first_stamp = history_stamp(second_begins);
  runs[1].last_stamp = history_stamp(second_begins + 29);
  return runs;
}

}  // namespace hypermap::test
