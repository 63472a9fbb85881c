// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/jobs/sequence_list.hpp"
#include "targets.hpp"

#include <set>
#include <string>

namespace hypermap::fuzz {

void fuzz_sequences(std::string_view bytes) {
  const auto list = parse_sequence_list(bytes, kFuzzSource, "/data");
  if (!list) return;
  require(!list->empty() && list->size() <= kMaxListedSequences, "a list has sequences");
  require(!list->front().placement, "the first one is not placed");
  std::set<std::string> names;
  for (const ListedSequence& sequence : *list) {
    require(names.insert(sequence.name).second, "a name is given once");
    require(sequence.name.find('/') == std::string::npos && sequence.name.front() != '.',
            "a name is that of a file");
    require(!sequence.input.empty(), "a sequence has an input");
    require(sequence.detector_names.size() <= sequence.detections.size(), "detectors have files");
  }
}

}  // namespace hypermap::fuzz
