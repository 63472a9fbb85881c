// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/provenance.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 5> kProvenanceKeys{
    "tool", "input", "input_hash", "options", "map_from_input"};
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

}  // namespace

bool operator==(const Provenance& a, const Provenance& b) {
  return a.tool == b.tool && a.input == b.input && a.input_hash == b.input_hash &&
         a.options == b.options && a.extra == b.extra &&
         a.map_from_input.isometry().matrix() == b.map_from_input.isometry().matrix();
}

Result<Loaded<Provenance>> parse_provenance(std::string_view bytes, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source));
  const YamlNode root = document.root();
  HYPERMAP_TRY(root.as_map());
  Loaded<Provenance> loaded{.value = {}, .findings = root.unknown_keys(kProvenanceKeys)};
  Provenance& provenance = loaded.value;
  HYPERMAP_ASSIGN_OR_RETURN(provenance.tool, string_at(root, "tool"));
  HYPERMAP_ASSIGN_OR_RETURN(provenance.input, string_at(root, "input"));
  HYPERMAP_ASSIGN_OR_RETURN(provenance.input_hash, string_at(root, "input_hash"));
  if (const auto options = root.find("options")) {
    if (!options->is_null()) HYPERMAP_TRY(options->as_map());
    provenance.options = options->value();
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode transform, root.at("map_from_input"));
  HYPERMAP_ASSIGN_OR_RETURN(provenance.map_from_input, parse_transform(transform));
  provenance.extra = other_keys(root.value(), kProvenanceKeys);
  return loaded;
}

Result<std::string> write_provenance(const Provenance& provenance) {
  HYPERMAP_TRY(check_rigid(provenance.map_from_input.isometry().matrix()));
  std::vector<ValueTree::Entry> entries{{"tool", make_text(provenance.tool)},
                                        {"input", make_text(provenance.input)},
                                        {"input_hash", make_text(provenance.input_hash)}};
  if (provenance.options.kind != ValueKind::kNull)
    entries.emplace_back("options", provenance.options);
  entries.emplace_back("map_from_input", tree_of(provenance.map_from_input));
  append_keys(entries, provenance.extra);
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
