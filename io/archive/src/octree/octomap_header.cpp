// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_header.hpp"

#include "hypermap/io/codec/checksum.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <array>
#include <charconv>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kFirstLine = "# Octomap OcTree file";
constexpr std::string_view kFirstLineBinary = "# Octomap OcTree binary file";
constexpr std::string_view kChecksumWord = "crc32";
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 17;
constexpr std::size_t kMaxIdBytes = 256;
constexpr double kMinResolution = 1e-6;
constexpr double kMaxResolution = 1e3;

Result<std::uint64_t> parse_size(std::string_view text) {
  std::uint64_t size = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  if (error != std::errc() || end != text.data() + text.size())
    return fail(ErrorCode::kMalformedFile,
                "is '" + printable(text) + "', expected a number of nodes",
                "size");
  return size;
}

Result<double> parse_resolution(std::string_view text) {
  double resolution = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), resolution);
  if (error != std::errc() || end != text.data() + text.size() ||
      !(resolution >= kMinResolution && resolution <= kMaxResolution))
    return fail(ErrorCode::kMalformedFile,
                "is '" + printable(text) + "', expected metres between 1e-6 and 1000",
                "res");
  return resolution;
}

std::string checksum_line(std::uint32_t crc) {
  return "# " + std::string(kChecksumWord) + " " + checksum_text(crc) + "\n";
}

/// Reads the header line by line.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view bytes) : bytes_(bytes) {}

  Result<OctomapHeader> parse() {
    HYPERMAP_TRY(take_first_line());
    bool at_data = false;
    while (!at_data) {
      HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, take_line());
      const std::string_view text = trimmed(line);
      at_data = text == "data";
      if (at_data || text.empty() || text.front() == '#') continue;
      HYPERMAP_TRY(take_key(text));
    }
    for (const std::string_view key : {"id", "size", "res"})
      if (!seen_.contains(key))
        return fail(ErrorCode::kMalformedFile, "is missing in the header", std::string(key));
    header_.num_bytes = at_;
    return std::move(header_);
  }

 private:
  Result<void> take_first_line() {
    header_.binary = bytes_.starts_with(kFirstLineBinary);
    if (!header_.binary && !bytes_.starts_with(kFirstLine))
      return fail(ErrorCode::kMalformedFile,
                  "not an OctoMap file: expected '" + std::string(kFirstLine) + "' or '" +
                      std::string(kFirstLineBinary) + "' in the first line");
    HYPERMAP_TRY(take_line());
    return {};
  }

  Result<std::string_view> take_line() {
    const std::size_t end = bytes_.substr(0, kMaxHeaderBytes).find('\n', at_);
    if (end == std::string_view::npos && bytes_.size() > kMaxHeaderBytes)
      return fail(ErrorCode::kLimit,
                  "no line 'data' in the first " + std::to_string(kMaxHeaderBytes) + " bytes",
                  "header");
    if (end == std::string_view::npos)
      return fail(ErrorCode::kMalformedFile, "ends before the line 'data'", "header");
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    HYPERMAP_TRY(note_checksum(line));
    if (line.find('\r') != std::string_view::npos)
      return fail(ErrorCode::kMalformedFile,
                  "has CRLF line ends: the file was damaged by a transfer as text",
                  "header");
    return line;
  }

  /// Any line with the word, so that one whose ends were damaged does not pass for a comment.
  /// `line` is the one that was taken last.
  Result<void> note_checksum(std::string_view line) {
    if (line.find(kChecksumWord) == std::string_view::npos) return {};
    if (!header_.checksum_line.empty())
      return fail(ErrorCode::kMalformedFile, "is given twice", "crc32");
    header_.checksum_line = bytes_.substr(at_ - line.size() - 1, line.size() + 1);
    return {};
  }

  Result<void> take_key(std::string_view text) {
    const std::string_view key = text.substr(0, text.find_first_of(" \t"));
    const std::string_view value = trimmed(text.substr(key.size()));
    if (key != "id" && key != "size" && key != "res") {
      header_.findings.push_back(
          {.error = {.code = ErrorCode::kMalformedFile,
                     .what = "unknown key '" + printable(key, 40) + "' is ignored",
                     .field = "header"}});
      return {};
    }
    if (!seen_.insert(std::string(key)).second)
      return fail(ErrorCode::kMalformedFile, "is given twice", std::string(key));
    if (key == "size") {
      HYPERMAP_ASSIGN_OR_RETURN(header_.num_nodes, parse_size(value));
    } else if (key == "res") {
      HYPERMAP_ASSIGN_OR_RETURN(header_.resolution_m, parse_resolution(value));
    } else if (value.empty() || value.size() > kMaxIdBytes) {
      return fail(ErrorCode::kMalformedFile,
                  "has " + std::to_string(value.size()) + " bytes, expected 1 to 256",
                  "id");
    } else {
      header_.id = value;
    }
    return {};
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  OctomapHeader header_;
  std::set<std::string, std::less<>> seen_;
};

}  // namespace

Result<OctomapHeader> parse_octomap_header(std::string_view bytes) {
  return HeaderParser(bytes).parse();
}

Result<void> check_octomap_checksum(std::string_view bytes, const OctomapHeader& header) {
  const std::string_view said = header.checksum_line;
  if (said.empty()) return {};
  const auto at = static_cast<std::size_t>(said.data() - bytes.data());
  const std::uint32_t crc = crc32_of(bytes.substr(at + said.size()), crc32_of(bytes.substr(0, at)));
  if (said == checksum_line(crc)) return {};
  return fail(ErrorCode::kMalformedFile,
              "is '" + printable(said.substr(0, said.size() - 1), 40) + "', that of the file is " +
                  checksum_text(crc) +
                  ": the file was damaged, or changed without taking the line out",
              "crc32");
}

std::string write_octomap_file(const OctomapHeader& header, std::string nodes) {
  std::array<char, 32> resolution{};
  const auto [end, error] =
      std::to_chars(resolution.data(), resolution.data() + resolution.size(), header.resolution_m);
  std::string text(header.binary ? kFirstLineBinary : kFirstLine);
  text += "\n";
  std::string keys = "id " + header.id + "\nsize " + std::to_string(header.num_nodes) + "\nres ";
  keys.append(resolution.data(), end).append("\ndata\n");
  text += checksum_line(crc32_of(nodes, crc32_of(keys, crc32_of(text))));
  return std::move(nodes.insert(0, text + keys));
}

}  // namespace hypermap
