// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "image_oracle.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_bmp(std::string_view bytes) {
  static_cast<void>(checked_image(bytes));
}

}  // namespace hypermap::fuzz
