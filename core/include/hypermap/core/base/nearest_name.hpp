// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which name was meant by one that nobody knows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

/// The name of `known` that is nearest to `name` by edits (an exchange of neighbours is one), upper
/// and lower case alike; the first of equally near ones. When all are far, further than a third of
/// the name's length, at least 1: the shortest that has the name in it ("diningtable" for "table"),
/// of three letters or more. None also when the name has over 64 bytes. Cost: the product of the
/// lengths for each known name.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view name,
                                                           std::span<const std::string_view> known);

/// `, did you mean "..."?` or nothing: to be put after what is said of a name that nobody knows.
[[nodiscard]] std::string did_you_mean(std::string_view name,
                                       std::span<const std::string_view> known);
[[nodiscard]] std::string did_you_mean(std::string_view name, std::span<const std::string> known);

/// `must be one of a, b, is "c"`, and the nearest: what is said of a choice that is none.
[[nodiscard]] std::string not_one_of(std::string_view name,
                                     std::span<const std::string_view> choices);
[[nodiscard]] std::string not_one_of(std::string_view name, std::span<const std::string> choices);

/// `no layer is named "c"`, the nearest, `(there are: a, b)`: what is said of the name of a `kind`
/// that is not there. Boundary: `(there are: none)`.
[[nodiscard]] std::string nothing_named(std::string_view kind,
                                        std::string_view name,
                                        std::span<const std::string> known);

}  // namespace hypermap
