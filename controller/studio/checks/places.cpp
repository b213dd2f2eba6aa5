// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/checks/checks.h"
#include "controller/studio/reading/quantity.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::checks {
namespace {

const core::Vec3* fixed_place(const Mount& mount) {
  if (const auto* fixed = std::get_if<FixedMount>(&mount)) return &fixed->at;
  if (const auto* head = std::get_if<PanTiltMount>(&mount)) return &head->at;
  return nullptr;
}

}  // namespace

void check_places(const Studio& studio, reading::Report& report) {
  if (!studio.ceiling) return;
  const std::string ceiling = reading::written(reading::Measure::length, *studio.ceiling);
  const auto too_high = [&](const core::Place& where, const std::string& name, double z) {
    if (z > *studio.ceiling)
      report.add({where,
                  reading::in_quotes(name) + " is at a height of " +
                      reading::written(reading::Measure::length, z) + ", above the ceiling (" +
                      ceiling + ")",
                  "lower it, or correct 'ceiling'", false});
  };
  for (const Fixture& fixture : studio.fixtures)
    if (const core::Vec3* at = fixed_place(fixture.mount))
      too_high(fixture.place, fixture.name, at->z);
  for (const Camera& camera : studio.cameras) too_high(camera.place, camera.name, camera.at.z);
}

}  // namespace chiaro::studio::checks
