// SPDX-License-Identifier: BSD-3-Clause
#include "detection_pairing.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "images/image_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kAmbiguous = static_cast<std::size_t>(-1);

/// Names of frames in all the ways in which detections may call them.
class EntryFinder {
 public:
  EntryFinder(const std::vector<SequenceEntry>& entries, double stamp_tolerance_s)
      : entries_(entries), tolerance_ns_(std::llround(stamp_tolerance_s * 1e9)) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      for (const std::string& path : {entries[i].color, entries[i].depth}) {
        if (path.empty()) continue;
        note(path, i);
        note(fs::path(path).filename().string(), i);
        note(fs::path(path).stem().string(), i);
      }
      if (entries[i].number) of_number_.emplace(*entries[i].number, i);
      by_stamp_.push_back(i);
    }
    std::stable_sort(by_stamp_.begin(), by_stamp_.end(), [&](std::size_t a, std::size_t b) {
      return entries[a].stamp < entries[b].stamp;
    });
  }

  [[nodiscard]] std::optional<std::size_t> find(const FrameDetections& frame) const {
    if (!frame.image.empty()) {
      const fs::path path(frame.image);
      for (const std::string& name :
           {frame.image, path.filename().string(), path.stem().string()}) {
        const auto found = of_name_.find(name);
        if (found != of_name_.end() && found->second != kAmbiguous) return found->second;
      }
      const auto number = number_in_name(frame.image);
      const auto found = number ? of_number_.find(*number) : of_number_.end();
      if (found != of_number_.end()) return found->second;
    }
    if (!frame.stamp) return std::nullopt;
    const auto position = nearest_stamp(
        by_stamp_, *frame.stamp, tolerance_ns_, [&](std::size_t i) { return entries_[i].stamp; });
    return position ? std::optional(by_stamp_[*position]) : std::nullopt;
  }

 private:
  void note(const std::string& name, std::size_t entry) {
    const auto [at, is_new] = of_name_.try_emplace(name, entry);
    if (!is_new && at->second != entry) at->second = kAmbiguous;
  }

  const std::vector<SequenceEntry>& entries_;
  std::int64_t tolerance_ns_;
  std::map<std::string, std::size_t> of_name_;
  std::map<std::uint64_t, std::size_t> of_number_;
  std::vector<std::size_t> by_stamp_;
};

std::string name_of(const FrameDetections& frame) {
  return frame.image.empty() ? "timestamp " + stamp_text(*frame.stamp) : frame.image;
}

bool speaks_of(const PairedDetections& paired, std::size_t entry) {
  return std::ranges::any_of(paired.frames_of_entry[entry], [&](std::size_t frame) {
    return !paired.set.frames[frame].detections.empty();
  });
}

}  // namespace

PairedDetections pair_detections(DetectionSet set,
                                 const std::vector<SequenceEntry>& entries,
                                 double stamp_tolerance_s) {
  const EntryFinder finder(entries, stamp_tolerance_s);
  PairedDetections out;
  out.frames_of_entry.resize(entries.size());
  for (std::size_t i = 0; i < set.frames.size(); ++i) {
    if (const auto entry = finder.find(set.frames[i])) {
      out.frames_of_entry[*entry].push_back(i);
    } else {
      out.unpaired.push_back("detections of " + printable(name_of(set.frames[i])) + ": no frame");
    }
  }
  out.set = std::move(set);
  return out;
}

Result<void> refuse_repeated(const PairedDetections& paired,
                             std::span<const PairedDetections> before) {
  if (paired.set.num_detections() == 0) return {};
  const auto same = std::ranges::find_if(before, [&](const PairedDetections& other) {
    return other.set.detector.name == paired.set.detector.name &&
           other.set.frames == paired.set.frames;
  });
  if (same == before.end()) return {};
  return Unexpected(
      Error{.code = ErrorCode::kInvalidArgument,
            .what = "says what " + printable(same->file, 300) +
                    " says, detection by detection: the same evidence would count twice",
            .file = paired.file});
}

std::optional<Finding> find_foreign(const PairedDetections& paired) {
  const std::vector<FrameDetections>& frames = paired.set.frames;
  if (frames.empty() || paired.unpaired.size() < frames.size()) return std::nullopt;
  const std::string first = frames.front().image.empty() ? "" : ", such as " + frames.front().image;
  return Finding{
      Severity::kWarning,
      {.code = ErrorCode::kNotFound,
       .what = "none of the " + std::to_string(frames.size()) +
               " images that it speaks of is one of the dataset's" + printable(first, 200),
       .file = paired.file,
       .field = "image"}};
}

std::optional<Finding> find_second_look(const PairedDetections& paired,
                                        std::span<const PairedDetections> before) {
  for (const PairedDetections& other : before) {
    if (other.detector != paired.detector) continue;
    std::size_t num_common = 0;
    for (std::size_t entry = 0; entry < paired.frames_of_entry.size(); ++entry) {
      num_common += speaks_of(paired, entry) && speaks_of(other, entry) ? 1U : 0U;
    }
    if (num_common == 0) continue;
    return Finding{
        Severity::kWarning,
        {.code = ErrorCode::kInvalidArgument,
         .what = "speaks for the same detector as " + printable(other.file, 300) + " does, in " +
                 count_text(num_common, "frame") + " of both: what it saw there counts twice",
         .file = paired.file,
         .field = "detector"}};
  }
  return std::nullopt;
}

Result<DetectorId> register_detector(const PairedDetections& paired,
                                     std::string_view given,
                                     std::span<const DetectorId> read,
                                     DetectorRegistry& detectors) {
  const std::string& own = paired.set.detector.name;
  if (!given.empty() && !own.empty() && given != own) {
    return fail(ErrorCode::kInvalidArgument,
                "is of detector \"" + printable(own) + "\" by what it says, not of \"" +
                    printable(given) + "\"",
                "detector");
  }
  if (!given.empty() && own.empty()) return detectors.add({.name = std::string(given)});
  if (!own.empty()) return detectors.add(paired.set.detector);
  const std::filesystem::path file(paired.file);
  const std::filesystem::path stem = file.has_stem() ? file.stem() : file.parent_path().stem();
  const std::string name = printable(stem.string());
  return detectors.add_unnamed(name.empty() ? "detections" : name, read);
}

}  // namespace hypermap
