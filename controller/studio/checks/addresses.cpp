// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/studio/checks/checks.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::checks {

using reading::in_quotes;

namespace {

/// The numbers that a fixture takes on one line, universe or bus.
struct Claim {
  const Fixture* fixture;
  std::string line;
  int first, last;
  bool dmx;
};

/// A motor on the lamp's own patch takes a slot that the mode leaves free.
void check_motor(const Fixture& fixture, reading::Report& report) {
  const auto channels = fixture.wired_channels();
  if (channels.empty()) return;
  const Channel& motor = channels.back();
  if (motor.dof != core::Dof::arc && motor.dof != core::Dof::track) return;
  for (std::size_t i = 0; i + 1 < channels.size(); ++i)
    for (int byte = 0; byte < channels[i].bytes; ++byte)
      if (const int slot = channels[i].slot(byte);
          slot >= motor.offset && slot < motor.offset + motor.bytes) {
        const int free = fixture.profile.modes[fixture.mode].footprint + 1;
        report.add({fixture.patch_place,
                    "the axis of " + in_quotes(fixture.name) + " is on slot " +
                        std::to_string(slot + 1) + ", where its lamp has " +
                        in_quotes(channels[i].name),
                    "the first free one is axis: {channel: " + std::to_string(free) + "}", false});
        return;
      }
}

std::vector<Claim> claims(const Studio& studio) {
  std::vector<Claim> all;
  for (const Fixture& fixture : studio.fixtures) {
    const int length = fixture.footprint();
    if (const auto* dmx = std::get_if<DmxPatch>(&fixture.patch))
      all.push_back({&fixture, "universe " + std::to_string(dmx->universe), dmx->address,
                     dmx->address + length - 1, true});
    else if (const auto* bus = std::get_if<ModbusPatch>(&fixture.patch))
      all.push_back({&fixture, "bus " + in_quotes(bus->bus), bus->register_number,
                     bus->register_number + length - 1, false});
    if (const auto motor = fixture.far_motor())
      all.push_back({&fixture, "universe " + std::to_string(motor->patch.universe),
                     motor->patch.address, motor->patch.address + motor->channel.bytes - 1, true});
  }
  return all;
}

std::string range(const Claim& claim) {
  return std::to_string(claim.first) +
         (claim.last > claim.first ? " to " + std::to_string(claim.last) : "");
}

/// First slot from `from` on where a fixture of that size fits on the line, or 0.
int free_address(const std::vector<Claim>& all, const Claim& wanted) {
  const int length = wanted.last - wanted.first + 1;
  for (int at = 1; at + length - 1 <= 512; ++at) {
    const bool clear = std::none_of(all.begin(), all.end(), [&](const Claim& other) {
      return other.fixture != wanted.fixture && other.line == wanted.line && at <= other.last &&
             other.first <= at + length - 1;
    });
    if (clear) return at;
  }
  return 0;
}

std::string free_words(const std::vector<Claim>& all, const Claim& wanted) {
  if (!wanted.dmx) return "use other registers";
  const int free = free_address(all, wanted);
  return free == 0 ? "that universe is full: use another"
                   : "address " + std::to_string(free) + " is free";
}

}  // namespace

void check_addresses(const Studio& studio, reading::Report& report) {
  // Thousands of lamps may share a few lines: only neighbours in sorted order are compared.
  std::vector<Claim> all = claims(studio);
  for (const Fixture& fixture : studio.fixtures)
    if (std::holds_alternative<DmxPatch>(fixture.patch)) check_motor(fixture, report);
  for (const Claim& claim : all)
    if (claim.last > (claim.dmx ? 512 : 65535))
      report.add({claim.fixture->patch_place,
                  in_quotes(claim.fixture->name) + " needs " +
                      std::to_string(claim.last - claim.first + 1) +
                      (claim.dmx ? " slots" : " registers") + " and would run to " +
                      std::to_string(claim.last) +
                      (claim.dmx ? ", a universe has 512" : ", a bus has 65535"),
                  claim.dmx ? free_words(all, claim) : "choose a lower register", false});
  std::vector<Claim> sorted = all;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Claim& a, const Claim& b) {
    return std::tie(a.line, a.first) < std::tie(b.line, b.first);
  });
  const Claim* reaching = nullptr;  // of those before, the one that reaches furthest
  for (const Claim& claim : sorted) {
    if (reaching != nullptr && reaching->line == claim.line && claim.first <= reaching->last) {
      const bool later = claim.fixture->patch_place.line >= reaching->fixture->patch_place.line;
      const Claim& blamed = later ? claim : *reaching;
      const Claim& other = later ? *reaching : claim;
      report.add({blamed.fixture->patch_place,
                  in_quotes(blamed.fixture->name) + " (" + range(blamed) + ") overlaps " +
                      in_quotes(other.fixture->name) + " (" + range(other) + ") on " + claim.line,
                  free_words(all, blamed), false});
    }
    if (reaching == nullptr || reaching->line != claim.line || claim.last > reaching->last)
      reaching = &claim;
  }
}

}  // namespace chiaro::studio::checks
