// SPDX-License-Identifier: Apache-2.0
// Bytes of every mode of every generic profile, worked out by hand: the encoder and the decoder of
// the product share a table, so an error in it would not show in a there-and-back test.
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

#include "controller/patch/plan.h"
#include "controller/studio/load.h"
#include "tests/support/studios.h"

namespace chiaro::patch {
namespace {

using core::Dof;
using namespace std::chrono_literals;

struct Golden {
  const char* profile;
  const char* mode;
  std::vector<std::pair<Dof, double>> state;
  std::vector<int> bytes;
};

// clang-format off
const std::vector<Golden> kGolden{
    // Square law: 25 % light needs half drive. 0.5 * 255 = 127.5, 0.5 * 65535 = 32767.5: 0x8000.
    {"generic/dimmer", "1ch", {{Dof::intensity, 0.25}}, {128}},
    {"generic/dimmer", "1ch-16bit", {{Dof::intensity, 0.25}}, {0x80, 0x00}},
    // Linear. 0.4 * 255 = 102; 0.4 * 65535 = 26214 = 0x6666; 0.4 * 16777215 = 6710886 = 0x666666.
    {"generic/daylight-dimmer", "1ch", {{Dof::intensity, 0.4}}, {102}},
    {"generic/daylight-dimmer", "2ch-16bit", {{Dof::intensity, 0.4}}, {0x66, 0x66}},
    {"generic/daylight-dimmer", "3ch-24bit", {{Dof::intensity, 0.4}}, {0x66, 0x66, 0x66}},
    // CCT linear in kelvin from 2700 to 6500: 5550 K is 0.75 of the way; 191.25 and 49151.25.
    {"generic/bicolour-panel", "2ch", {{Dof::intensity, 0.2}, {Dof::cct, 5550}}, {51, 191}},
    {"generic/bicolour-panel", "4ch-16bit", {{Dof::intensity, 0.2}, {Dof::cct, 5550}},
     {0x33, 0x33, 0xbf, 0xff}},
    // Tint: -10 at DMX 11, +10 at 255: +5 is 11 + 0.75 * 244 = 194.
    {"generic/bicolour-panel", "3ch-tint",
     {{Dof::intensity, 1}, {Dof::cct, 2700}, {Dof::tint, 5}}, {255, 0, 194}},
    // Without a dimmer the level multiplies the drives.
    {"generic/rgb", "3ch",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.5}, {Dof::blue, 0.25}}, {204, 102, 51}},
    {"generic/rgb", "6ch-16bit",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.5}, {Dof::blue, 0.25}},
     {0xcc, 0xcc, 0x66, 0x66, 0x33, 0x33}},
    // With one they are sent as they are.
    {"generic/rgb", "4ch-dimmer",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.6}, {Dof::blue, 0.2}},
     {204, 255, 153, 51}},
    {"generic/rgbw", "4ch",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.5}, {Dof::blue, 0.25}, {Dof::white, 0.75}},
     {204, 102, 51, 153}},
    {"generic/rgbw", "8ch-16bit",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.5}, {Dof::blue, 0.25}, {Dof::white, 0.75}},
     {0xcc, 0xcc, 0x66, 0x66, 0x33, 0x33, 0x99, 0x99}},
    {"generic/rgbw", "6ch-dimmer",
     {{Dof::intensity, 0.8}, {Dof::red, 1}, {Dof::green, 0.6}, {Dof::blue, 0.2}, {Dof::white, 0.4}},
     {204, 255, 153, 51, 102, 0}},
    // 6500 K is a quarter of 2000..20000: 63.75, and 16383.75 = 0x4000.
    {"generic/tunable-panel", "2ch", {{Dof::intensity, 0.2}, {Dof::cct, 6500}}, {51, 64}},
    {"generic/tunable-panel", "4ch-16bit", {{Dof::intensity, 0.2}, {Dof::cct, 6500}},
     {0x33, 0x33, 0x40, 0x00}},
    // +135 of -270..270: 0.75 * 65535 = 49151.25 = 0xbfff; -67.5 of -135..135: 0.25 * 65535 =
    // 16383.75, 0x4000; zoom 25 of 10..40: 127.5; 25 kHz is the top of its range.
    {"generic/moving-head", "8ch",
     {{Dof::intensity, 0.4}, {Dof::pan, 2.356194490192345}, {Dof::tilt, -1.1780972450961724},
      {Dof::zoom, 0.4363323129985824}},
     {0xbf, 0xff, 0x40, 0x00, 102, 255, 128, 255}},
    {"generic/moving-head", "8ch-fine-last",
     {{Dof::intensity, 0.4}, {Dof::pan, 2.356194490192345}, {Dof::tilt, -1.1780972450961724},
      {Dof::zoom, 0.4363323129985824}},
     {0xbf, 0x40, 102, 255, 128, 0, 0xff, 0x00}},
    // 4600 K is a quarter of 2800..10000: 63.75. Tint -5 is half way along 11..119: 65.
    // The drives of a lamp with a dimmer go out as they are.
    {"generic/two-mix-panel", "7ch",
     {{Dof::intensity, 1}, {Dof::cct, 4600}, {Dof::tint, -5}, {Dof::crossfade, 0.2}, {Dof::red, 1},
      {Dof::green, 0.6}, {Dof::blue, 0}},
     {255, 64, 65, 51, 255, 153, 0}},
    // Coarse steps of 1/255 and 30 K, trims of up to 10 % and 255 K added to them. 0.5 is 127 / 255
    // = 0.498039 and 0.001961 more: 0.001961 / 0.1 * 255 = 5. 5617 K is 93 * 30 + 2800 = 5590 and 27.
    {"generic/two-mix-panel", "4ch-trim", {{Dof::intensity, 0.5}, {Dof::cct, 5617}},
     {127, 5, 93, 27}},
    {"generic/two-mix-panel", "4ch-cells", {{Dof::intensity, 0.4}, {Dof::cct, 4600}},
     {102, 64, 102, 64}},
};
// clang-format on

