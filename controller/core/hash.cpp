// SPDX-License-Identifier: Apache-2.0
#include "controller/core/hash.h"

namespace chiaro::core {

std::string hex(std::uint64_t value) {
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4u)
    *digit = "0123456789abcdef"[value & 15u];
  return text;
}

}  // namespace chiaro::core
