// SPDX-License-Identifier: BSD-3-Clause
#include "vocabulary/name_expression.hpp"

#include "hypermap/core/vocabulary/asked_names.hpp"

#include <pcre2.h>

#include <array>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint32_t kMaxSteps = 10'000;
constexpr std::uint32_t kMaxDepth = 1'000;
constexpr std::uint32_t kMaxHeapKib = 1'024;
constexpr std::uint32_t kMaxParentheses = 50;

/// Frees what the library made.
struct Pcre2Deleter {
  void operator()(pcre2_code* code) const { pcre2_code_free(code); }
  void operator()(pcre2_compile_context* context) const { pcre2_compile_context_free(context); }
  void operator()(pcre2_match_context* context) const { pcre2_match_context_free(context); }
  void operator()(pcre2_match_data* data) const { pcre2_match_data_free(data); }
};

template <class Made>
using Pcre2Owner = std::unique_ptr<Made, Pcre2Deleter>;

std::string message_of(int code) {
  std::array<unsigned char, 256> text{};
  const int length = pcre2_get_error_message(code, text.data(), text.size());
  return length < 0 ? std::string("unknown error")
                    : std::string(text.begin(), text.begin() + length);
}

PCRE2_SPTR units_of(std::string_view text) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how the library takes bytes
  return reinterpret_cast<PCRE2_SPTR>(text.data());
}

Unexpected no_memory() {
  return fail(ErrorCode::kOutOfMemory, "no memory for a regular expression");
}

}  // namespace

struct NameExpression::Compiled {
  std::string text;
  Pcre2Owner<pcre2_code> code;
  Pcre2Owner<pcre2_match_context> context;
  Pcre2Owner<pcre2_match_data> data;
};

Result<NameExpression> NameExpression::create(std::string_view expression) {
  if (expression.size() > kMaxExpressionBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "a regular expression has at most " + std::to_string(kMaxExpressionBytes) +
                    " bytes, this one has " + std::to_string(expression.size()));
  }
  const Pcre2Owner<pcre2_compile_context> limits(pcre2_compile_context_create(nullptr));
  if (!limits) return no_memory();
  pcre2_set_parens_nest_limit(limits.get(), kMaxParentheses);
  int code = 0;
  std::size_t place = 0;
  auto compiled = std::make_shared<Compiled>();
  compiled->text = std::string(expression);
  compiled->code.reset(pcre2_compile(
      units_of(compiled->text),
      compiled->text.size(),
      PCRE2_UTF | PCRE2_CASELESS | PCRE2_ANCHORED | PCRE2_ENDANCHORED | PCRE2_NEVER_BACKSLASH_C,
      &code,
      &place,
      limits.get()));
  if (!compiled->code) {
    return fail(ErrorCode::kInvalidArgument,
                "/" + printable(expression) + "/ is no regular expression: " + message_of(code) +
                    ", at byte " + std::to_string(place));
  }
  compiled->context.reset(pcre2_match_context_create(nullptr));
  compiled->data.reset(pcre2_match_data_create(1, nullptr));
  if (!compiled->context || !compiled->data) return no_memory();
  pcre2_set_match_limit(compiled->context.get(), kMaxSteps);
  pcre2_set_depth_limit(compiled->context.get(), kMaxDepth);
  pcre2_set_heap_limit(compiled->context.get(), kMaxHeapKib);
  return NameExpression(std::move(compiled));
}

Result<bool> NameExpression::matches(std::string_view name) const {
  const int found = pcre2_match(compiled_->code.get(),
                                units_of(name),
                                name.size(),
                                0,
                                0,
                                compiled_->data.get(),
                                compiled_->context.get());
  if (found >= 0) return true;
  if (found == PCRE2_ERROR_NOMATCH) return false;
  return fail(ErrorCode::kLimit,
              "/" + printable(compiled_->text) + "/ takes too long on \"" + printable(name, 40) +
                  "\" (" + message_of(found) + "): a simpler expression is needed");
}

}  // namespace hypermap