TEST(PatchBytes, AreThoseWorkedOutByHand) {
  for (const Golden& golden : kGolden) {
    std::string line = support::fixture_line("a", golden.profile, golden.mode, 1, 101);
    if (std::string(golden.profile) == "generic/moving-head")
      line.replace(line.find("fixed: {"), 8,
                   "pan_tilt: {pan: [-270 deg, 270 deg], tilt: [-135 deg, 135 deg], ");
    const auto studio = support::studio_from(support::studio_text(line));
    core::FixtureState state;
    for (const auto& [dof, value] : golden.state) state.set(dof, value);
    rig::Governor governor(studio, ports::TimePoint(1s));
    const Plan plan = Plan::of(studio);
    auto frames = plan.blank_frames();
    plan.encode(support::allow(governor, studio, {state}, ports::TimePoint(1s)), frames);
    std::vector<int> bytes;
    for (std::size_t i = 0; i < golden.bytes.size(); ++i)
      bytes.push_back(frames[0].levels[100 + i]);
    EXPECT_EQ(bytes, golden.bytes) << golden.profile << " " << golden.mode;
    EXPECT_EQ(frames[0].levels[99], 0);
    EXPECT_EQ(frames[0].levels[100 + golden.bytes.size()], 0);
  }
}

TEST(PatchBytes, CoverEveryModeOfEveryGenericProfile) {
  const studio::Folders folders{std::filesystem::path(CHIARO_SOURCE) / "config"};
  std::set<std::string> covered, shipped;
  for (const Golden& golden : kGolden)
    covered.insert(std::string(golden.profile) + " " + golden.mode);
  for (const auto& name : studio::profile_names(folders)) {
    if (name.rfind("generic/", 0) != 0) continue;
    const auto profile = studio::load_profile(name, folders);
    ASSERT_TRUE(profile);
    for (const auto& mode : profile->modes) shipped.insert(name + " " + mode.name);
  }
  EXPECT_EQ(covered, shipped);
}

}  // namespace
}  // namespace chiaro::patch
