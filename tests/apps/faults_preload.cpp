// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into the program by fault_test.py: counts the calls that the program and its libraries,
// the standard library included, make of the system on files in one folder. One of them fails, or
// is never reached. Environment:
//   HYPERMAP_FAULTS_IN   the folder, absolute
//   HYPERMAP_FAULTS_LOG  file that gets a line "<call> <path>" for each of them
//   HYPERMAP_FAULT       "<number, from 1 on> <errno>", or "<number> kill"; a full disk (ENOSPC)
//   stays full
//   HYPERMAP_FAULT_AT_EXIT  set: what libraries do after main() ends in abort()
//   HYPERMAP_FAULT_AFTER_POLL_MS  so long after poll() saw something the program goes on
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>

namespace {

struct Fault {
  long number = 0;  ///< 0: none.
  int reason = 0;   ///< 0: the program is killed.
};

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return value == nullptr ? std::string_view() : std::string_view(value);
}

Fault wanted_fault() {
  const std::string_view text = environment("HYPERMAP_FAULT");
  if (text.empty()) return {};
  const std::string_view reason = text.substr(text.find(' ') + 1);
  return {std::atol(text.data()), reason == "kill" ? 0 : std::atoi(reason.data())};
}

/// What the descriptor stands for; empty: nothing with a name.
std::string path_of(int descriptor) {
  std::array<char, PATH_MAX> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), path.data(), path.size());
  return length < 0 ? std::string() : std::string(path.data(), static_cast<std::size_t>(length));
}

std::string path_of(int folder, const char* name) {
  return name[0] == '/' || folder == AT_FDCWD ? name : path_of(folder) + "/" + name;
}

[[gnu::destructor]] void fail_at_exit() {
  if (!environment("HYPERMAP_FAULT_AT_EXIT").empty()) std::abort();
}

