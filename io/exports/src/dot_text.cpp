// SPDX-License-Identifier: BSD-3-Clause
#include "dot_text.hpp"

#include "hypermap/core/base/result.hpp"

namespace hypermap {

std::string dot_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : printable(text, text.size())) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

}  // namespace hypermap
