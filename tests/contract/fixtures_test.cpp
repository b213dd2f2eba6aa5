// SPDX-License-Identifier: Apache-2.0
// What must be true of every profile in config/fixtures: levels survive the wire, and a lamp that
// knows only its own data sheet understands them.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/patch/plan.h"
#include "controller/studio/load.h"
#include "tests/support/dmx_decoder.h"
#include "tests/support/studios.h"

namespace chiaro::patch {
namespace {

using core::Dof;
using core::FixtureState;
using namespace std::chrono_literals;

const studio::Folders kFolders{std::filesystem::path(CHIARO_SOURCE) / "config"};

class EveryProfile : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path file() const { return kFolders.fixtures() / (GetParam() + ".yaml"); }
  studio::Studio studio(const std::string& mode) const {
    std::string line = support::fixture_line("a", GetParam(), mode, 1, 1);
    // A head turns only where its mount says that it may.
    if (const auto at = line.find("fixed: {"); support::has_head(file()) && at != line.npos)
      line.replace(at, 8, "pan_tilt: {pan: [-720 deg, 720 deg], tilt: [-360 deg, 360 deg], ");
    return support::studio_from(support::studio_text(line));
  }
};

FixtureState random_state(const studio::Fixture& fixture, core::Random& random) {
  FixtureState state;
  for (const auto& [dof, range] : fixture.ranges())
    state.set(dof, random.uniform(range.least, range.most));
  return state;
}

/// The light of one drive: alone where there is no dimmer, else as it is.
double meant(const support::DecodedChannel& channel, const FixtureState& state, bool has_dimmer) {
  const Dof dof = *core::dof_named(channel.controls);
  const double value = core::file_value(dof, state.get(dof));
  const bool drive = dof >= Dof::red && dof <= Dof::cyan;
  return drive && !has_dimmer ? value * state.get(Dof::intensity) : value;
}

TEST_P(EveryProfile, IsUnderstoodByALampThatKnowsOnlyItsDataSheet) {
  core::Random random(20240501);
  for (const std::string& mode : support::modes_in(file())) {
    const auto studio = this->studio(mode);
    const Plan plan = Plan::of(studio);
    rig::Governor governor(studio, ports::TimePoint(1s));
    for (int round = 0; round < 50; ++round) {
      const FixtureState state = random_state(studio.fixtures[0], random);
      auto frames = plan.blank_frames();
      plan.encode(support::allow(governor, studio, {state}, ports::TimePoint(1s)), frames);
      const auto heard = support::decode_slots(file(), mode, frames[0].levels);
      bool has_dimmer = false;
      for (const auto& c : heard) has_dimmer = has_dimmer || c.controls == "intensity";
      for (const auto& c : heard) {
        if (c.controls.empty()) continue;
        EXPECT_NEAR(c.value, meant(c, state, has_dimmer), 0.51 * c.step * (c.whole ? 1 : 1.05))
            << mode << " " << c.controls;
      }
    }
  }
}

TEST_P(EveryProfile, GivesBackTheBytesThatItsDecodedLevelsCameFrom) {
  core::Random random(7);
  for (const std::string& mode : support::modes_in(file())) {
    const auto studio = this->studio(mode);
    const Plan plan = Plan::of(studio);
    rig::Governor governor(studio, ports::TimePoint(1s));
    auto blank = plan.blank_frames();
    const auto channels = support::decode_slots(file(), mode, blank[0].levels);
    for (int round = 0; round < 512; ++round) {
      auto frames = plan.blank_frames();
      for (const auto& c : channels)
        for (const int slot : c.at)
          if (c.whole && !c.controls.empty())
            frames[0].levels[static_cast<std::size_t>(slot)] = static_cast<std::uint8_t>(
                round < 256 ? static_cast<std::uint32_t>(round) : random.below(256));
      std::vector<FixtureState> states(1);
      plan.decode(frames, states);
      auto again = plan.blank_frames();
      plan.encode(support::allow(governor, studio, states, ports::TimePoint(1s)), again);
      for (const auto& c : channels)
        for (const int slot : c.at) {
          const auto s = static_cast<std::size_t>(slot);
          if (!c.whole || c.controls.empty()) continue;
          EXPECT_EQ(again[0].levels[s], frames[0].levels[s]) << mode << slot;
        }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryProfile, testing::ValuesIn(studio::profile_names(kFolders)),
                         [](const auto& about) {
                           std::string name = about.param;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace chiaro::patch