void note(const char* call, const std::string& path) {
  const std::string_view log = environment("HYPERMAP_FAULTS_LOG");
  if (log.empty()) return;
  const std::string line = call + (" " + path) + "\n";
  const long file =
      ::syscall(SYS_openat, AT_FDCWD, log.data(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  static_cast<void>(::syscall(SYS_write, file, line.data(), line.size()));
  static_cast<void>(::syscall(SYS_close, file));
}

/// Whether this call takes room on the disk.
bool takes_room(std::string_view call) {
  return call == "write" || call == "create" || call == "mkdir" || call == "mkdtemp";
}

/// Whether the call is to fail; then errno is set.
bool fails(const char* call, const std::string& path) {
  static const std::string_view kFolder = environment("HYPERMAP_FAULTS_IN");
  static const Fault kFault = wanted_fault();
  static std::atomic<long> count{0};
  const int before = errno;
  if (kFolder.empty() || !path.starts_with(kFolder)) return false;
  const long number = ++count;
  note(call, path);
  errno = before;
  const bool is_full = kFault.reason == ENOSPC && number > kFault.number && takes_room(call);
  if (kFault.number == 0 || (number != kFault.number && !is_full)) return false;
  if (kFault.reason == 0) {
    ::kill(::getpid(), SIGKILL);
    ::pause();
  }
  errno = kFault.reason;
  return true;
}

/// The function that this one stands before.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

const char* call_of(int how) {
  return (how & O_CREAT) != 0 ? "create" : "open";
}

/// open() and its like: the mode is there when a file may be made.
int open_real(const char* function, int folder, const char* path, int how, mode_t mode) {
  if (fails(call_of(how), path_of(folder, path))) return -1;
  return real<int(int, const char*, int, ...)>(function)(folder, path, how, mode);
}

}  // namespace

// NOLINTBEGIN(cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg,readability-inconsistent-declaration-parameter-name)
#define HYPERMAP_MODE(last)                                                                  \
  va_list arguments;                                                                         \
  va_start(arguments, last);                                                                 \
  const mode_t mode = ((last) & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0; \
  va_end(arguments)

extern "C" {

int open(const char* path, int how, ...) {
  HYPERMAP_MODE(how);
  return open_real("openat", AT_FDCWD, path, how, mode);
}
int open64(const char* path, int how, ...) {
  HYPERMAP_MODE(how);
  return open_real("openat64", AT_FDCWD, path, how, mode);
}
int openat(int folder, const char* path, int how, ...) {
  HYPERMAP_MODE(how);
  return open_real("openat", folder, path, how, mode);
}
int openat64(int folder, const char* path, int how, ...) {
  HYPERMAP_MODE(how);
  return open_real("openat64", folder, path, how, mode);
}
FILE* fopen(const char* path, const char* how) {
  if (fails(how[0] == 'r' ? "open" : "create", path_of(AT_FDCWD, path))) return nullptr;
  return real<FILE*(const char*, const char*)>("fopen")(path, how);
}
FILE* fopen64(const char* path, const char* how) {
  if (fails(how[0] == 'r' ? "open" : "create", path_of(AT_FDCWD, path))) return nullptr;
  return real<FILE*(const char*, const char*)>("fopen64")(path, how);
}
int close(int descriptor) {
  const std::string path = path_of(descriptor);
  const int result = real<int(int)>("close")(descriptor);
  return fails("close", path) ? -1 : result;
}
ssize_t read(int descriptor, void* bytes, std::size_t num_bytes) {
  if (fails("read", path_of(descriptor))) return -1;
  return real<ssize_t(int, void*, std::size_t)>("read")(descriptor, bytes, num_bytes);
}
ssize_t pread(int descriptor, void* bytes, std::size_t num_bytes, off_t offset) {
  if (fails("read", path_of(descriptor))) return -1;
  return real<ssize_t(int, void*, std::size_t, off_t)>("pread")(
      descriptor, bytes, num_bytes, offset);
}
ssize_t pread64(int descriptor, void* bytes, std::size_t num_bytes, off64_t offset) {
  return pread(descriptor, bytes, num_bytes, offset);
}
ssize_t write(int descriptor, const void* bytes, std::size_t num_bytes) {
  if (fails("write", path_of(descriptor))) return -1;
  return real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, num_bytes);
}
ssize_t writev(int descriptor, const iovec* parts, int num_parts) {
  if (fails("write", path_of(descriptor))) return -1;
  return real<ssize_t(int, const iovec*, int)>("writev")(descriptor, parts, num_parts);
}
int poll(pollfd* waiting, nfds_t count, int limit_ms) {
  const int ready = real<int(pollfd*, nfds_t, int)>("poll")(waiting, count, limit_ms);
  const std::string_view pause_ms = environment("HYPERMAP_FAULT_AFTER_POLL_MS");
  if (ready > 0 && !pause_ms.empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(std::atol(pause_ms.data())));
  return ready;
}
int fsync(int descriptor) {
  if (fails("fsync", path_of(descriptor))) return -1;
  return real<int(int)>("fsync")(descriptor);
}
int syncfs(int descriptor) noexcept {
  if (fails("fsync", path_of(descriptor))) return -1;
  return real<int(int)>("syncfs")(descriptor);
}
int fchmod(int descriptor, mode_t mode) noexcept {
  if (fails("fchmod", path_of(descriptor))) return -1;
  return real<int(int, mode_t)>("fchmod")(descriptor, mode);
}
int fchown(int descriptor, uid_t user, gid_t group) noexcept {
  if (fails("fchown", path_of(descriptor))) return -1;
  return real<int(int, uid_t, gid_t)>("fchown")(descriptor, user, group);
}
int stat(const char* path, struct stat* status) noexcept {
  if (fails("stat", path_of(AT_FDCWD, path))) return -1;
  return real<int(const char*, struct stat*)>("stat")(path, status);
}
int mkdir(const char* path, mode_t mode) noexcept {
  if (fails("mkdir", path_of(AT_FDCWD, path))) return -1;
  return real<int(const char*, mode_t)>("mkdir")(path, mode);
}
char* mkdtemp(char* pattern) {
  if (fails("mkdtemp", path_of(AT_FDCWD, pattern))) return nullptr;
  return real<char*(char*)>("mkdtemp")(pattern);
}
int rename(const char* from, const char* to) noexcept {
  if (fails("rename", path_of(AT_FDCWD, to))) return -1;
  return real<int(const char*, const char*)>("rename")(from, to);
}
int renameat2(int from_in, const char* from, int to_in, const char* to, unsigned how) noexcept {
  if (fails("rename", path_of(to_in, to))) return -1;
  return real<int(int, const char*, int, const char*, unsigned)>("renameat2")(
      from_in, from, to_in, to, how);
}
int rmdir(const char* path) noexcept {
  if (fails("remove", path_of(AT_FDCWD, path))) return -1;
  return real<int(const char*)>("rmdir")(path);
}
int remove(const char* path) noexcept {
  if (fails("remove", path_of(AT_FDCWD, path))) return -1;
  return real<int(const char*)>("remove")(path);
}
int unlink(const char* path) noexcept {
  if (fails("remove", path_of(AT_FDCWD, path))) return -1;
  return real<int(const char*)>("unlink")(path);
}
int unlinkat(int folder, const char* path, int how) noexcept {
  if (fails("remove", path_of(folder, path))) return -1;
  return real<int(int, const char*, int)>("unlinkat")(folder, path, how);
}

}  // extern "C"
// NOLINTEND(cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg,readability-inconsistent-declaration-parameter-name)
