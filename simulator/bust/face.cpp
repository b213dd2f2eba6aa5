// SPDX-License-Identifier: Apache-2.0
// Skull, eyes, nose, mouth.
#include <algorithm>
#include <cmath>

#include "simulator/bust/parts.h"
#include "simulator/bust/shapes.h"

namespace chiaro::simulator::clay {

double skull_and_flesh(Vec3 p) {
  double d = ellipsoid(p, {0, -0.6, 2.8}, {7.4, 9.5, 8.3});
  d = joined(d, ellipsoid(p, {0, 1.9, 3.4}, {6.2, 7.4, 6.0}), 2.0);             // forehead
  d = joined(d, ellipsoid(p, {0, 2.4, -3.4}, {5.9, 6.4, 6.4}), 1.5);            // mid face
  d = joined(d, ellipsoid(p, {0, 2.2, -6.6}, {4.7, 5.8, 4.3}), 2.0);            // jaw
  d = joined(d, limb(p, {4.2, 1.8, -7.0}, {1.4, 7.0, -10.1}, 1.2, 1.15), 2.2);  // mandible
  d = joined(d, ellipsoid(p, {0.3, 7.3, -10.0}, {1.5, 1.5, 1.3}), 1.5);         // chin
  d = joined(d, ellipsoid(p, {0, 5.5, -6.8}, {2.9, 3.9, 2.6}), 1.6);            // teeth arch
  d = joined(d, ellipsoid(p, {4.2, 5.4, -2.6}, {1.8, 1.9, 1.3}), 1.8);          // cheekbone
  d = joined(d, limb(p, {4.9, 5.0, -2.2}, {6.3, 0.4, -1.6}, 0.7, 0.5), 1.6);
  d = joined(d, ellipsoid(p, {3.2, 5.6, -5.4}, {2.1, 2.0, 2.4}), 1.8);  // cheek
  return d;
}

namespace {

constexpr Vec3 kBall{3.15, 6.75, 0.0};
constexpr double kBallRadius = 1.22;

/// Height of the lids' edges over the width of the eye, and how far a point is inside the opening
/// (negative inside), measured on the front.
double opening(Vec3 p) {
  const double t = (p.x - 3.15) / 1.5;  // -1 inner corner, 1 outer corner
  const double arch = std::sqrt(std::max(0.0, 1 - t * t));
  const double upper = 0.50 * arch + 0.05 * t;
  const double lower = -0.46 * arch + 0.08 * t;
  const double ends = (std::abs(t) - 0.98) * 1.5;
  return std::max({p.z - upper, lower - p.z, ends});
}

}  // namespace

double with_eyes(double head, Vec3 p) {
  double d = head;
  // The brow: a ridge from the glabella out and a little up, falling away at the temple.
  d = joined(d, limb(p, {0.9, 8.65, 1.8}, {3.2, 8.1, 2.3}, 0.6, 0.62), 1.3);
  d = joined(d, limb(p, {3.2, 8.1, 2.3}, {5.4, 6.0, 1.7}, 0.62, 0.55), 1.3);
  // The socket, deepest beside the nose.
  d = carved(d, ellipsoid(p, {3.1, 9.1, 0.2}, {1.9, 1.9, 1.15}), 1.3);
  d = carved(d, sphere(p, {1.75, 8.9, 0.25}, 0.85), 0.9);
  // Lids: a shell about the ball with an almond cut out, and the fold above the upper one.
  double lids = sphere(p, kBall, kBallRadius + 0.19);
  lids = common(lids, 6.2 - p.y, 0.3);
  d = joined(d, lids, 0.55);
  const double tool = std::max(opening(p), 6.9 - p.y);
  d = carved(d, tool, 0.10);
  double ball = sphere(p, kBall, kBallRadius);
  // A drilled pupil, as sculptors cut it: the gaze needs a dark spot.
  ball = carved(ball, sphere(p, kBall + Vec3{0, kBallRadius, 0.03}, 0.36), 0.05);
  d = std::min(d, ball);
  return d;
}

double with_nose(double head, Vec3 p) {
  double d = head;
  double nose = limb(p, {0, 8.2, 1.0}, {0, 10.2, -2.6}, 0.7, 0.8);
  nose = joined(nose, sphere(p, {0, 10.75, -3.45}, 0.92), 0.9);                      // tip
  nose = joined(nose, limb(p, {0.9, 8.2, -1.2}, {1.0, 9.4, -3.7}, 0.6, 0.7), 0.9);   // flanks
  nose = joined(nose, ellipsoid(p, {1.15, 9.55, -3.95}, {0.64, 0.95, 0.68}), 0.45);  // wings
  nose = joined(nose, limb(p, {0, 10.75, -4.0}, {0, 9.3, -4.6}, 0.40, 0.42), 0.4);   // columella
  d = joined(d, nose, 0.8);
  return carved(d, ellipsoid(p, {0.6, 10.0, -4.68}, {0.33, 0.62, 0.5}), 0.2);  // nostril
}

double with_mouth(double head, Vec3 p) {
  double d = head;
  // Philtrum: two crests and the groove between.
  d = carved(d, limb(p, {0, 10.05, -5.1}, {0, 10.1, -6.0}, 0.26, 0.3), 0.45);
  // Lips follow the arch of the teeth.
  const double back = 0.14 * p.x * p.x;  // how far the arch has gone back at this x
  const Vec3 q{p.x, p.y + back, p.z};
  const double bow = 0.13 * std::exp(-p.x * p.x / 0.12);  // the cupid's dip
  const double upper = limb(q, {0, 9.27, -6.45 - bow}, {2.3, 9.2, -6.85}, 0.56, 0.2);
  const double lower = limb(q, {0, 9.12, -7.6}, {1.9, 9.05, -7.25}, 0.66, 0.25);
  d = joined(d, upper, 0.4);
  d = joined(d, lower, 0.5);
  // The line where they meet.
  const double line = -6.98 + 0.07 * std::cos(1.6 * p.x) - 0.02 * p.x * p.x;
  const double seam = std::max({std::abs(p.z - line) - 0.05, p.x - 2.45, 8.75 - q.y});
  d = carved(d, seam, 0.3);
  d = carved(d, sphere(p, {2.75, 8.65, -7.0}, 0.3), 0.6);  // corner
  return d;
}

}  // namespace chiaro::simulator::clay
