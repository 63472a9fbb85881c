// SPDX-License-Identifier: BSD-3-Clause
#include "deflate.hpp"

#include "hypermap/core/base/caught.hpp"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <optional>

namespace hypermap {
namespace {

constexpr int kRawWindowBits = -15;  // negative: no zlib header, as in zip files
constexpr std::size_t kStep = std::size_t{1} << 18;
constexpr std::uint64_t kMaxRatio = 1032;  // a deflated bit stands for 129 bytes at most

// zlib counts in 32 bits; longer input is handed over in parts.
uInt part_of(std::size_t num_bytes) {
  return static_cast<uInt>(std::min<std::size_t>(num_bytes, std::numeric_limits<uInt>::max() / 2));
}

// zlib only reads through next_in, its type says otherwise unless ZLIB_CONST is set everywhere.
Bytef* input_of(std::string_view bytes) {
  return const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
}

/// A z_stream that is ended whatever happens.
template <int (*End)(z_streamp)>
struct DeflateStream {
  z_stream z{};
  bool open = false;
  DeflateStream() = default;
  ~DeflateStream() {
    if (open) End(&z);
  }
  DeflateStream(const DeflateStream&) = delete;
  DeflateStream& operator=(const DeflateStream&) = delete;
  DeflateStream(DeflateStream&&) = delete;
  DeflateStream& operator=(DeflateStream&&) = delete;
};

/// Lets the stream write behind `out`, at most `max_step` bytes.
void offer_room(z_stream& z, std::string& out, std::size_t max_step) {
  const std::size_t used = out.size();
  out.resize(used + max_step);
  z.next_out = reinterpret_cast<Bytef*>(out.data() + used);
  z.avail_out = static_cast<uInt>(max_step);
}

void offer_input(z_stream& z, std::string_view& rest) {
  if (z.avail_in != 0 || rest.empty()) return;
  z.next_in = input_of(rest);
  z.avail_in = part_of(rest.size());
  rest.remove_prefix(z.avail_in);
}

Unexpected no_memory() {
  return fail(ErrorCode::kOutOfMemory, "no memory to (de)compress");
}

Result<std::string> pack_well(std::string_view content) {
  constexpr int kLevel = 6;  // the library's own default
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) return no_memory();
  const std::size_t bound = libdeflate_deflate_compress_bound(compressor.get(), content.size());
  const auto packed = std::make_unique_for_overwrite<char[]>(bound);
  return std::string(packed.get(),
                     libdeflate_deflate_compress(
                         compressor.get(), content.data(), content.size(), packed.get(), bound));
}

Result<std::string> pack_by_frequency(std::string_view content) {
  DeflateStream<deflateEnd> stream;
  if (deflateInit2(
          &stream.z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRawWindowBits, 8, Z_HUFFMAN_ONLY) != Z_OK)
    return no_memory();
  stream.open = true;
  std::string packed;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    offer_input(stream.z, content);
    offer_room(stream.z, packed, kStep);
    state = deflate(&stream.z, content.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.resize(packed.size() - stream.z.avail_out);
  }
  return packed;
}

/// The content of an undamaged stream of this size, at three times zlib's speed; nothing of any
/// other, which zlib then tells the fault of, and of one so large that it should be stopped on the
/// way.
std::optional<std::string> unpack_at_once(std::string_view packed, std::uint64_t num_bytes) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 29U;  // a fifth of a second
  if (num_bytes > kMostBytes || num_bytes > kMaxRatio * std::uint64_t{packed.size()})
    return std::nullopt;
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) return std::nullopt;
  std::string content(static_cast<std::size_t>(num_bytes), '\0');
  std::size_t num_used = 0;
  const libdeflate_result result = libdeflate_deflate_decompress_ex(decompressor.get(),
                                                                    packed.data(),
                                                                    packed.size(),
                                                                    content.data(),
                                                                    content.size(),
                                                                    &num_used,
                                                                    nullptr);
  if (result != LIBDEFLATE_SUCCESS || num_used != packed.size()) return std::nullopt;
  return content;
}

Result<std::string> try_unpack(std::string_view packed,
                               std::uint64_t num_bytes,
                               const LoadBudget& budget) {
  const auto wrong_size = [&](const char* relation) {
    return fail(ErrorCode::kMalformedFile,
                std::string("inflates to ") + relation + " than its declared size of " +
                    std::to_string(num_bytes) + " bytes");
  };
  HYPERMAP_TRY(budget.check_stop());
  if (auto content = unpack_at_once(packed, num_bytes)) return *std::move(content);
  DeflateStream<inflateEnd> stream;
  if (inflateInit2(&stream.z, kRawWindowBits) != Z_OK) return no_memory();
  stream.open = true;
  std::string content;
  content.reserve(static_cast<std::size_t>(
      std::min<std::uint64_t>(num_bytes + 1, kMaxRatio * std::uint64_t{packed.size()})));
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    HYPERMAP_TRY(budget.check_stop());
    offer_input(stream.z, packed);
    // One byte more than declared, so that a stream that is longer shows itself.
    const auto room =
        static_cast<std::size_t>(std::min<std::uint64_t>(kStep, num_bytes + 1 - content.size()));
    offer_room(stream.z, content, room);
    const std::size_t before = stream.z.total_in;
    state = inflate(&stream.z, Z_NO_FLUSH);
    const std::size_t got = room - stream.z.avail_out;
    content.resize(content.size() - stream.z.avail_out);
    if (state == Z_MEM_ERROR) return no_memory();
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      return fail(ErrorCode::kMalformedFile, "damaged deflate stream");
    if (content.size() > num_bytes) return wrong_size("more");
    if (state != Z_STREAM_END && got == 0 && stream.z.total_in == before && packed.empty())
      return fail(ErrorCode::kMalformedFile, "deflate stream without an end");
  }
  if (content.size() < num_bytes) return wrong_size("less");
  if (stream.z.avail_in != 0 || !packed.empty())
    return fail(ErrorCode::kMalformedFile, "bytes after the end of the deflate stream");
  return content;
}

}  // namespace

Result<std::string> pack(std::string_view content, Packing packing) {
  try {
    return packing == Packing::kBest ? pack_well(content) : pack_by_frequency(content);
  } catch (const std::exception& exception) {
    return caught(exception, ErrorCode::kInvalidArgument, "deflated bytes");
  }
}

Result<std::string> unpack(std::string_view packed,
                           std::uint64_t num_bytes,
                           const LoadBudget& budget) {
  try {
    return try_unpack(packed, num_bytes, budget);
  } catch (const std::exception& exception) {
    return caught(exception, ErrorCode::kMalformedFile, "inflated bytes");
  }
}

Result<std::string> unpack_start(std::string_view packed, std::size_t max_bytes) {
  DeflateStream<inflateEnd> stream;
  if (inflateInit2(&stream.z, kRawWindowBits) != Z_OK) return no_memory();
  stream.open = true;
  std::string content;
  offer_input(stream.z, packed);
  offer_room(stream.z, content, max_bytes);
  const int state = inflate(&stream.z, Z_SYNC_FLUSH);
  if (state == Z_MEM_ERROR) return no_memory();
  if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
    return fail(ErrorCode::kMalformedFile, "damaged deflate stream");
  content.resize(content.size() - stream.z.avail_out);
  return content;
}

}  // namespace hypermap
