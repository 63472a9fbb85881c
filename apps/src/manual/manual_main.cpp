// SPDX-License-Identifier: BSD-3-Clause
// Writes the program's manual and its completion for bash from the definition of its command line.
// Usage: hypermap_manual FOLDER; writes FOLDER/man1/*.1 and FOLDER/bash-completion/hypermap.
#include "command_line.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "manual/bash_completion.hpp"
#include "manual/man_page.hpp"
#include "version.hpp"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace hypermap::app {
namespace {

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!failed) return {};
  return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
}

Result<void> write_manual(const std::filesystem::path& folder) {
  const CommandLine command_line;
  const CommandText program = describe(command_line.program);
  HYPERMAP_TRY(make_folder(folder / "man1"));
  HYPERMAP_TRY(make_folder(folder / "bash-completion"));
  for (const ManPage& page : man_pages(program, exit_statuses(), kVersion)) {
    HYPERMAP_TRY(write_file_atomically(folder / "man1" / page.name, page.text));
  }
  return write_file_atomically(folder / "bash-completion" / "hypermap",
                               bash_completion(program, kVersion));
}

}  // namespace
}  // namespace hypermap::app

int main(int argc, char** argv) {
  namespace app = hypermap::app;
  if (argc != 2) {
    std::fprintf(stderr, "usage: hypermap_manual FOLDER\n");
    return static_cast<int>(app::ExitCode::kUsage);
  }
  const auto written = app::write_manual(argv[1]);
  if (written) return 0;
  return static_cast<int>(app::report(written.error()));
}
