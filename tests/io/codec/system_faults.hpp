// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lets system calls of our libraries fail in a test program whose linker wraps them
/// (tests/io/CMakeLists.txt), so that the libraries need no door for it.
#pragma once

#include <functional>
#include <string_view>

namespace hypermap::test {

/// While it lives each wrapped call asks `before_call` first, by the call's name: when it returns
/// no 0, the call fails with this errno (a close closes nevertheless). Writes are short, of three
/// bytes. Threads: of the thread that made it alone.
class SystemFaults {
 public:
  using BeforeCall = std::function<int(std::string_view call, int descriptor)>;
  explicit SystemFaults(BeforeCall before_call);
  ~SystemFaults();
  SystemFaults(const SystemFaults&) = delete;
  SystemFaults& operator=(const SystemFaults&) = delete;
  SystemFaults(SystemFaults&&) = delete;
  SystemFaults& operator=(SystemFaults&&) = delete;

 private:
  BeforeCall before_call_;
};

}  // namespace hypermap::test
