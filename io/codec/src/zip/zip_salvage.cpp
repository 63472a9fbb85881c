// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_salvage.hpp"

#include "hypermap/io/codec/archive_size.hpp"
#include "zip_content.hpp"
#include "zip_directory.hpp"
#include "zip_extra_fields.hpp"
#include "zip_format.hpp"
#include "zip_names.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

using zip::get16;
using zip::get32;

constexpr std::size_t kSignatureBytes = 4;
constexpr std::uint64_t kBytesAtOnce = std::uint64_t{1} << 20U;

/// A member as its local header describes it, and where what follows it begins.
struct LocalMember {
  ZipMember member;
  std::uint64_t end = 0;
};

Unexpected damaged(std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what));
}

/// Whether the loss of one member says something of all.
bool ends_all(const Error& error) {
  return error.code == ErrorCode::kIo || error.code == ErrorCode::kOutOfMemory ||
         error.code == ErrorCode::kInterrupted;
}

class ZipSalvager {
 public:
  ZipSalvager(const ByteSource& source, const ZipLimits& limits, const LoadBudget& budget)
      : source_(source), limits_(limits), budget_(budget) {}

  Result<ZipSalvage> run() {
    std::uint64_t at = 0;
    std::size_t num_headers = 0;
    while (true) {
      HYPERMAP_ASSIGN_OR_RETURN(const auto found, find({zip::kLocalSignature}, at));
      if (!found) break;
      if (++num_headers > limits_.max_entries) {
        return fail(ErrorCode::kLimit,
                    "more than " + std::to_string(limits_.max_entries) + " local headers");
      }
      HYPERMAP_TRY(budget_.check_stop());
      HYPERMAP_ASSIGN_OR_RETURN(at, take_member(*found));
    }
    if (num_headers == 0) return damaged("has no member: no local header of a zip file is in it");
    return std::move(salvage_);
  }

 private:
  using Signatures = std::initializer_list<std::uint32_t>;

  /// The first of the signatures from an offset on.
  [[nodiscard]] Result<std::optional<std::uint64_t>> find(Signatures signatures,
                                                          std::uint64_t from) const {
    for (std::uint64_t at = from; at + kSignatureBytes <= source_.size();) {
      const auto num_bytes = std::min(kBytesAtOnce, source_.size() - at);
      HYPERMAP_ASSIGN_OR_RETURN(const std::string window,
                                source_.read_at(at, static_cast<std::size_t>(num_bytes)));
      for (std::size_t i = window.find("PK"); i != std::string::npos && i + 4 <= window.size();
           i = window.find("PK", i + 1)) {
        if (std::ranges::find(signatures, get32(window, i)) != signatures.end()) return at + i;
      }
      at += num_bytes == kBytesAtOnce ? num_bytes - (kSignatureBytes - 1) : num_bytes;
    }
    return std::nullopt;
  }

