// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/file_kind.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 21> kFileKindNames{
    "archive",    "octree",     "map",    "image",   "depth",      "semantic", "trajectory",
    "intrinsics", "detections", "config", "dataset", "truth",      "tile",     "embedding",
    "cloud",      "sequences",  "update", "zones",   "vocabulary", "places",   "tile-set"};

struct Hint {
  std::string_view text;
  FileKind kind;
};

constexpr std::array<Hint, 20> kExtensions{
    {{".hmap", FileKind::kArchive},    {".tile", FileKind::kTile},
     {".ot", FileKind::kOctree},       {".bt", FileKind::kOctree},
     {".png", FileKind::kImage},       {".jpg", FileKind::kImage},
     {".jpeg", FileKind::kImage},      {".bmp", FileKind::kImage},
     {".pgm", FileKind::kImage},       {".txt", FileKind::kTrajectory},
     {".log", FileKind::kTrajectory},  {".tum", FileKind::kTrajectory},
     {".json", FileKind::kDetections}, {".jsonl", FileKind::kDetections},
     {".yaml", FileKind::kConfig},     {".yml", FileKind::kConfig},
     {".npy", FileKind::kEmbedding},   {".pcd", FileKind::kCloud},
     {".ply", FileKind::kCloud},       {".zip", FileKind::kArchive}}};

/// First hint whose text the content holds.
constexpr std::array<Hint, 9> kJsonHints{{{"\"detections\"", FileKind::kDetections},
                                          {"\"bbox\"", FileKind::kDetections},
                                          {"\"annotations\"", FileKind::kDetections},
                                          {"\"image_id\"", FileKind::kDetections},
                                          {"\"fx\"", FileKind::kIntrinsics},
                                          {"\"intrinsic_matrix\"", FileKind::kIntrinsics},
                                          {"\"depth_scale\"", FileKind::kIntrinsics},
                                          {"\"vector\"", FileKind::kEmbedding},
                                          {"\"tile_m\"", FileKind::kTileSet}}};

/// First hint with which a line begins.
constexpr std::array<Hint, 28> kYamlHints{{{"format: hypermap-sequence-truth", FileKind::kTruth},
                                           {"layers:", FileKind::kConfig},
                                           {"extensions:", FileKind::kConfig},
                                           {"image:", FileKind::kMap},
                                           {"resolution:", FileKind::kMap},
                                           {"occupied_thresh:", FileKind::kMap},
                                           {"camera_matrix:", FileKind::kIntrinsics},
                                           {"image_width:", FileKind::kIntrinsics},
                                           {"K:", FileKind::kIntrinsics},
                                           {"trajectory:", FileKind::kDataset},
                                           {"depth:", FileKind::kDataset},
                                           {"- name:", FileKind::kSemantic},
                                           {"- shape:", FileKind::kSemantic},
                                           {"- {name:", FileKind::kSemantic},
                                           {"- {shape:", FileKind::kSemantic},
                                           {"- tags:", FileKind::kSemantic},
                                           {"sequences:", FileKind::kSequences},
                                           {"add:", FileKind::kUpdate},
                                           {"modify:", FileKind::kUpdate},
                                           {"delete:", FileKind::kUpdate},
                                           {"zones:", FileKind::kZones},
                                           {"robot_height_m:", FileKind::kZones},
                                           {"aliases:", FileKind::kVocabulary},
                                           {"super_classes:", FileKind::kVocabulary},
                                           {"belongings:", FileKind::kPlaces},
                                           {"tempering:", FileKind::kPlaces},
                                           {"min_probability:", FileKind::kPlaces},
                                           {"metre_costs:", FileKind::kPlaces}}};

/// Tiles of [sogm]'s public implementation have no header: their names tell what they are.
bool is_headerless_tile(const fs::path& path) {
  return path.extension() == ".bin" && path.stem().string().find("_Format_") != std::string::npos;
}

std::optional<FileKind> by_extension(const fs::path& path) {
  if (is_headerless_tile(path)) return FileKind::kTile;
  const std::string extension = path.extension().string();
  const auto found = std::find_if(kExtensions.begin(), kExtensions.end(), [&](const Hint& hint) {
    return hint.text == extension;
  });
  return found == kExtensions.end() ? std::nullopt : std::optional(found->kind);
}

/// Whether a tile of any form lies in the folder.
bool has_tiles(const fs::path& folder) {
  std::error_code unreadable;  // told by whoever reads it
  fs::directory_iterator entry(folder, unreadable);
  for (; !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable)) {
    if (by_extension(entry->path()) == FileKind::kTile) return true;
  }
  return false;
}

