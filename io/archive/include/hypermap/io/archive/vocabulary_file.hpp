// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A vocabulary of classes as YAML, by hand or in an archive: maps `aliases` (a class: the other
/// names of it) and `super_classes` (a super-class: what is of it), either of which may be absent.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// Errors: those of parse_yaml; kMalformedFile naming field and line for an unknown key, with the
/// nearest known one, for what is no list of names, and for what ClassVocabulary::create refuses;
/// kLimit.
[[nodiscard]] Result<ClassVocabulary> parse_vocabulary(std::string_view bytes,
                                                       const SourceName& source);
/// A file on disk. Errors: those of parse_vocabulary and kIo.
[[nodiscard]] Result<ClassVocabulary> read_vocabulary(const std::filesystem::path& path);
/// The same bytes for equal vocabularies; an empty one is two empty maps.
[[nodiscard]] std::string write_vocabulary(const ClassVocabulary& vocabulary);

}  // namespace hypermap
