// SPDX-License-Identifier: Apache-2.0
// What one camera sees of the geometry, one surface sample per pixel that sees something:
// structure-of-arrays, so that kernels stream it. Built once by `render`, relit thousands of times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/core/picture.h"

namespace chiaro::core {

inline constexpr std::uint16_t kNothing = 0;  ///< object id of a pixel that sees nothing

/// Sample i belongs to pixel `pixel[i]` (= y * width + x; ascending). Positions in metres, studio
/// frame. `to_viewer` and `normal` are unit; the normal faces the viewer.
struct GBuffer {
  Size size;
  std::vector<std::uint32_t> pixel;
  std::vector<float> position_x, position_y, position_z;
  std::vector<float> normal_x, normal_y, normal_z;  ///< shading normal
  std::vector<float> face_x, face_y, face_z;        ///< geometric normal
  std::vector<float> viewer_x, viewer_y, viewer_z;
  std::vector<float> diffuse_r, diffuse_g, diffuse_b;  ///< albedo 0..1, linear
  std::vector<float> specular, shininess;              ///< Blinn-Phong weight and exponent
  std::vector<float> depth;                            ///< metres along the camera's axis
  std::vector<std::uint16_t> object;                   ///< 1.. as in `objects`
  struct Object {
    std::string name;
    bool subject = false;  ///< else background
  };
  std::vector<Object> objects;  ///< entry k describes id k + 1

  std::size_t samples() const { return pixel.size(); }
};

/// Full-size planes for the picture measures: what pixel typing needs, nothing else. Where a pixel
/// sees nothing depth is +infinity, the normal (0,0,0) and the id kNothing.
struct GeometryPlanes {
  Plane depth, normal_x, normal_y, normal_z;
  Grid<std::uint16_t> object;
  Grid<std::uint8_t> subject;  ///< 1 where the pixel shows a subject
};
GeometryPlanes planes(const GBuffer& buffer);

/// What one light at full level adds to the picture, linear light, before exposure clipping.
/// Pixels that see nothing are 0. `diffuse` carries the light's colour; `specular` too.
struct Layer {
  Picture diffuse, specular;
};

}  // namespace chiaro::core
