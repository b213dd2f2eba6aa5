// SPDX-License-Identifier: Apache-2.0
#include "controller/core/gbuffer.h"

#include <limits>

namespace chiaro::core {

GeometryPlanes planes(const GBuffer& buffer) {
  GeometryPlanes out{Plane(buffer.size, std::numeric_limits<float>::infinity()),
                     Plane(buffer.size),
                     Plane(buffer.size),
                     Plane(buffer.size),
                     Grid<std::uint16_t>(buffer.size, kNothing),
                     Grid<std::uint8_t>(buffer.size, 0)};
  for (std::size_t i = 0; i < buffer.samples(); ++i) {
    const std::size_t p = buffer.pixel[i];
    out.depth.values[p] = buffer.depth[i];
    out.normal_x.values[p] = buffer.normal_x[i];
    out.normal_y.values[p] = buffer.normal_y[i];
    out.normal_z.values[p] = buffer.normal_z[i];
    out.object.values[p] = buffer.object[i];
    out.subject.values[p] =
        buffer.object[i] != kNothing && buffer.objects[buffer.object[i] - 1u].subject;
  }
  return out;
}

}  // namespace chiaro::core
