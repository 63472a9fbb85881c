// SPDX-License-Identifier: BSD-3-Clause
// The fuzzer's entry: environment HYPERMAP_FUZZ_TARGET names the target that it works on.
#include "fuzz_target.hpp"
#include "targets.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace hypermap::fuzz {
namespace {

const Target& chosen_target() {
  const char* name = std::getenv("HYPERMAP_FUZZ_TARGET");  // NOLINT(concurrency-mt-unsafe)
  const auto* const found =
      std::find_if(std::begin(kTargets), std::end(kTargets), [&](const Target& target) {
        return name != nullptr && target.name == name;
      });
  if (found != std::end(kTargets)) return *found;
  std::cerr << "HYPERMAP_FUZZ_TARGET must be one of:\n";
  for (const Target& target : kTargets) std::cerr << target.name << "\n";
  std::exit(4);  // NOLINT(concurrency-mt-unsafe): before anything runs
}

std::filesystem::path make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "hypermap-fuzz-XXXXXX").string();
  require(mkdtemp(pattern.data()) != nullptr, "there is a folder for temporary files");
  return pattern;
}

}  // namespace

std::filesystem::path file_of(std::string_view bytes, const std::string& name) {
  static const std::filesystem::path kFolder = make_folder();
  std::filesystem::path path = kFolder / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

}  // namespace hypermap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT
  static const hypermap::fuzz::Target& kTarget = hypermap::fuzz::chosen_target();
  kTarget.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
