// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One vector in a file, to be compared with those of objects: what another program made of a text
/// or an image.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

inline constexpr std::size_t kMaxEmbeddingFileBytes = std::size_t{1} << 20U;

struct EmbeddingFile {
  std::optional<std::string> model;  ///< Where the file names it.
  std::vector<float> vector;
};

/// Found by content: NumPy's format (`.npy`) of versions 1 to 3, float32 or float64, little endian,
/// of shape (N,) or (1, N); a JSON list of numbers; a JSON object `{"model", "vector"}`
/// (embedding_json.hpp).
///
/// Source: numpy.lib.format. Errors: kIo; kLimit; kUnsupported for another type or shape of `.npy`,
/// which is named; kMalformedFile for a file that is cut or of neither form, and for a vector that
/// `validate_embedding_vector` refuses.
[[nodiscard]] Result<EmbeddingFile> read_embedding_file(const std::filesystem::path& path);
/// The same of bytes in memory.
[[nodiscard]] Result<EmbeddingFile> parse_embedding_file(std::string_view bytes,
                                                         const SourceName& source);

}  // namespace hypermap
