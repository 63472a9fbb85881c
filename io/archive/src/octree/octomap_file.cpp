// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/octomap_file.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "octomap_header.hpp"
#include "octomap_nodes_reader.hpp"
#include "octomap_writer.hpp"

#include <array>
#include <exception>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

struct TypeName {
  std::string_view id;
  OctomapKind kind;
};
// OcTreeStamped keeps its stamps in memory only; its files are those of OcTree.
constexpr std::array kTypes{TypeName{"OcTree", OctomapKind::kOccupancy},
                            TypeName{"ColorOcTree", OctomapKind::kColor},
                            TypeName{kSemanticOctreeId, OctomapKind::kSemantic},
                            TypeName{"OcTreeStamped", OctomapKind::kOccupancy}};

std::string_view id_of(OctomapKind kind) {
  for (const TypeName& type : kTypes)
    if (type.kind == kind) return type.id;
  return {};
}

Result<OctomapKind> kind_of(std::string_view id) {
  for (const TypeName& type : kTypes)
    if (type.id == id) return type.kind;
  return fail(ErrorCode::kUnsupported,
              "is '" + printable(id, 40) +
                  "', expected OcTree, ColorOcTree, OcTreeStamped or SemanticOcTree",
              "id");
}

/// A file's name must not promise the other format.
Result<void> check_extension(const SourceName& source, bool binary) {
  const std::string& name = source.entry.empty() ? source.file : source.entry;
  if (name.ends_with(binary ? ".ot" : ".bt"))
    return fail(ErrorCode::kMalformedFile,
                binary ? "is a .bt file named .ot" : "is an .ot file named .bt",
                "header");
  return {};
}

Finding stale(std::uint64_t count) {
  return {.error = {.code = ErrorCode::kMalformedFile,
                    .what = std::to_string(count) +
                            " inner nodes disagree with their children; they were computed anew",
                    .field = "octree"}};
}

Result<OctomapNodes> read_nodes(const OctomapHeader& header,
                                OctomapKind kind,
                                std::string_view bytes,
                                const LoadBudget& budget) {
  if (header.num_nodes == 0 && bytes.empty()) return OctomapNodes{};
  if (header.num_nodes == 0)
    return fail(ErrorCode::kMalformedFile, "is 0, yet data follow", "size");
  return header.binary ? read_binary_nodes(bytes, header.num_nodes, budget)
                       : read_full_nodes(bytes, kind, header.num_nodes, budget);
}

Result<Loaded<OctomapTree>> parse(std::string_view bytes,
                                  const SourceName& source,
                                  const OctomapLimits& limits,
                                  const LoadBudget& budget) {
  if (bytes.size() > limits.max_file_bytes)
    return fail(ErrorCode::kLimit,
                std::to_string(bytes.size()) + " bytes, the limit is " +
                    std::to_string(limits.max_file_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(OctomapHeader header, parse_octomap_header(bytes));
  HYPERMAP_TRY(check_octomap_checksum(bytes, header));
  HYPERMAP_TRY(check_extension(source, header.binary));
  HYPERMAP_ASSIGN_OR_RETURN(const OctomapKind kind, kind_of(header.id));
  if (header.num_nodes > limits.max_nodes)
    return fail(ErrorCode::kLimit,
                std::to_string(header.num_nodes) + " nodes, the limit is " +
                    std::to_string(limits.max_nodes),
                "size");
  HYPERMAP_TRY(budget.draw_octree_nodes(header.num_nodes));
  HYPERMAP_ASSIGN_OR_RETURN(OctomapNodes nodes,
                            read_nodes(header, kind, bytes.substr(header.num_bytes), budget));
  nodes.tree.kind = header.binary ? OctomapKind::kOccupancy : kind;
  nodes.tree.resolution_m = header.resolution_m;
  if (nodes.num_stale_inner_nodes > 0)
    header.findings.push_back(stale(nodes.num_stale_inner_nodes));
  return Loaded<OctomapTree>{.value = std::move(nodes.tree),
                             .findings = std::move(header.findings)};
}

std::string with_header(const OctomapTree& tree, OctomapNodeBytes nodes, bool binary) {
  return write_octomap_file({.binary = binary,
                             .id = std::string(id_of(tree.kind)),
                             .num_nodes = nodes.num_nodes,
                             .resolution_m = tree.resolution_m,
                             .findings = {}},
                            std::move(nodes.bytes));
}

Unexpected thrown(const std::exception& exception, ErrorCode otherwise) {
  Unexpected error = caught(exception, otherwise, "the tree");
  error.value().field = "octree";
  return error;
}

}  // namespace

Result<Loaded<OctomapTree>> parse_octomap(std::string_view bytes,
                                          const SourceName& source,
                                          const OctomapLimits& limits,
                                          const LoadBudget& budget) try {
  auto loaded = parse(bytes, source, limits, budget);
  if (!loaded) return tl::make_unexpected(with_source(std::move(loaded).error(), source));
  for (Finding& finding : loaded->findings)
    finding.error = with_source(std::move(finding.error), source);
  return loaded;
} catch (const std::exception& exception) {
  return thrown(exception, ErrorCode::kMalformedFile);
}

Result<Loaded<OctomapTree>> read_octomap(const std::filesystem::path& path,
                                         const OctomapLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, limits.max_file_bytes));
  return parse_octomap(bytes, {.file = path.string()}, limits);
}

Result<std::string> write_octomap(const OctomapTree& tree) try {
  HYPERMAP_TRY(validate(tree));
  return with_header(tree, write_full_nodes(tree), false);
} catch (const std::exception& exception) {
  return thrown(exception, ErrorCode::kInvalidArgument);
}

Result<std::string> write_octomap_binary(const OctomapTree& tree) try {
  HYPERMAP_TRY(validate(tree));
  const OctomapTree plain = occupied_or_free(tree);
  if (!plain.leaves.empty() && plain.leaves.front().depth == 0)
    return fail(ErrorCode::kInvalidArgument, "a tree of one leaf has no .bt form", "octree");
  return with_header(plain, write_binary_nodes(plain), true);
} catch (const std::exception& exception) {
  return thrown(exception, ErrorCode::kInvalidArgument);
}

}  // namespace hypermap
