// SPDX-License-Identifier: BSD-3-Clause
#include "io/codec/system_faults.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace hypermap::test {
namespace {

/// Of this thread.
SystemFaults::BeforeCall*& active() {
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
  thread_local SystemFaults::BeforeCall* before_call = nullptr;
  return before_call;
}

/// Whether the call is to fail; then errno is set.
bool fails(std::string_view call, int descriptor = -1) {
  if (active() == nullptr) return false;
  const int reason = (*active())(call, descriptor);
  if (reason != 0) errno = reason;
  return reason != 0;
}

}  // namespace

SystemFaults::SystemFaults(BeforeCall before_call) : before_call_(std::move(before_call)) {
  active() = &before_call_;
}

SystemFaults::~SystemFaults() {
  active() = nullptr;
}

// --wrap=<call> leads <call> to __wrap_<call> and __real_<call> to <call>.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {

int __real_open(const char* path, int how, mode_t mode);
int __real_close(int descriptor);
ssize_t __real_write(int descriptor, const void* bytes, std::size_t num_bytes);
int __real_fchmod(int descriptor, mode_t mode);
int __real_fchown(int descriptor, uid_t user, gid_t group);
int __real_fsync(int descriptor);
int __real_syncfs(int descriptor);
int __real_rename(const char* from, const char* to);
int __real_renameat2(int from_in, const char* from, int to_in, const char* to, unsigned how);
char* __real_mkdtemp(char* pattern);

int __wrap_open(const char* path, int how, mode_t mode);
int __wrap_close(int descriptor);
ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t num_bytes);
int __wrap_fchmod(int descriptor, mode_t mode);
int __wrap_fchown(int descriptor, uid_t user, gid_t group);
int __wrap_fsync(int descriptor);
int __wrap_syncfs(int descriptor);
int __wrap_rename(const char* from, const char* to);
int __wrap_renameat2(int from_in, const char* from, int to_in, const char* to, unsigned how);
char* __wrap_mkdtemp(char* pattern);

int __wrap_open(const char* path, int how, mode_t mode) {
  return fails("open") ? -1 : __real_open(path, how, mode);
}

int __wrap_close(int descriptor) {
  const int result = __real_close(descriptor);
  return fails("close") ? -1 : result;
}

ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t num_bytes) {
  if (fails("write", descriptor)) return -1;
  const std::size_t most = active() == nullptr ? num_bytes : 3;
  return __real_write(descriptor, bytes, std::min(num_bytes, most));
}

int __wrap_fchmod(int descriptor, mode_t mode) {
  return fails("fchmod", descriptor) ? -1 : __real_fchmod(descriptor, mode);
}

int __wrap_fchown(int descriptor, uid_t user, gid_t group) {
  return fails("fchown", descriptor) ? -1 : __real_fchown(descriptor, user, group);
}

int __wrap_fsync(int descriptor) {
  return fails("fsync", descriptor) ? -1 : __real_fsync(descriptor);
}

int __wrap_syncfs(int descriptor) {
  return fails("syncfs", descriptor) ? -1 : __real_syncfs(descriptor);
}

int __wrap_rename(const char* from, const char* to) {
  return fails("rename") ? -1 : __real_rename(from, to);
}

int __wrap_renameat2(int from_in, const char* from, int to_in, const char* to, unsigned how) {
  return fails("renameat2") ? -1 : __real_renameat2(from_in, from, to_in, to, how);
}

char* __wrap_mkdtemp(char* pattern) {
  return fails("mkdtemp") ? nullptr : __real_mkdtemp(pattern);
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

}  // namespace hypermap::test
