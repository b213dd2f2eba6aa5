// SPDX-License-Identifier: Apache-2.0
// Ears, hair, neck and shoulders.
#include <algorithm>
#include <array>
#include <cmath>

#include "controller/core/units.h"
#include "simulator/bust/parts.h"
#include "simulator/bust/shapes.h"

namespace chiaro::simulator::clay {

double with_ears(double head, Vec3 p) {
  // Ear frame: leaned back, and standing off the head towards its rear edge.
  Vec3 q = p - Vec3{7.3, -0.9, -1.2};
  q = turned_z(q, -0.45);
  q = turned_x(q, 0.2);
  double ear = ellipsoid(q, {0, 0, 0.4}, {0.75, 1.75, 2.7});
  ear = joined(ear, ellipsoid(q, {-0.1, 0.5, -2.2}, {0.55, 0.9, 1.0}), 0.8);  // lobe
  ear = carved(ear, ellipsoid(q, {1.0, 0.2, 0.6}, {0.75, 1.25, 2.0}), 0.3);   // inside the rim
  ear = joined(ear, ellipsoid(q, {0.3, -0.35, 0.4}, {0.35, 0.4, 1.4}), 0.4);  // antihelix
  ear = carved(ear, sphere(q, {0.75, 0.45, -0.6}, 0.65), 0.3);                // concha
  return joined(head, ear, 0.5);
}

namespace {

/// How far down the hair reaches at an angle from the front (degrees): the forehead, the temple,
/// in front of the ear, over it, behind it, the nape.
double hairline(double angle) {
  constexpr std::array<std::array<double, 2>, 9> kLine{{{0, 6.9},
                                                        {28, 6.7},
                                                        {42, 5.2},
                                                        {58, 2.6},
                                                        {78, -0.6},
                                                        {92, 1.2},
                                                        {112, -2.4},
                                                        {140, -6.2},
                                                        {180, -7.2}}};
  for (std::size_t i = 1; i < kLine.size(); ++i)
    if (angle <= kLine[i][0]) {
      const double t = (angle - kLine[i - 1][0]) / (kLine[i][0] - kLine[i - 1][0]);
      return kLine[i - 1][1] + t * (kLine[i][1] - kLine[i - 1][1]);
    }
  return kLine.back()[1];
}

}  // namespace

double with_hair(double head, Vec3 p) {
  const double angle = core::degrees(std::atan2(p.x, p.y + 1.0));
  double line = 0;  // averaged over a few degrees: no corners
  for (const double off : {-9.0, -3.0, 3.0, 9.0}) line += hairline(std::abs(angle + off)) / 4;
  const double above = p.z - line;
  const double locks = std::sin(2.3 * p.x + 0.5 * std::sin(0.7 * p.y)) * smooth_step(3, 7, p.z);
  const double thick = 0.5 + 0.45 * smooth_step(1, 8, p.z) + 0.06 * locks;
  return head - thick * smooth_step(-0.3, 1.5, above);
}

double neck_and_shoulders(Vec3 seamed) {
  // The halves of the trunk meet more broadly than those of the face.
  const Vec3 p{std::sqrt(seamed.x * seamed.x + 2.0) - std::sqrt(2.0), seamed.y, seamed.z};
  double d = limb(p, {0, -1.8, -5.5}, {0, -3.8, -19}, 4.7, 5.3);
  d = joined(d, limb(p, {4.6, -2.0, -5.0}, {0.7, 1.0, -17.6}, 0.9, 0.8), 2.4);   // the long muscle
  d = joined(d, ellipsoid(p, {0, 2.2, -12.6}, {0.8, 1.1, 1.5}), 1.5);            // larynx
  d = joined(d, limb(p, {2.0, -5.2, -13}, {14.0, -4.8, -20.5}, 2.6, 2.8), 5.0);  // trapezius
  d = joined(d, ellipsoid(p, {0, -4.0, -42}, {15.0, 8.8, 26}), 5.0);             // trunk
  d = joined(d, ellipsoid(p, {15.7, -4.4, -24.2}, {4.6, 5.2, 6.2}), 4.0);        // shoulder
  d = joined(d, limb(p, {16.9, -4.4, -25}, {18.2, -3.8, -52}, 4.4, 4.0), 3.0);   // arm
  d = joined(d, ellipsoid(p, {3.5, -0.5, -22.5}, {9.0, 3.0, 6.0}), 4.0);         // upper chest
  d = joined(d, ellipsoid(p, {6.4, 2.0, -29}, {6.5, 3.2, 6.5}), 5.0);
  d = joined(d, limb(p, {0.3, 1.0, -18.0}, {7.5, 0.6, -18.6}, 0.5, 0.6), 4.0);  // collar bone
  d = joined(d, limb(p, {7.5, 0.6, -18.6}, {14.0, -2.8, -19.4}, 0.6, 0.9), 4.0);
  return d;
}

}  // namespace chiaro::simulator::clay
