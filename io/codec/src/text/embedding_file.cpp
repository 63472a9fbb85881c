// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/embedding_file.hpp"

#include "hypermap/core/segmentation/embedding.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/embedding_json.hpp"
#include "hypermap/io/codec/number_bytes.hpp"
#include "npy_header.hpp"

#include <utility>

namespace hypermap {
namespace {

Result<std::vector<float>> floats_of_npy(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const NpyHeader header, parse_npy_header(bytes));
  const std::string_view data = bytes.substr(header.num_header_bytes);
  const std::size_t number_bytes = header.is_double ? sizeof(double) : sizeof(float);
  if (header.num_numbers > kMaxEmbeddingDimension) {
    return fail(ErrorCode::kLimit,
                "at most " + std::to_string(kMaxEmbeddingDimension) + " numbers are read, has " +
                    std::to_string(header.num_numbers),
                "shape");
  }
  if (data.size() != number_bytes * header.num_numbers) {
    return fail(ErrorCode::kMalformedFile,
                "must have " + std::to_string(number_bytes * header.num_numbers) +
                    " bytes of numbers, has " + std::to_string(data.size()),
                "shape");
  }
  if (!header.is_double) return floats_of_bytes(data);
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> doubles, doubles_of_bytes(data));
  std::vector<float> floats;
  floats.reserve(doubles.size());
  for (const double number : doubles) floats.push_back(rounded_to_float(number));
  return floats;
}

Result<EmbeddingFile> parse_npy(std::string_view bytes) {
  EmbeddingFile file;
  HYPERMAP_ASSIGN_OR_RETURN(file.vector, floats_of_npy(bytes));
  if (auto valid = validate_embedding_vector(file.vector); !valid) {
    valid.error().code = ErrorCode::kMalformedFile;
    return tl::make_unexpected(std::move(valid).error());
  }
  return file;
}

Result<EmbeddingFile> parse_embedding_document(std::string_view text, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document,
                            JsonDocument::parse(text, name, {.max_bytes = kMaxEmbeddingFileBytes}));
  EmbeddingFile file;
  if (document.root().is(JsonKind::kArray)) {
    HYPERMAP_ASSIGN_OR_RETURN(file.vector, parse_embedding_vector(document.root()));
    return file;
  }
  HYPERMAP_ASSIGN_OR_RETURN(Embedding embedding, parse_embedding(document.root()));
  file.model = std::move(embedding.model);
  file.vector = std::move(embedding.vector);
  return file;
}

}  // namespace

Result<EmbeddingFile> parse_embedding_file(std::string_view bytes, const SourceName& source) {
  if (bytes.size() > kMaxEmbeddingFileBytes) {
    return fail(ErrorCode::kLimit,
                "at most " + std::to_string(kMaxEmbeddingFileBytes) + " bytes are read, has " +
                    std::to_string(bytes.size()));
  }
  auto file = is_npy(bytes) ? parse_npy(bytes) : parse_embedding_document(bytes, source.file);
  if (!file) return tl::make_unexpected(with_source(std::move(file).error(), source));
  return file;
}

Result<EmbeddingFile> read_embedding_file(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, kMaxEmbeddingFileBytes));
  return parse_embedding_file(bytes, {.file = path.string()});
}

}  // namespace hypermap
