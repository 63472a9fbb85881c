// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/provenance.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 12> kProvenanceKeys{"tool",
                                                           "input",
                                                           "input_hash",
                                                           "options",
                                                           "map_from_input",
                                                           "world",
                                                           "first_frame_hash",
                                                           "next_frame_index",
                                                           "session",
                                                           "first_stamp_ns",
                                                           "last_stamp_ns",
                                                           "earlier"};
constexpr std::int64_t kMaxFrameIndex = std::int64_t{1} << 62;
constexpr std::size_t kMaxSessionBytes = 100;
constexpr double kRigidTolerance = 1e-6;

/// A rotation and a finite translation. Errors: kInvalidArgument.
Result<void> check_rigid(const Eigen::Matrix4d& matrix) {
  const bool rigid = is_rigid(Eigen::Isometry3d(matrix), kRigidTolerance) &&
                     matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  if (rigid) return {};
  return fail(ErrorCode::kInvalidArgument,
              "is no rigid transform (rotation, finite translation, last row 0 0 0 1)",
              "map_from_input");
}

Result<MapFromInput> parse_transform(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> rows, node.as_list());
  if (rows.size() != 4) return tl::make_unexpected(node.error("expected 4 rows of 4 numbers"));
  Eigen::Matrix4d matrix;
  for (int r = 0; r < 4; ++r) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> row,
                              rows[static_cast<std::size_t>(r)].as_doubles(4));
    for (int c = 0; c < 4; ++c) matrix(r, c) = row[static_cast<std::size_t>(c)];
  }
  if (const auto rigid = check_rigid(matrix); !rigid)
    return tl::make_unexpected(node.error(rigid.error().what));
  return MapFromInput(Eigen::Isometry3d(matrix));
}

ValueTree tree_of(const MapFromInput& transform) {
  const Eigen::Matrix4d matrix = transform.isometry().matrix();
  std::vector<ValueTree> rows;
  rows.reserve(4);
  for (int r = 0; r < 4; ++r) {
    std::vector<ValueTree> row;
    row.reserve(4);
    for (int c = 0; c < 4; ++c) row.push_back(make_number(matrix(r, c)));
    rows.push_back(make_list(std::move(row)));
  }
  return make_list(std::move(rows));
}

Result<std::string> string_at(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  return node.as_string();
}

/// Empty when the key is absent.
Result<std::string> optional_string(const YamlNode& root, std::string_view key) {
  const auto node = root.find(key);
  if (!node) return std::string{};
  return node->as_string();
}

/// None when the key is absent.
Result<std::optional<Stamp>> optional_stamp(const YamlNode& root, std::string_view key) {
  const auto node = root.find(key);
  if (!node) return std::optional<Stamp>();
  using Ns = std::numeric_limits<std::int64_t>;
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t ns, node->as_int(Ns::min(), Ns::max()));
  return std::optional(Stamp{ns});
}

/// Empty when the key is absent.
Result<std::string> optional_session(const YamlNode& root) {
  const auto node = root.find("session");
  if (!node) return std::string{};
  HYPERMAP_ASSIGN_OR_RETURN(std::string name, node->as_string());
  if (const auto sound = check_session_name(name); !sound)
    return tl::make_unexpected(node->error(sound.error().what));
  return name;
}

/// A run without those before it.
Result<Provenance> parse_run(const YamlNode& root) {
  HYPERMAP_TRY(root.as_map());
  Provenance run;
  HYPERMAP_ASSIGN_OR_RETURN(run.tool, string_at(root, "tool"));
  HYPERMAP_ASSIGN_OR_RETURN(run.input, string_at(root, "input"));
  HYPERMAP_ASSIGN_OR_RETURN(run.input_hash, string_at(root, "input_hash"));
  if (const auto options = root.find("options")) {
    if (!options->is_null()) HYPERMAP_TRY(options->as_map());
    run.options = options->value();
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode transform, root.at("map_from_input"));
  HYPERMAP_ASSIGN_OR_RETURN(run.map_from_input, parse_transform(transform));
  HYPERMAP_ASSIGN_OR_RETURN(run.world, optional_string(root, "world"));
  HYPERMAP_ASSIGN_OR_RETURN(run.first_frame_hash, optional_string(root, "first_frame_hash"));
  if (const auto next = root.find("next_frame_index")) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t index, next->as_int(0, kMaxFrameIndex));
    run.next_frame_index = static_cast<std::uint64_t>(index);
  }
  HYPERMAP_ASSIGN_OR_RETURN(run.session, optional_session(root));
  HYPERMAP_ASSIGN_OR_RETURN(run.first_stamp, optional_stamp(root, "first_stamp_ns"));
  HYPERMAP_ASSIGN_OR_RETURN(run.last_stamp, optional_stamp(root, "last_stamp_ns"));
  run.extra = other_keys(root.value(), kProvenanceKeys);
  return run;
}

Result<std::vector<YamlNode>> earlier_runs(const YamlNode& root) {
  const auto earlier = root.find("earlier");
  if (!earlier) return std::vector<YamlNode>{};
  HYPERMAP_ASSIGN_OR_RETURN(auto runs, earlier->as_list());
  if (runs.size() < kMaxRuns) return runs;
  return tl::make_unexpected(earlier->error(std::to_string(runs.size()) +
                                                " runs are more than the limit of " +
                                                std::to_string(kMaxRuns - 1),
                                            ErrorCode::kLimit));
}

