// SPDX-License-Identifier: Apache-2.0
// optic: {spot: {beam: 26 deg, field: 40 deg}}, {rectangle: [0.3, 0.3]}, {disk: {radius: 0.2 m}},
// point or directional, each with an attenuation.
#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"

namespace chiaro::studio::profiles {

using namespace reading;

namespace {

constexpr core::Range kSize{0.005, 20};
constexpr core::Range kAngle{core::radians(0.5), core::radians(179)};

void read_spot(const Tree& body, Optic& optic, Report& report) {
  Section spot(body, "a spot", report);
  into(optic.beam, quantity(spot.need("beam", "26 deg"), Measure::angle, kAngle, report));
  into(optic.field, quantity(spot.need("field", "40 deg"), Measure::angle, kAngle, report));
  spot.refuse_unknown();
  if (optic.field < optic.beam)
    report.error(body, "the field is narrower than the beam",
                 "beam is where the light is full, field where it ends");
}

void read_shape(const Variant& shape, const Tree& where, Optic& optic, Report& report) {
  constexpr Optic::Kind kKinds[] = {Optic::Kind::point, Optic::Kind::directional, Optic::Kind::spot,
                                    Optic::Kind::rectangle, Optic::Kind::disk};
  optic.kind = kKinds[shape.index];
  if (optic.kind == Optic::Kind::point || optic.kind == Optic::Kind::directional) return;
  if (shape.body == nullptr) {
    report.error(
        where, "this shape needs its size",
        "spot: {beam: 26 deg, field: 40 deg}, rectangle: [0.3, 0.3] or disk: {radius: 0.2 m}");
    return;
  }
  if (optic.kind == Optic::Kind::spot) {
    read_spot(*shape.body, optic, report);
  } else if (optic.kind == Optic::Kind::rectangle) {
    if (const auto v = numbers(shape.body, 2, kSize, "[width, height] in metres", report)) {
      optic.width = (*v)[0];
      optic.height = (*v)[1];
    }
  } else {
    Section disk(*shape.body, "a disk", report);
    into(optic.radius, quantity(disk.need("radius", "0.2 m"), Measure::length, kSize, report));
    disk.refuse_unknown();
  }
}

}  // namespace

Optic read_optic(const Tree* tree, Report& report) {
  Optic optic;
  if (tree == nullptr) return optic;
  const std::vector<std::string> shapes{"point", "directional", "spot", "rectangle", "disk"};
  if (const auto shape = variant(tree, "a kind of optic", shapes, report))
    read_shape(*shape, *tree, optic, report);
  return optic;
}

}  // namespace chiaro::studio::profiles
