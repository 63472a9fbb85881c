// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which names a text asks for: the one rule behind every query, export, image and evaluation that
/// is asked for a class.
///
/// Source: [hypermap] 3.3.1 (keyword queries). Prefixes, expressions and super-classes are ours.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/core/vocabulary/name_selection.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Longer regular expressions are refused.
inline constexpr std::size_t kMaxExpressionBytes = 256;

/// The names that `text` means, the first of these that fits:
/// 1. A name, in any spelling, that is known or stands in the vocabulary: that class with all its
///    aliases and all that are kinds of it. What a name holds has no other meaning.
/// 2. `chair*`: each known name, and each of the vocabulary with what it means, that begins so, in
///    any spelling.
/// 3. `/chair|sofa/`: the same for each that the regular expression (PCRE) matches as a whole,
///    upper and lower case alike.
/// 4. Any other text: a name that nobody knows, and which only something of that name has.
///
/// Errors: kInvalidArgument for an expression that is none, with the place, or is too long; kLimit
/// for one that takes more than ten thousand steps on a name, or too much memory: so no expression
/// takes longer than names allow.
/// Cost: n log n in the names for 2 and 3.
[[nodiscard]] Result<NameSelection> asked_names(std::string_view text,
                                                std::span<const std::string> known,
                                                const ClassVocabulary& vocabulary);

/// What is said when nothing `known` is among the names that `text` asks for: `no class is called
/// "chiar", did you mean "chair"?`, `no class is of "furniture" (bed, chair)`, `no class begins
/// with "chai"`, `no class matches /x/`; `no class` is `subject`.
[[nodiscard]] std::string nothing_asked(std::string_view text,
                                        std::span<const std::string> known,
                                        const ClassVocabulary& vocabulary,
                                        std::string_view subject = "no class");

/// The ids of all classes that the texts ask for, ascending, each once.
/// Errors: those of asked_names; kNotFound, `nothing_asked` of the first text that asks for no
/// class of these, with how many there are and, of a hundred at most, which.
[[nodiscard]] Result<std::vector<ClassId>> asked_classes(const ClassRegistry& classes,
                                                         const ClassVocabulary& vocabulary,
                                                         std::span<const std::string> texts);

}  // namespace hypermap
