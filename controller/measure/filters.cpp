// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/filters.h"

#include <algorithm>
#include <cmath>

namespace chiaro::measure {
namespace {

/// Calls `at(x, y, n)` with the 3 x 3 neighbourhood n[row][column], the border repeated.
template <class Visit>
void for_each_neighbourhood(const core::Plane& values, Visit visit) {
  const int w = values.size.width, h = values.size.height;
  for (int y = 0; y < h; ++y) {
    const float* rows[3] = {values.row(std::max(y - 1, 0)), values.row(y),
                            values.row(std::min(y + 1, h - 1))};
    for (int x = 0; x < w; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, w - 1);
      float n[3][3];
      for (int r = 0; r < 3; ++r) {
        n[r][0] = rows[r][left];
        n[r][1] = rows[r][x];
        n[r][2] = rows[r][right];
      }
      visit(x, y, n);
    }
  }
}

}  // namespace

core::Plane sobel_magnitude(const core::Plane& values) {
  core::Plane out(values.size);
  for_each_neighbourhood(values, [&](int x, int y, const float(&n)[3][3]) {
    const float gx = n[0][2] + 2 * n[1][2] + n[2][2] - n[0][0] - 2 * n[1][0] - n[2][0];
    const float gy = n[2][0] + 2 * n[2][1] + n[2][2] - n[0][0] - 2 * n[0][1] - n[0][2];
    out.at(x, y) = std::sqrt(gx * gx + gy * gy) / 8;
  });
  return out;
}

core::Plane laplacian(const core::Plane& values) {
  core::Plane out(values.size);
  for_each_neighbourhood(values, [&](int x, int y, const float(&n)[3][3]) {
    float around = 0;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) around += r == 1 && c == 1 ? 0 : n[r][c];
    out.at(x, y) = (8 * n[1][1] - around) / 8;
  });
  return out;
}

}  // namespace chiaro::measure
