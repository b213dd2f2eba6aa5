// SPDX-License-Identifier: Apache-2.0
// Every setting of the grammar, read once; the values are worked out by hand from the text.
#include <fstream>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::studio {
namespace {

using core::Dof;

class Grammar : public ::testing::Test {
 protected:
  Grammar() { support::write_full_studio_files(folder_.path()); }
  core::Result<Loaded> parse(const std::string& text) const {
    return parse_studio(text, folder_.path(), support::shipped_folders());
  }
  Studio full() const {
    const auto loaded = parse(support::full_studio_text());
    EXPECT_TRUE(loaded.ok()) << core::to_string(loaded.problems());
    return loaded.ok() ? loaded->studio : Studio{};
  }
  support::TemporaryFolder folder_;
};

TEST_F(Grammar, SubjectsByNameWithTheBustAsStandIn) {
  const Studio studio = full();
  ASSERT_EQ(studio.subjects.size(), 2u);
  const Subject& anna = studio.subjects[0];
  EXPECT_EQ(anna.name, "anna");
  EXPECT_TRUE(anna.stand_in);
  EXPECT_EQ(anna.mesh.filename(), "bust.ply");
  EXPECT_DOUBLE_EQ(anna.eye_height, 1.55);
  EXPECT_EQ(anna.at, (core::Vec3{-0.4, 0.1, 0}));
  EXPECT_DOUBLE_EQ(anna.facing, core::radians(20));
  EXPECT_EQ(anna.aim, (core::Vec3{-0.4, 0.1, 1.5}));
  const Subject& vase = studio.subjects[1];
  EXPECT_EQ(vase.mesh, folder_.path() / "mesh.ply");
  EXPECT_DOUBLE_EQ(*vase.height, 0.4);
  EXPECT_EQ(vase.up, UpAxis::z);
  EXPECT_EQ(vase.front, (core::Vec3{0, -1, 0}));
  EXPECT_EQ(vase.material->diffuse, (core::Rgb{0.6, 0.5, 0.4}));
  EXPECT_DOUBLE_EQ(vase.material->shininess, 24);
}

TEST_F(Grammar, RoomWithNormalsMadeUnitAndAGreyFromOneNumber) {
  const Studio studio = full();
  EXPECT_NEAR(*studio.ceiling, 3.048, 1e-12);
  ASSERT_EQ(studio.background.size(), 2u);
  EXPECT_EQ(studio.background[0].normal, (core::Vec3{0, -1, 0}));
  EXPECT_DOUBLE_EQ(studio.background[0].width, 6);
  EXPECT_EQ(studio.background[0].material.diffuse, (core::Rgb{0.35, 0.35, 0.35}));
  EXPECT_DOUBLE_EQ(studio.background[1].width, 0);
}

TEST_F(Grammar, TheCameraCalledMainComesFirstWhereverItStands) {
  const Studio studio = full();
  ASSERT_EQ(studio.cameras.size(), 3u);
  EXPECT_EQ(studio.main_camera().name, "main");
  EXPECT_EQ(studio.main_camera().source, "http://10.0.0.2/a");
  EXPECT_EQ(studio.main_camera().size, (core::Size{320, 240}));
  EXPECT_FALSE(studio.main_camera().shutter_s);
  const Camera& side = studio.cameras[1];
  EXPECT_EQ(side.name, "side");
  EXPECT_DOUBLE_EQ(side.vertical_fov, 0.5);
  EXPECT_DOUBLE_EQ(*side.shutter_s, 0.02);
  EXPECT_DOUBLE_EQ(*side.aperture_f, 2.8);
  EXPECT_DOUBLE_EQ(*side.iso, 400);
  EXPECT_TRUE(side.lamps_may_show);
  EXPECT_EQ(side.source, "v4l2:/dev/video0");
  EXPECT_EQ(studio.cameras[2].source, "file:" + (folder_.path() / "frame.png").string());
}

TEST_F(Grammar, AStandWithLimitsCurveAndAFittedSoftbox) {
  const Studio studio = full();
  const Fixture& key = *studio.fixture("key");
  EXPECT_EQ(key.role, Role::key);
  EXPECT_EQ(key.profile.modes[key.mode].name, "4ch-16bit");
  EXPECT_DOUBLE_EQ(key.output.value, 14000);
  const auto& stand = std::get<StandMount>(key.mount);
  EXPECT_DOUBLE_EQ(stand.at.azimuth, core::radians(-45));
  EXPECT_DOUBLE_EQ(stand.at.distance, 1.8);
  EXPECT_EQ(stand.region.elevation, (core::Range{core::radians(-45), core::radians(70)}));
  EXPECT_EQ(std::get<DmxPatch>(key.patch).address, 1);
  EXPECT_DOUBLE_EQ(key.limits.most, 0.8);
  EXPECT_DOUBLE_EQ(key.limits.slew_per_s, 0.5);
  EXPECT_DOUBLE_EQ(key.limits.safe_level, 0.1);
  EXPECT_TRUE(key.limits.ignores_blackout);
  EXPECT_DOUBLE_EQ(key.limits.end_to_end_s, 20);
  EXPECT_EQ(key.curve.law, DimmerCurve::Law::gamma);
  EXPECT_DOUBLE_EQ(key.initial.get(Dof::intensity), 0.3);
  EXPECT_DOUBLE_EQ(key.initial.get(Dof::cct), 4300);
}

TEST_F(Grammar, CircuitsAndPlacesToKeepOutOf) {
  const Studio studio = full();
  ASSERT_EQ(studio.circuits.size(), 1u);
  const Circuit& wall = studio.circuits[0];
  EXPECT_EQ(wall.name, "left wall");
  EXPECT_DOUBLE_EQ(wall.limit_w, 2300);
  EXPECT_FALSE(wall.tungsten);
  ASSERT_EQ(wall.loads.size(), 2u);
  EXPECT_EQ(wall.loads[1].fixture, *studio.fixture_index("head"));
  EXPECT_DOUBLE_EQ(wall.loads[1].watts, 300);
  ASSERT_EQ(studio.keep_out.size(), 1u);
  EXPECT_EQ(studio.keep_out[0].at, (core::Vec3{1, -2, 1}));
  EXPECT_DOUBLE_EQ(studio.keep_out[0].radius, 0.8);
}

TEST_F(Grammar, NamesWhatIsWrongInACircuit) {
  const auto bad = parse(support::edited(support::full_studio_text(), "{hair: 650 W, head: 300 W}",
                                         "{hair: 650 W, heat: 300 W}"));
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(core::to_string(bad.problems()).find("there is no fixture 'heat'"), std::string::npos);
  const auto twice = parse(
      support::edited(support::full_studio_text(),
                      "keep_out:", "  right wall: {limit: 16 W, lamps: {head: 5 W}}\nkeep_out:"));
  ASSERT_FALSE(twice.ok());
  EXPECT_NE(core::to_string(twice.problems()).find("on another circuit already"),
            std::string::npos);
}

TEST_F(Grammar, EveryKindOfMount) {
  const Studio studio = full();
  const auto& arc = std::get<ArcMount>(studio.fixture("fill")->mount);
  EXPECT_TRUE(arc.vertical);
  EXPECT_DOUBLE_EQ(arc.at, core::radians(40));
  EXPECT_EQ(arc.axis.universe, 2);
  EXPECT_EQ(arc.axis.slot, 100);
  EXPECT_EQ(arc.axis.bytes, 2);
  const auto& track = std::get<TrackMount>(studio.fixture("hair")->mount);
  EXPECT_DOUBLE_EQ(track.at, 0.25);
  EXPECT_EQ(track.axis.universe, 0);
  EXPECT_EQ(track.axis.slot, 2);
  EXPECT_EQ(track.axis.bytes, 1);
  const auto& head = std::get<PanTiltMount>(studio.fixture("head")->mount);
  EXPECT_DOUBLE_EQ(head.pan.least, core::radians(-270));
  const auto& fixed = std::get<FixedMount>(studio.fixture("tungsten")->mount);
  EXPECT_EQ(fixed.at, (core::Vec3{-0.8, 1.1, 2.3}));
  const auto& free = std::get<VirtualMount>(studio.fixture("free")->mount);
  EXPECT_TRUE(free.separate_specular);
  EXPECT_EQ(free.region.distance, (core::Range{2, 2}));
  // The quarter sphere above and in front, unless the file says more [I-5].
  EXPECT_EQ(free.region.elevation, (core::Range{0, core::kPi / 2}));
}

TEST_F(Grammar, WhatAPersonSetsByHand) {
  const Studio studio = full();
  const Fixture& tungsten = *studio.fixture("tungsten");
  EXPECT_TRUE(std::holds_alternative<NoPatch>(tungsten.patch));
  ASSERT_EQ(tungsten.by_hand.size(), 2u);
  EXPECT_EQ(tungsten.by_hand[0].dof, Dof::intensity);
  EXPECT_EQ(tungsten.by_hand[0].kind, HandKind::knob);
  EXPECT_EQ(tungsten.by_hand[1].kind, HandKind::gel);
  EXPECT_EQ(*tungsten.by_hand[1].range, (core::Range{3200, 5600}));
  EXPECT_EQ(studio.fixture("flash")->by_hand[0].kind, HandKind::flash_power);
  // A stand's place is by hand without saying so.
  const Fixture& key = *studio.fixture("key");
  ASSERT_EQ(key.by_hand.size(), 3u);
  for (const HandBinding& binding : key.by_hand) EXPECT_EQ(binding.kind, HandKind::stand);
}

TEST_F(Grammar, PatchesOutputsAndBuses) {
  const Studio studio = full();
  const auto& drive = std::get<ModbusPatch>(studio.fixture("drive")->patch);
  EXPECT_EQ(drive.bus, "rail");
  EXPECT_EQ(drive.register_number, 40);
  ASSERT_EQ(studio.outputs.size(), 3u);
  const auto& sacn = std::get<SacnOutput>(studio.outputs[0].driver);
  EXPECT_EQ(sacn.interface, "eth0");
  EXPECT_DOUBLE_EQ(sacn.rate_hz, 30);
  EXPECT_EQ(sacn.priority, 120);
  EXPECT_EQ(sacn.unicast, "10.0.0.7");
  EXPECT_DOUBLE_EQ(std::get<MockOutput>(studio.outputs[1].driver).rate_hz, 40);
  EXPECT_DOUBLE_EQ(std::get<MockOutput>(studio.outputs[2].driver).rate_hz, 25);
  ASSERT_EQ(studio.buses.size(), 1u);
  EXPECT_EQ(studio.buses[0].device, "tcp://10.0.0.9:502");
  EXPECT_EQ(studio.buses[0].baud, 19200);
}

TEST_F(Grammar, ExposureAmbientAndSafety) {
  const Studio studio = full();
  EXPECT_NEAR(studio.exposure.grey_card.value, 538.1955, 1e-3);  // 50 foot-candles
  ASSERT_TRUE(studio.ambient);
  EXPECT_DOUBLE_EQ(studio.ambient->illuminance.value, 20);
  EXPECT_DOUBLE_EQ(studio.ambient->cct.value, 4000);
  EXPECT_DOUBLE_EQ(*studio.safety.fade_to_safe_after_s, 60);
  EXPECT_DOUBLE_EQ(studio.safety.fade_to_safe_s, 4);
  EXPECT_EQ(studio.safety.power_up, Safety::PowerUp::dark);
}

TEST_F(Grammar, AMeasuredFrameInsteadOfAnAmbientLevel) {
  const auto loaded = parse(support::edited(
      support::full_studio_text(), "{illuminance: 20 lx, cct: 4000 K}", "{measured: off.exr}"));
  ASSERT_TRUE(loaded.ok()) << core::to_string(loaded.problems());
  EXPECT_EQ(loaded->studio.ambient->measured, folder_.path() / "off.exr");
}

TEST_F(Grammar, AnOutputThatCarriesNothingIsAWarning) {
  const auto loaded = parse(support::full_studio_text());
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(
      core::to_string(loaded->warnings),
      "studio.yaml:98:3: warning: universe 3 carries no fixture (delete this output, or patch "
      "a fixture to it)\n");
}

TEST_F(Grammar, ColourNobodySetsStartsAtTheWhiteBalanceOrAsNearAsTheLampComes) {
  const Studio studio = full();
  EXPECT_DOUBLE_EQ(studio.fixture("fill")->initial.get(Dof::cct), 5600);
  EXPECT_DOUBLE_EQ(studio.fixture("fill")->initial.get(Dof::tint), 0);
  EXPECT_DOUBLE_EQ(studio.fixture("fill")->initial.get(Dof::intensity), 0);
  EXPECT_DOUBLE_EQ(studio.fixture("drive")->initial.get(Dof::white), 1);
  EXPECT_DOUBLE_EQ(studio.fixture("head")->initial.get(Dof::green), 0.5);
  // Nobody dims it: it is on.
  EXPECT_DOUBLE_EQ(studio.fixture("window")->initial.get(Dof::intensity), 1);
}

TEST_F(Grammar, FingerprintIsOfContentNotOfPlace) {
  const auto first = parse(support::full_studio_text());
  support::TemporaryFolder elsewhere;
  support::write_full_studio_files(elsewhere.path());
  const auto moved =
      parse_studio(support::full_studio_text(), elsewhere.path(), support::shipped_folders());
  const auto changed =
      parse(support::edited(support::full_studio_text(), "priority: 120", "priority: 121"));
  ASSERT_TRUE(first.ok() && moved.ok() && changed.ok());
  EXPECT_EQ(first->studio.fingerprint, moved->studio.fingerprint);
  EXPECT_NE(first->studio.fingerprint, changed->studio.fingerprint);
}

TEST_F(Grammar, FingerprintSeesAChangedProfile) {
  namespace fs = std::filesystem;
  support::TemporaryFolder config;
  fs::copy(support::shipped_folders().config, config.path(), fs::copy_options::recursive);
  const Folders folders{config.path()};
  const auto before = parse_studio(support::full_studio_text(), folder_.path(), folders);
  std::ofstream(folders.fixtures() / "generic/dimmer.yaml", std::ios::app) << "# a new word\n";
  const auto after = parse_studio(support::full_studio_text(), folder_.path(), folders);
  ASSERT_TRUE(before.ok() && after.ok());
  EXPECT_NE(before->studio.fingerprint, after->studio.fingerprint);
}

TEST_F(Grammar, RelativePathsAreTriedBesideTheFileThenAmongWhatIsShipped) {
  const std::string text =
      support::edited(support::full_studio_text(), "mesh: mesh.ply", "mesh: subjects/bust.ply");
  const auto shipped = parse(text);
  ASSERT_TRUE(shipped.ok());
  EXPECT_EQ(shipped->studio.subjects[1].mesh, support::shipped_folders().subjects() / "bust.ply");
  std::filesystem::create_directory(folder_.path() / "subjects");
  std::ofstream(folder_.path() / "subjects/bust.ply") << "ply\n";
  const auto own = parse(text);
  ASSERT_TRUE(own.ok());
  EXPECT_EQ(own->studio.subjects[1].mesh, folder_.path() / "subjects/bust.ply");
}

}  // namespace
}  // namespace chiaro::studio
