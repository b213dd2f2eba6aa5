// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/shapes.h"

#include <cmath>
#include <functional>

#include "controller/core/units.h"

namespace chiaro::daemon::study {
namespace {

using core::Vec3;
using simulator::TriangleMesh;

/// A surface over u, v in 0..1, its normals from the slopes; the seam's points are kept apart.
TriangleMesh surface(int columns, int rows, const std::function<Vec3(double, double)>& at) {
  TriangleMesh mesh;
  constexpr double kStep = 1e-4;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const double u = static_cast<double>(c) / columns, v = static_cast<double>(r) / rows;
      // At a pole one slope vanishes: a little beside it the normal is the same to the eye.
      const double inside = std::min(std::max(v, 2 * kStep), 1 - 2 * kStep);
      const Vec3 along = at(u + kStep, inside) - at(u - kStep, inside);
      const Vec3 up = at(u, inside + kStep) - at(u, inside - kStep);
      mesh.positions.push_back(at(u, v));
      mesh.normals.push_back(core::unit(core::cross(along, up)));
    }
  const auto index = [&](int c, int r) {
    return static_cast<std::uint32_t>(r * (columns + 1) + c);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      mesh.triangles.push_back({index(c, r), index(c + 1, r), index(c + 1, r + 1)});
      mesh.triangles.push_back({index(c, r), index(c + 1, r + 1), index(c, r + 1)});
    }
  return mesh;
}

Vec3 about_z(double u, double radius, double z) {
  const double a = 2 * core::kPi * u;
  return {radius * std::cos(a), radius * std::sin(a), z};
}

}  // namespace

TriangleMesh ball(double radius) {
  return surface(64, 32, [=](double u, double v) {
    const double a = core::kPi * (v - 0.5);
    return about_z(u, radius * std::cos(a), radius + radius * std::sin(a));
  });
}

TriangleMesh box(Vec3 size) {
  TriangleMesh mesh;
  const double x = size.x / 2, y = size.y / 2, z = size.z;
  const auto face = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : {a, b, c, d}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(core::unit(core::cross(b - a, d - a)));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  face({-x, -y, 0}, {x, -y, 0}, {x, -y, z}, {-x, -y, z});
  face({x, y, 0}, {-x, y, 0}, {-x, y, z}, {x, y, z});
  face({x, -y, 0}, {x, y, 0}, {x, y, z}, {x, -y, z});
  face({-x, y, 0}, {-x, -y, 0}, {-x, -y, z}, {-x, y, z});
  face({-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z});
  face({-x, y, 0}, {x, y, 0}, {x, -y, 0}, {-x, -y, 0});
  return mesh;
}

TriangleMesh ring(double radius, double thickness) {
  return surface(72, 36, [=](double u, double v) {
    const double a = 2 * core::kPi * v;
    return about_z(u, radius + thickness * std::cos(a), thickness + thickness * std::sin(a));
  });
}

TriangleMesh vase(double height) {
  return surface(72, 96, [=](double u, double v) {
    // Foot, belly, neck and lip; closed to points at both ends.
    const double belly = 0.30 * std::sin(core::kPi * std::pow(v, 0.75));
    const double lip = 0.10 * std::pow(v, 6), foot = 0.13 * std::pow(1 - v, 4);
    const double closed = std::min(1.0, std::min(v, 1 - v) / 0.012);
    return about_z(u, height * (0.05 + belly + lip + foot) * closed, height * v);
  });
}

TriangleMesh knot(double radius, double thickness) {
  const auto centre = [=](double u) {
    const double a = 2 * core::kPi * u, k = radius / 3;
    return Vec3{k * (std::sin(a) + 2 * std::sin(2 * a)), -k * std::sin(3 * a),
                k * (std::cos(a) - 2 * std::cos(2 * a)) + radius + thickness};
  };
  return surface(240, 24, [=](double u, double v) {
    const Vec3 way = core::unit(centre(u + 1e-4) - centre(u - 1e-4));
    const Vec3 side = core::unit(core::cross(way, Vec3{0, 1, 0.2}));
    const Vec3 up = core::cross(side, way);
    const double a = 2 * core::kPi * v;
    return centre(u) + thickness * (std::cos(a) * side - std::sin(a) * up);
  });
}

}  // namespace chiaro::daemon::study