  /// Takes the member whose header lies at an offset, or notes why not. Where the search goes on.
  /// Errors: what ends all.
  Result<std::uint64_t> take_member(std::uint64_t header_offset) {
    const std::uint64_t behind_signature = header_offset + kSignatureBytes;
    HYPERMAP_ASSIGN_OR_RETURN(const auto header, read_header(header_offset));
    if (!header) return behind_signature;  // the file ends in it
    const std::string name = header->substr(zip::kLocalBytes, get16(*header, 26));
    auto described = describe(*header, name, header_offset);
    if (!described) {
      HYPERMAP_TRY(note_loss(described.error(), name));
      return behind_signature;
    }
    const auto taken = take_content(*described);
    if (taken) return described->end;
    HYPERMAP_TRY(note_loss(taken.error(), name));
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_followed, is_record_at(described->end));
    return is_followed ? described->end : behind_signature;
  }

  /// A local header with name and extra field; none where the file ends before.
  [[nodiscard]] Result<std::optional<std::string>> read_header(std::uint64_t offset) const {
    if (source_.size() - offset < zip::kLocalBytes) return std::nullopt;
    HYPERMAP_ASSIGN_OR_RETURN(const std::string fixed, source_.read_at(offset, zip::kLocalBytes));
    const std::size_t num_bytes = zip::kLocalBytes + get16(fixed, 26) + get16(fixed, 28);
    if (source_.size() - offset < num_bytes) return std::nullopt;
    HYPERMAP_ASSIGN_OR_RETURN(std::string header, source_.read_at(offset, num_bytes));
    return std::optional(std::move(header));
  }

  Result<LocalMember> describe(std::string_view header,
                               const std::string& name,
                               std::uint64_t header_offset) {
    HYPERMAP_TRY(check_member_name(name));
    const std::uint16_t flags = get16(header, 6);
    const std::uint16_t method = get16(header, 8);
    HYPERMAP_TRY(zip::check_flags(flags));
    const std::string_view extra = header.substr(zip::kLocalBytes + name.size());
    HYPERMAP_TRY(zip::check_extra(extra, name));
    HYPERMAP_ASSIGN_OR_RETURN(const auto sizes,
                              zip::wide_numbers(extra, {get32(header, 22), get32(header, 18)}));
    if (sizes[1] > source_.size()) {
      return damaged("is cut: it says " + std::to_string(sizes[1]) +
                     " bytes, more than the file has");
    }
    if (method != zip::kStored && method != zip::kDeflated) {
      return fail(ErrorCode::kUnsupported,
                  "compression method " + std::to_string(method) + " is not supported");
    }
    LocalMember local{.member = {.name = name,
                                 .num_bytes = sizes[0],
                                 .num_packed_bytes = sizes[1],
                                 .crc32 = get32(header, 14),
                                 .deflated = method == zip::kDeflated,
                                 .data_offset = header_offset + header.size()}};
    const bool has_descriptor = (flags & zip::kFlagDescriptor) != 0;
    const bool is_left_open = has_descriptor && local.member.num_packed_bytes == 0;
    if (is_left_open) {
      HYPERMAP_ASSIGN_OR_RETURN(local, close_by_descriptor(local));
    } else {
      local.end = local.member.data_offset + local.member.num_packed_bytes;
    }
    return local;
  }

  /// Sizes and CRC-32 of a member that was written before they were known stand behind it.
  Result<LocalMember> close_by_descriptor(const LocalMember& local) {
    const std::uint64_t begin = local.member.data_offset;
    std::uint64_t at = begin;
    while (num_searched_bytes_ <= source_.size()) {
      HYPERMAP_ASSIGN_OR_RETURN(
          const auto found,
          find({zip::kDescriptorSignature, zip::kLocalSignature, zip::kCentralSignature}, at));
      const std::uint64_t end = found.value_or(source_.size());
      num_searched_bytes_ += end - at;
      HYPERMAP_ASSIGN_OR_RETURN(const auto closed, closed_at(local, end));
      if (closed) return *closed;
      if (!found) break;
      at = end + kSignatureBytes;
    }
    return damaged("its end is not there: no data descriptor fits it");
  }

  /// The member when its descriptor begins at `end`, or without a signature ends there.
  [[nodiscard]] Result<std::optional<LocalMember>> closed_at(const LocalMember& open,
                                                             std::uint64_t end) const {
    constexpr std::size_t kDescriptorBytes = 12;
    for (const std::uint64_t begin : {end + kSignatureBytes, end - kDescriptorBytes}) {
      const std::uint64_t data_end = begin > end ? end : begin;
      if (end < open.member.data_offset + (begin > end ? 0 : kDescriptorBytes)) continue;
      if (begin + kDescriptorBytes > source_.size()) continue;
      HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, source_.read_at(begin, kDescriptorBytes));
      if (get32(bytes, 4) != data_end - open.member.data_offset) continue;
      LocalMember closed = open;
      closed.member.crc32 = get32(bytes, 0);
      closed.member.num_packed_bytes = get32(bytes, 4);
      closed.member.num_bytes = get32(bytes, 8);
      closed.end = begin + kDescriptorBytes;
      return std::optional(std::move(closed));
    }
    return std::nullopt;
  }

  Result<void> take_content(const LocalMember& local) {
    const ZipMember& member = local.member;
    HYPERMAP_TRY(zip::check_size(member, limits_));
    const std::uint64_t num_there = source_.size() - member.data_offset;
    if (num_there < member.num_packed_bytes) {
      return damaged("is cut: " + std::to_string(num_there) + " of " +
                     std::to_string(member.num_packed_bytes) + " bytes are there");
    }
    total_bytes_ += member.num_bytes;
    if (total_bytes_ > limits_.max_total_bytes) {
      is_beyond_limit_ = true;
      return fail(ErrorCode::kLimit,
                  "members of together " + std::to_string(total_bytes_) + " bytes, the limit is " +
                      std::to_string(limits_.max_total_bytes));
    }
    if (member.name.ends_with('/')) return {};
    HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, zip::content_of(source_, member, budget_));
    HYPERMAP_TRY(names_.add(member.name));
    salvage_.members.push_back({.name = member.name, .bytes = std::move(bytes)});
    return {};
  }

  /// Errors: the loss itself, when it ends all.
  Result<void> note_loss(Error error, const std::string& name) {
    error.entry = name;
    if (ends_all(error) || is_beyond_limit_) return Unexpected(std::move(error));
    salvage_.lost.push_back(std::move(error));
    return {};
  }

  /// Whether another record begins there, so that the member before is as long as it says.
  [[nodiscard]] Result<bool> is_record_at(std::uint64_t offset) const {
    if (offset > source_.size() || source_.size() - offset < kSignatureBytes) return false;
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, source_.read_at(offset, kSignatureBytes));
    constexpr std::array kRecords{
        zip::kLocalSignature, zip::kCentralSignature, zip::kDescriptorSignature};
    return std::ranges::find(kRecords, get32(bytes, 0)) != kRecords.end();
  }

  const ByteSource& source_;
  const ZipLimits& limits_;
  const LoadBudget& budget_;
  ZipSalvage salvage_;
  MemberNames names_;
  std::uint64_t total_bytes_ = 0;
  std::uint64_t num_searched_bytes_ = 0;  ///< For descriptors.
  bool is_beyond_limit_ = false;
};

}  // namespace

Result<ZipSalvage> salvage_zip(const ByteSource& source,
                               const ZipLimits& limits,
                               const LoadBudget& budget) {
  HYPERMAP_TRY(check_archive_size(source.size(), limits));
  return ZipSalvager(source, limits, budget).run();
}

}  // namespace hypermap