Result<std::string> first_bytes(const fs::path& path) {
  constexpr std::size_t kEnough = std::size_t{1} << 16U;
  const auto refused = [&](std::string what) {
    return Unexpected(
        Error{.code = ErrorCode::kIo, .what = std::move(what), .file = path.string()});
  };
  std::error_code ec;
  const auto status = fs::status(path, ec);
  if (!fs::exists(status)) return refused("does not exist");
  if (!fs::is_regular_file(status)) return refused("must be a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return refused(std::strerror(errno));
  std::string bytes(kEnough, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.bad()) return refused(std::strerror(errno));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_image(std::string_view bytes) {
  constexpr std::array<std::string_view, 9> kMagic{
      "\x89PNG", "\xFF\xD8\xFF", "BM", "P1", "P2", "P3", "P4", "P5", "P6"};
  return std::any_of(kMagic.begin(), kMagic.end(), [&](std::string_view magic) {
    return bytes.starts_with(magic);
  });
}

FileKind image_kind(std::string_view bytes) {
  const auto header = read_image_header(bytes, {});
  const bool is_depth = header && header->bits == 16 && header->channels == 1;
  return is_depth ? FileKind::kDepth : FileKind::kImage;
}

/// JSON by the keys that occur; a bare list can only be detections.
FileKind json_kind(std::string_view text) {
  for (const Hint& hint : kJsonHints) {
    if (text.find(hint.text) != std::string_view::npos) return hint.kind;
  }
  return FileKind::kDetections;
}

/// Lines of numbers by how many stand in the first of them: 8 a trajectory, 3 a matrix of
/// intrinsics or the header of a pose record, 4 a pose matrix or ScanNet's intrinsics.
std::optional<FileKind> number_kind(const std::vector<TextLine>& lines) {
  std::vector<std::vector<std::string_view>> rows;
  for (const TextLine& line : lines) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.front() == '#') continue;
    rows.push_back(split_words(text));
    if (rows.size() > 5) break;
  }
  if (rows.empty()) return std::nullopt;
  const auto is_number = [](std::string_view word) { return parse_double(word).has_value(); };
  const auto numbers = std::count_if(rows[0].begin(), rows[0].end(), is_number);
  if (numbers == 0 || static_cast<std::size_t>(numbers) + 1 < rows[0].size()) return std::nullopt;
  const std::size_t columns = rows[0].size();
  if (columns == 3) return rows.size() <= 3 ? FileKind::kIntrinsics : FileKind::kTrajectory;
  // Focal length and centre stand where a rotation and zeros would.
  const auto first = parse_double(rows[0][0]);
  if (columns == 4 && rows.size() == 4 && first && *first > 2.0) return FileKind::kIntrinsics;
  if (columns == 4 || columns >= 7) return FileKind::kTrajectory;
  return columns == 5 || columns == 6 ? std::optional(FileKind::kDetections) : std::nullopt;
}

std::optional<FileKind> yaml_kind(const std::vector<TextLine>& lines) {
  for (const TextLine& line : lines) {
    for (const Hint& hint : kYamlHints) {
      if (line.text.starts_with(hint.text)) return hint.kind;
    }
  }
  return std::nullopt;
}

std::optional<FileKind> by_content(std::string_view bytes) {
  if (bytes.starts_with("PK")) return FileKind::kArchive;
  if (bytes.starts_with("# Octomap")) return FileKind::kOctree;
  if (bytes.starts_with("\x93NUMPY")) return FileKind::kEmbedding;
  if (bytes.starts_with("# .PCD") || bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))
    return FileKind::kCloud;
  if (is_image(bytes)) return image_kind(bytes);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  const std::string_view text = bytes.substr(first);
  if (text.front() == '{' || text.front() == '[' || text.starts_with("/*")) return json_kind(text);
  const std::vector<TextLine> lines = split_lines(text);
  if (const auto kind = number_kind(lines)) return kind;
  return yaml_kind(lines);
}

}  // namespace

std::span<const std::string_view> file_kind_names() {
  return kFileKindNames;
}

std::string_view name_of(FileKind kind) {
  return kFileKindNames[static_cast<std::size_t>(kind)];
}

Result<FileKind> file_kind(std::string_view name) {
  const auto found = std::find(kFileKindNames.begin(), kFileKindNames.end(), name);
  if (found != kFileKindNames.end()) return static_cast<FileKind>(found - kFileKindNames.begin());
  return fail(ErrorCode::kInvalidArgument, not_one_of(name, kFileKindNames), "kind");
}

Result<FileKind> find_file_kind(const fs::path& path) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) return has_tiles(path) ? FileKind::kTile : FileKind::kDataset;
  const auto named = by_extension(path);
  const bool is_said = named == FileKind::kArchive || named == FileKind::kOctree;
  if (is_said || named == FileKind::kTile) return *named;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, first_bytes(path));
  if (const auto kind = by_content(bytes)) return *kind;
  if (named) return *named;
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is of no kind that is read here",
                          .file = path.string()});
}

}  // namespace hypermap
