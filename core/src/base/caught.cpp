// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"

#include <new>
#include <stdexcept>
#include <string>

namespace hypermap {

Unexpected caught(const std::exception& exception, ErrorCode otherwise, std::string_view subject) {
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr ||
      dynamic_cast<const std::length_error*>(&exception) != nullptr)
    return fail(ErrorCode::kOutOfMemory, "no memory for " + std::string(subject));
  return fail(otherwise, std::string(subject) + ": " + printable(exception.what()));
}

}  // namespace hypermap
