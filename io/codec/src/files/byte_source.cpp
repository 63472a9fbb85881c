// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/byte_source.hpp"

#include "system_error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <utility>

namespace hypermap {
namespace {

Error ends_early(std::uint64_t offset, std::size_t num_bytes, std::uint64_t size) {
  return Error{.code = ErrorCode::kMalformedFile,
               .what = "unexpected end of data: bytes " + std::to_string(offset) + " to " +
                       std::to_string(offset + num_bytes) + " asked for, there are " +
                       std::to_string(size)};
}

bool reaches_beyond(std::uint64_t offset, std::size_t num_bytes, std::uint64_t size) {
  return offset > size || num_bytes > size - offset;
}

Result<std::string> allocate(std::size_t num_bytes) {
  try {
    return std::string(num_bytes, '\0');
  } catch (const std::exception&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for " + std::to_string(num_bytes) + " bytes");
  }
}

class FileSource final : public ByteSource {
 public:
  FileSource(std::filesystem::path path, int descriptor, std::uint64_t size)
      : path_(std::move(path)), descriptor_(descriptor), size_(size) {}
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  FileSource(FileSource&&) = delete;
  FileSource& operator=(FileSource&&) = delete;
  ~FileSource() override { ::close(descriptor_); }

  [[nodiscard]] std::uint64_t size() const override { return size_; }

  [[nodiscard]] Result<std::string> read_at(std::uint64_t offset,
                                            std::size_t num_bytes) const override {
    if (reaches_beyond(offset, num_bytes, size_))
      return tl::make_unexpected(in_file(ends_early(offset, num_bytes, size_)));
    HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, allocate(num_bytes));
    std::size_t done = 0;
    while (done < num_bytes) {
      const ssize_t got =
          ::pread(descriptor_, bytes.data() + done, num_bytes - done, to_off(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return system_error(path_, "read", errno);
      if (got == 0)
        return tl::make_unexpected(in_file(ends_early(offset, num_bytes, offset + done)));
      done += static_cast<std::size_t>(got);
    }
    return bytes;
  }

 private:
  static off_t to_off(std::uint64_t offset) { return static_cast<off_t>(offset); }
  [[nodiscard]] Error in_file(Error error) const {
    error.file = path_.string();
    return error;
  }

  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_;
};

class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] Result<std::string> read_at(std::uint64_t offset,
                                            std::size_t num_bytes) const override {
    if (reaches_beyond(offset, num_bytes, bytes_.size()))
      return tl::make_unexpected(ends_early(offset, num_bytes, bytes_.size()));
    HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, allocate(num_bytes));
    bytes_.copy(bytes.data(), num_bytes, static_cast<std::size_t>(offset));
    return bytes;
  }

 private:
  std::string_view bytes_;
};

}  // namespace

Result<std::unique_ptr<ByteSource>> open_file(const std::filesystem::path& path,
                                              std::uint64_t max_bytes) {
  // Without O_NONBLOCK the opening of a FIFO would wait for its writer.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) return system_error(path, "open", errno);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    const int reason = errno;
    ::close(descriptor);
    return system_error(path, "look at", reason);
  }
  auto source =
      std::make_unique<FileSource>(path, descriptor, static_cast<std::uint64_t>(status.st_size));
  Error error{.code = ErrorCode::kIo, .what = {}, .file = path.string()};
  if (!S_ISREG(status.st_mode)) {
    error.what =
        S_ISDIR(status.st_mode) ? "is a folder, expected a regular file" : "is not a regular file";
    return tl::make_unexpected(std::move(error));
  }
  if (source->size() > max_bytes) {
    error.code = ErrorCode::kLimit;
    error.what = "is " + std::to_string(source->size()) + " bytes long, the limit is " +
                 std::to_string(max_bytes);
    return tl::make_unexpected(std::move(error));
  }
  return source;
}

std::unique_ptr<ByteSource> view_bytes(std::string_view bytes) {
  return std::make_unique<MemorySource>(bytes);
}

Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto source, open_file(path, max_bytes));
  return source->read_at(0, static_cast<std::size_t>(source->size()));
}

}  // namespace hypermap
