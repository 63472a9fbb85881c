// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_views.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/number_bytes.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kViewsSignature = "HMVIEWS1";
constexpr std::size_t kViewHeadBytes = 24;
constexpr std::uint64_t kMaxViewFrameIndex = std::numeric_limits<std::int64_t>::max();

void append_uint64(std::string& bytes, std::uint64_t value) {
  append_uint32(bytes, static_cast<std::uint32_t>(value & 0xffffffffU));
  append_uint32(bytes, static_cast<std::uint32_t>(value >> 32U));
}

std::uint64_t uint64_at(std::string_view bytes, std::size_t at) {
  return std::uint64_t{uint32_at(bytes, at)} | std::uint64_t{uint32_at(bytes, at + 4)} << 32U;
}

Result<void> check_jpeg(const std::string& jpeg) {
  if (jpeg.size() > kMaxViewBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "must have at most " + std::to_string(kMaxViewBytes) + " bytes, has " +
                    std::to_string(jpeg.size()),
                "jpeg");
  }
  const auto header = read_image_header(jpeg, {});
  if (!header || header->format != ImageFormat::kJpeg) {
    return fail(ErrorCode::kInvalidArgument, "must be a JPEG", "jpeg");
  }
  if (header->width_px <= kMaxViewSidePx && header->height_px <= kMaxViewSidePx) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must have sides of at most " + std::to_string(kMaxViewSidePx) + ", is " +
                  std::to_string(header->width_px) + " x " + std::to_string(header->height_px),
              "jpeg");
}

Unexpected view_error(std::size_t at, std::string what, const SourceName& source) {
  Error error{.code = ErrorCode::kMalformedFile,
              .what = std::move(what),
              .field = "byte " + std::to_string(at)};
  return tl::make_unexpected(with_source(std::move(error), source));
}

}  // namespace

Result<void> validate(const ObjectView& view) {
  if (!(std::isfinite(view.quality) && view.quality > 0.0)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be finite and > 0, is " + number_text(view.quality),
                "quality");
  }
  if (view.frame_index > kMaxViewFrameIndex) {
    return fail(ErrorCode::kInvalidArgument,
                "must be below 2^63, is " + std::to_string(view.frame_index),
                "frame_index");
  }
  return check_jpeg(view.jpeg);
}

Result<std::string> write_object_views(const ObjectViews& views) {
  std::string bytes(kViewsSignature);
  append_uint32(bytes, static_cast<std::uint32_t>(views.size()));
  for (const auto& [id, view] : views) {
    if (auto valid = validate(view); !valid) {
      valid.error().entry = "object " + std::to_string(id.value);
      return tl::make_unexpected(std::move(valid).error());
    }
    append_uint32(bytes, id.value);
    append_uint32(bytes, static_cast<std::uint32_t>(view.jpeg.size()));
    append_uint64(bytes, view.frame_index);
    append_uint64(bytes, std::bit_cast<std::uint64_t>(view.quality));
    bytes += view.jpeg;
  }
  return bytes;
}

Result<ObjectViews> parse_object_views(std::string_view bytes, const SourceName& source) {
  if (!bytes.starts_with(kViewsSignature)) {
    return view_error(0, "is no file of views", source);
  }
  std::size_t at = kViewsSignature.size();
  if (bytes.size() < at + 4) return view_error(at, "is cut", source);
  const std::uint32_t num_views = uint32_at(bytes, at);
  at += 4;
  ObjectViews views;
  for (std::uint32_t i = 0; i < num_views; ++i) {
    if (bytes.size() - at < kViewHeadBytes) return view_error(at, "is cut", source);
    const ObjectId id{uint32_at(bytes, at)};
    const std::size_t jpeg_bytes = uint32_at(bytes, at + 4);
    const ObjectId newest = views.empty() ? kNoObject : views.rbegin()->first;
    if (!(newest < id)) return view_error(at, "ids of objects must ascend from 1 on", source);
    if (jpeg_bytes > bytes.size() - at - kViewHeadBytes) return view_error(at, "is cut", source);
    ObjectView view{.quality = std::bit_cast<double>(uint64_at(bytes, at + 16)),
                    .frame_index = uint64_at(bytes, at + 8),
                    .jpeg = std::string(bytes.substr(at + kViewHeadBytes, jpeg_bytes))};
    if (const auto valid = validate(view); !valid) {
      return view_error(at,
                        "of object " + std::to_string(id.value) + ": " + valid.error().field + " " +
                            valid.error().what,
                        source);
    }
    views.emplace_hint(views.end(), id, std::move(view));
    at += kViewHeadBytes + jpeg_bytes;
  }
  if (at == bytes.size()) return views;
  return view_error(
      at, "must end here, has " + std::to_string(bytes.size() - at) + " bytes more", source);
}

}  // namespace hypermap
