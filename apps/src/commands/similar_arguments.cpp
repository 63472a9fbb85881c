// SPDX-License-Identifier: BSD-3-Clause
#include "similar_arguments.hpp"

#include "hypermap/io/codec/embedding_file.hpp"

#include <CLI/Validators.hpp>

#include <utility>

namespace hypermap::app {
namespace {

constexpr std::size_t kMostAnswers = 1'000'000;

}  // namespace

void SimilarArguments::add_to(CLI::App& command) {
  command.add_option("--embedding",
                     embedding,
                     "the objects that look most like the vector of this file, .npy or JSON, best "
                     "first; with --string, --int, --at and --area those among them");
  command.add_option("--model", model, "the network that the vector of --embedding is of");
  command
      .add_option("--top",
                  top,
                  "how many objects --embedding (default: 10) or --nearest (default: 1) gives")
      ->check(CLI::Range(std::size_t{1}, kMostAnswers));
}

Result<SimilarTo> read_vector(const SimilarArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(EmbeddingFile file, read_embedding_file(*arguments.embedding));
  if (arguments.model && file.model && *arguments.model != *file.model) {
    return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                            .what = "is \"" + printable(*file.model) + "\", --model says \"" +
                                    printable(*arguments.model) + "\"",
                            .file = *arguments.embedding,
                            .field = "model"});
  }
  SimilarTo similar_to{.vector = std::move(file.vector)};
  similar_to.model = arguments.model.value_or(file.model.value_or(""));
  if (arguments.top) similar_to.top = *arguments.top;
  return similar_to;
}

}  // namespace hypermap::app
