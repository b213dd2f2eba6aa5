// SPDX-License-Identifier: Apache-2.0
#include "controller/core/merge.h"

#include <limits>

namespace chiaro::core {

Result<Picture> merged(std::span<const Part> parts) {
  if (parts.empty()) return Problem{{}, "there is no picture to merge", "show at least one object"};
  const Size size = parts.front().depth != nullptr ? parts.front().depth->size : Size{};
  for (const Part& part : parts)
    if (part.picture == nullptr || part.depth == nullptr || !(part.picture->size() == size) ||
        !(part.depth->size == size))
      return Problem{{},
                     "pictures that are merged need one size, each with its depth",
                     "draw them all from the same camera"};
  Picture out(size);
  for (std::size_t i = 0; i < size.pixels(); ++i) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const Part& part : parts) {
      if (!(part.depth->values[i] < nearest)) continue;
      nearest = part.depth->values[i];
      out.red.values[i] = part.picture->red.values[i];
      out.green.values[i] = part.picture->green.values[i];
      out.blue.values[i] = part.picture->blue.values[i];
    }
  }
  return out;
}

}  // namespace chiaro::core
