// SPDX-License-Identifier: Apache-2.0
// The parts of the bust, each a signed distance in centimetres. Frame: x to the sitter's left
// (always given as |x|, the face is symmetric), y forwards out of the face, z up; the origin lies
// midway between the ear holes at the height of the pupils. Measures are those of an average adult
// (head 22.5 high, 15.2 wide, 19.5 deep; pupils 6.3 apart; nose 3.5 wide; mouth 5).
#pragma once

#include "controller/core/geometry.h"

namespace chiaro::simulator::clay {

double skull_and_flesh(core::Vec3 p);         ///< cranium, cheeks, jaw, chin, muzzle
double with_eyes(double head, core::Vec3 p);  ///< sockets, brow, balls, lids
double with_nose(double head, core::Vec3 p);
double with_mouth(double head, core::Vec3 p);
double with_ears(double head, core::Vec3 p);
double with_hair(double head, core::Vec3 p);
double neck_and_shoulders(core::Vec3 p);

}  // namespace chiaro::simulator::clay
