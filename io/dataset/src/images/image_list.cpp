// SPDX-License-Identifier: BSD-3-Clause
#include "image_list.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 1'000'000;
constexpr std::size_t kMaxListBytes = std::size_t{256} << 20U;

/// A pattern taken apart at its star.
struct Pattern {
  std::string folder;
  std::string prefix;
  std::string suffix;
};

Result<Pattern> take_apart(const std::string& pattern) {
  const std::string last = fs::path(pattern).filename().string();
  const std::size_t star = last.find('*');
  if (star == std::string::npos || std::count(pattern.begin(), pattern.end(), '*') != 1) {
    return fail(ErrorCode::kInvalidArgument,
                "must have one * in its last part, is " + printable(pattern),
                "pattern");
  }
  return Pattern{
      fs::path(pattern).parent_path().string(), last.substr(0, star), last.substr(star + 1)};
}

/// What the star stands for; none when `name` does not fit.
std::optional<std::string_view> match(std::string_view name, const Pattern& pattern) {
  const std::size_t fixed = pattern.prefix.size() + pattern.suffix.size();
  if (name.size() <= fixed || !name.starts_with(pattern.prefix) ||
      !name.ends_with(pattern.suffix)) {
    return std::nullopt;
  }
  return name.substr(pattern.prefix.size(), name.size() - fixed);
}

ListedFile listed(const Pattern& pattern, const std::string& name, std::string_view star) {
  ListedFile file;
  file.path = pattern.folder.empty() ? name : pattern.folder + "/" + name;
  file.number = parse_unsigned(star);
  if (!file.number) {
    if (const auto stamp = parse_stamp(star)) file.stamp = stamp->stamp;
  }
  return file;
}

bool in_order(const ListedFile& a, const ListedFile& b) {
  if (a.number && b.number && *a.number != *b.number) return *a.number < *b.number;
  if (a.stamp && b.stamp && *a.stamp != *b.stamp) return *a.stamp < *b.stamp;
  return a.path < b.path;
}

bool leaves_folder(const fs::path& path) {
  return path.is_absolute() ||
         std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

Result<ListedFile> parse_list_line(std::string_view line) {
  const auto words = split_words(line);
  if (words.size() > 2) {
    return fail(ErrorCode::kMalformedFile,
                "must be a stamp and a path, has " + std::to_string(words.size()) + " words",
                "line");
  }
  ListedFile file;
  file.path = words.back();
  if (words.size() == 2) {
    HYPERMAP_ASSIGN_OR_RETURN(const ParsedStamp stamp, parse_stamp(words[0]));
    file.stamp = stamp.stamp;
  } else {
    file.number = number_in_name(file.path);
  }
  if (leaves_folder(file.path)) {
    return fail(ErrorCode::kMalformedFile,
                "must stay in the dataset's folder, is " + printable(file.path),
                "path");
  }
  return file;
}

Result<void> check_list(const std::vector<ListedFile>& files) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].stamp.has_value() != files[0].stamp.has_value()) {
      return fail(ErrorCode::kMalformedFile, "must have a stamp in every line or in none", "line");
    }
    if (files[i].stamp && files[i].stamp == files[i - 1].stamp) {
      return fail(ErrorCode::kMalformedFile,
                  "must occur once, is " + stamp_text(*files[i].stamp),
                  "timestamp");
    }
  }
  return {};
}

}  // namespace

bool is_pattern(std::string_view text) {
  return text.find('*') != std::string_view::npos;
}

bool fits_pattern(const std::string& path, const std::string& pattern) {
  const auto parts = take_apart(pattern);
  if (!parts || fs::path(path).parent_path().string() != parts->folder) return false;
  return match(fs::path(path).filename().string(), *parts).has_value();
}

Result<std::vector<ListedFile>> list_image_files(const fs::path& folder,
                                                 const std::string& pattern) {
  HYPERMAP_ASSIGN_OR_RETURN(const Pattern parts, take_apart(pattern));
  std::vector<ListedFile> files;
  std::error_code ec;
  const fs::path place = folder / parts.folder;
  const fs::file_type type = fs::status(place, ec).type();
  if (type != fs::file_type::directory && type != fs::file_type::none) return files;
  // What cannot be looked at is not absent: the iterator says why.
  for (fs::directory_iterator it(place, ec); !ec && it != fs::directory_iterator();
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    const auto star = match(name, parts);
    if (star) files.push_back(listed(parts, name, *star));
    if (files.size() > kMaxFiles) {
      return Unexpected(Error{.code = ErrorCode::kLimit,
                              .what = "at most 1000000 images are listed",
                              .file = place.string()});
    }
  }
  if (ec) {
    return Unexpected(Error{.code = ErrorCode::kIo, .what = ec.message(), .file = place.string()});
  }
  std::sort(files.begin(), files.end(), in_order);
  const auto twice =
      std::adjacent_find(files.begin(), files.end(), [](const auto& a, const auto& b) {
        return a.number && a.number == b.number;
      });
  if (twice != files.end()) {
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "must have one file for number " +
                                    std::to_string(*twice->number) + ", has " + twice->path +
                                    " and another",
                            .file = place.string()});
  }
  return files;
}

Result<std::vector<ListedFile>> read_image_list(const fs::path& folder, const std::string& list) {
  const fs::path path = folder / list;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxListBytes));
  std::vector<ListedFile> files;
  for (const TextLine& line : split_lines(text)) {
    const std::string_view content = trimmed(line.text);
    if (content.empty() || content.front() == '#') continue;
    auto file = parse_list_line(content);
    if (!file) {
      Error error = std::move(file).error();
      error.file = path.string();
      error.line = line.number;
      return Unexpected(std::move(error));
    }
    files.push_back(std::move(*file));
    if (files.size() > kMaxFiles) {
      return Unexpected(Error{.code = ErrorCode::kLimit,
                              .what = "at most 1000000 images are listed",
                              .file = path.string()});
    }
  }
  std::stable_sort(files.begin(), files.end(), [](const ListedFile& a, const ListedFile& b) {
    return a.stamp && b.stamp && *a.stamp < *b.stamp;
  });
  if (auto ok = check_list(files); !ok) {
    Error error = std::move(ok).error();
    error.file = path.string();
    return Unexpected(std::move(error));
  }
  return files;
}

Result<std::vector<ListedFile>> list_files(const fs::path& folder, const std::string& place) {
  if (place.empty()) return std::vector<ListedFile>{};
  return is_pattern(place) ? list_image_files(folder, place) : read_image_list(folder, place);
}

std::optional<std::uint64_t> number_in_name(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t first = name.find_first_of(kDigits);
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of(kDigits, first), name.size());
  return parse_unsigned(name.substr(first, end - first));
}

}  // namespace hypermap
