// SPDX-License-Identifier: Apache-2.0
#include "controller/design/region.h"

#include <algorithm>
#include <cmath>

#include "controller/design/align.h"

namespace chiaro::design {
namespace {

using Kind = Region::Kind;

constexpr int kAcross = 3;  // looks at each pixel 3 x 3 times

/// Even-odd rule.
bool inside_polygon(const std::vector<std::array<double, 2>>& corners, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[j];
    if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

double mask_at(const core::Plane& mask, double x, double y) {
  if (mask.empty() || x < 0 || y < 0 || x >= 1 || y >= 1) return 0;
  return mask.at(static_cast<int>(x * mask.size.width), static_cast<int>(y * mask.size.height));
}

/// Of a drawn region, at a point of the whole frame.
double drawn_at(const Region& region, double x, double y) {
  const double u = (x - region.x) / (region.width / 2), v = (y - region.y) / (region.height / 2);
  switch (region.kind) {
    case Kind::rectangle:
      return std::abs(u) <= 1 && std::abs(v) <= 1;
    case Kind::ellipse:
      return u * u + v * v <= 1;
    case Kind::polygon:
      return inside_polygon(region.points, x, y);
    case Kind::mask:
      return mask_at(region.mask, x, y);
    default:
      return 1;
  }
}

core::Plane drawn(const Region& region, const studio::Camera& camera, core::Size size) {
  const double aspect = static_cast<double>(camera.size.height) / camera.size.width;
  core::Plane out(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      double sum = 0;
      for (int s = 0; s < kAcross * kAcross; ++s) {
        const double u = (x + (s % kAcross + 0.5) / kAcross) / size.width,
                     v = (y + (s / kAcross + 0.5) / kAcross) / size.height;
        sum += drawn_at(region, 0.5 + (u - 0.5) * aspect, v);
      }
      out.at(x, y) = static_cast<float>(sum / (kAcross * kAcross));
    }
  return out;
}

/// The upright ellipse of a face within its box, subject's pixels alone.
core::Plane face(const studio::Studio& studio, const core::GeometryPlanes& planes,
                 core::Size size) {
  core::Plane out(size);
  const auto found = our_face(studio, planes);
  if (!found) return out;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = ((x + 0.5) / size.width - found->box.x) / found->box.side,
                   v = ((y + 0.5) / size.height - found->box.y) / found->box.side;
      out.at(x, y) = u * u / 0.16 + v * v / 0.25 < 1 && planes.subject.at(x, y) ? 1.0f : 0.0f;
    }
  return out;
}

}  // namespace

std::array<double, 2> in_square(const studio::Camera& camera, double x, double y) {
  const double aspect = static_cast<double>(camera.size.width) / camera.size.height;
  return {0.5 + (x - 0.5) * aspect, y};
}

core::Plane mask_of(const Region& region, const studio::Studio& studio,
                    const core::GeometryPlanes* planes, core::Size size) {
  const bool of_scene = region.kind == Kind::subject || region.kind == Kind::background ||
                        region.kind == Kind::face || region.kind == Kind::object;
  if (!of_scene) return drawn(region, studio.main_camera(), size);
  if (planes == nullptr) return core::Plane(size, region.kind == Kind::background ? 0.0f : 1.0f);
  if (region.kind == Kind::face) return face(studio, *planes, size);
  core::Plane out(size);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const bool subject = planes->subject.values[i] != 0;
    const std::uint16_t object = planes->object.values[i];
    const bool in = region.kind == Kind::object    ? object == region.object
                    : region.kind == Kind::subject ? subject
                                                   : object != core::kNothing && !subject;
    out.values[i] = in ? 1.0f : 0.0f;
  }
  return out;
}

}  // namespace chiaro::design