/// In digits alone, however large.
template <class Integer>
ValueTree integer(Integer number) {
  return {.kind = ValueKind::kScalar, .text = std::to_string(number)};
}

/// Keys of a run; what is empty or unknown is left out, as files of before had no such keys.
Result<std::vector<ValueTree::Entry>> entries_of(const Provenance& run) {
  HYPERMAP_TRY(check_rigid(run.map_from_input.isometry().matrix()));
  if (run.next_frame_index > static_cast<std::uint64_t>(kMaxFrameIndex)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be at most 2^62, is " + std::to_string(run.next_frame_index),
                "next_frame_index");
  }
  std::vector<ValueTree::Entry> entries{{"tool", make_text(run.tool)},
                                        {"input", make_text(run.input)},
                                        {"input_hash", make_text(run.input_hash)}};
  if (run.options.kind != ValueKind::kNull) entries.emplace_back("options", run.options);
  entries.emplace_back("map_from_input", tree_of(run.map_from_input));
  if (!run.world.empty()) entries.emplace_back("world", make_text(run.world));
  if (!run.first_frame_hash.empty())
    entries.emplace_back("first_frame_hash", make_text(run.first_frame_hash));
  if (run.next_frame_index > 0)
    entries.emplace_back("next_frame_index", integer(run.next_frame_index));
  if (!run.session.empty()) {
    HYPERMAP_TRY(check_session_name(run.session));
    entries.emplace_back("session", make_text(run.session));
  }
  if (run.first_stamp) entries.emplace_back("first_stamp_ns", integer(run.first_stamp->ns));
  if (run.last_stamp) entries.emplace_back("last_stamp_ns", integer(run.last_stamp->ns));
  return entries;
}

}  // namespace

bool operator==(const Provenance& a, const Provenance& b) {
  return a.tool == b.tool && a.input == b.input && a.input_hash == b.input_hash &&
         a.options == b.options && a.world == b.world && a.first_frame_hash == b.first_frame_hash &&
         a.next_frame_index == b.next_frame_index && a.session == b.session &&
         a.first_stamp == b.first_stamp && a.last_stamp == b.last_stamp && a.extra == b.extra &&
         a.map_from_input.isometry().matrix() == b.map_from_input.isometry().matrix();
}

Result<void> check_session_name(std::string_view name) {
  const auto refuse = [](std::string what) {
    return fail(ErrorCode::kInvalidArgument, std::move(what), "session");
  };
  if (name.empty() || name.size() > kMaxSessionBytes) {
    return refuse("must be a name of 1 .. " + std::to_string(kMaxSessionBytes) + " bytes, has " +
                  std::to_string(name.size()));
  }
  const std::string shown = printable(name);
  if (shown != name || name.front() == ' ' || name.back() == ' ')
    return refuse("must print, without blanks at its ends, is '" + shown + "'");
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!std::ranges::all_of(name, is_digit)) return {};
  return refuse("must be no number, which stands for a run without a name, is " + shown);
}

Result<Loaded<std::vector<Provenance>>> parse_provenance(std::string_view bytes,
                                                         const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source));
  const YamlNode root = document.root();
  HYPERMAP_TRY(root.as_map());
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<YamlNode> nodes, earlier_runs(root));
  nodes.push_back(root);
  Loaded<std::vector<Provenance>> loaded;
  loaded.value.reserve(nodes.size());
  for (const YamlNode& node : nodes) {
    HYPERMAP_ASSIGN_OR_RETURN(Provenance run, parse_run(node));
    loaded.value.push_back(std::move(run));
    auto unknown = node.unknown_keys(kProvenanceKeys);
    std::move(unknown.begin(), unknown.end(), std::back_inserter(loaded.findings));
  }
  return loaded;
}

Result<std::string> write_provenance(std::span<const Provenance> runs) {
  if (runs.size() > kMaxRuns) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must be at most " + std::to_string(kMaxRuns) + " runs, are " + std::to_string(runs.size()),
        "earlier");
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto entries, entries_of(runs.back()));
  std::vector<ValueTree> earlier;
  earlier.reserve(runs.size());
  for (const Provenance& run : runs.first(runs.size() - 1)) {
    HYPERMAP_ASSIGN_OR_RETURN(auto keys, entries_of(run));
    append_keys(keys, run.extra);
    earlier.push_back(make_map(std::move(keys)));
  }
  if (!earlier.empty()) entries.emplace_back("earlier", make_list(std::move(earlier)));
  append_keys(entries, runs.back().extra);
  return write_yaml(make_map(std::move(entries)));
}

struct InputHash::State {
  State() {
    if (hash == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  State(State&&) = delete;
  State& operator=(State&&) = delete;

  XXH3_state_t* hash = XXH3_createState();
};

InputHash::InputHash() : state_(std::make_unique<State>()) {}
InputHash::InputHash(InputHash&&) noexcept = default;
InputHash& InputHash::operator=(InputHash&&) noexcept = default;
InputHash::~InputHash() = default;

void InputHash::add(std::string_view piece) {
  const std::uint64_t num_bytes = piece.size();
  XXH3_128bits_update(state_->hash, &num_bytes, sizeof(num_bytes));
  XXH3_128bits_update(state_->hash, piece.data(), piece.size());
}

std::string InputHash::text() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->hash));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "xxh3-128:";
  for (const unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xfU];
  }
  return text;
}

}  // namespace hypermap
