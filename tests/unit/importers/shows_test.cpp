// SPDX-License-Identifier: Apache-2.0
// Shows of other programs, in and out.
#include <algorithm>
#include <gtest/gtest.h>

#include "controller/importers/show.h"
#include "controller/importers/zip.h"
#include "controller/studio/load.h"
#include "tests/support/studios.h"
#include "tests/unit/importers/samples.h"

namespace chiaro::importers {
namespace {

std::optional<Imported> nobody(const std::string&, const std::string&) { return std::nullopt; }

bool says(const std::vector<std::string>& list, const std::string& words) {
  return std::any_of(list.begin(), list.end(), [&](const std::string& each) {
    return each.find(words) != std::string::npos;
  });
}

TEST(Qxw, DimmersAndScenesComeOverAndTheRestIsListed) {
  const auto show = read_qxw(samples::kQxw, "show.qxw", nobody);
  ASSERT_TRUE(show.ok()) << core::to_string(show.problems());
  ASSERT_EQ(show->lamps.size(), 2u);
  EXPECT_EQ(show->lamps[1].name, "Rack 2");
  EXPECT_EQ(show->lamps[1].universe, 1);
  EXPECT_EQ(show->lamps[1].address, 11);
  ASSERT_EQ(show->scenes.size(), 1u);
  ASSERT_EQ(show->scenes[0].levels.size(), 2u);  // channel 7 is not the rack's
  EXPECT_EQ(show->scenes[0].levels[1].slot, 11);
  EXPECT_EQ(show->scenes[0].levels[1].value, 128);
  EXPECT_TRUE(says(show->left_out, "'Ghost'"));
  EXPECT_TRUE(says(show->left_out, "2 functions of kind Chaser"));
  EXPECT_TRUE(says(show->left_out, "virtual console"));
}

TEST(Qxw, MakesAStudioFileThatLoads) {
  const auto show = read_qxw(samples::kQxw, "show.qxw", nobody);
  ASSERT_TRUE(show.ok());
  const studio::Studio studio = support::studio_from(studio_yaml(*show, "show.qxw"));
  ASSERT_EQ(studio.fixtures.size(), 2u);
  EXPECT_EQ(std::get<studio::DmxPatch>(studio.fixtures[0].patch).address, 10);
}

TEST(Qxw, QlcsOwnSampleLoadsWithTheInstalledLibrary) {
  namespace fs = std::filesystem;
  const auto library = definitions_in("/usr/share/qlcplus/fixtures");
  const auto par = library("Stairville", "LED PAR56");
  ASSERT_TRUE(par) << "install the Debian package qlcplus-data";
  EXPECT_EQ(par->profile.name, "stairville/led-par56");
  EXPECT_FALSE(library("Stairville", "../../passwd"));
  EXPECT_FALSE(library("..", "x"));
}

TEST(Mvr, WhatGoesOutComesBackInItsPlace) {
  const auto gdtf = zip_of({{"description.xml", samples::kGdtf}});
  ASSERT_TRUE(gdtf.ok());
  const std::string scene =
      "<GeneralSceneDescription><Scene><Layers><Layer name=\"L\"><ChildList><GroupObject "
      "name=\"G\">"
      "<Matrix>{1,0,0}{0,1,0}{0,0,1}{1000,0,0}</Matrix><ChildList><Fixture name=\"Wash 1\">"
      "<Matrix>{1,0,0}{0,0,1}{0,-1,0}{500,-2000,3000}</Matrix><GDTFSpec>Wash.gdtf</GDTFSpec>"
      "<GDTFMode>Extended</GDTFMode><Addresses><Address "
      "break=\"0\">519</Address></Addresses></Fixture>"
      "<Fixture name=\"Lost\"><GDTFSpec>No.gdtf</GDTFSpec></Fixture><Truss name=\"T\"/></ChildList>"
      "</GroupObject></ChildList></Layer></Layers></Scene></GeneralSceneDescription>";
  const auto bytes = zip_of({{"GeneralSceneDescription.xml", scene}, {"Wash.gdtf", *gdtf}});
  ASSERT_TRUE(bytes.ok());
  const auto show = read_mvr(*bytes, "show.mvr");
  ASSERT_TRUE(show.ok()) << core::to_string(show.problems());
  ASSERT_EQ(show->lamps.size(), 1u);
  const ShowLamp& lamp = show->lamps[0];
  EXPECT_EQ(lamp.universe, 2);
  EXPECT_EQ(lamp.address, 7);
  EXPECT_TRUE(lamp.has_head);
  ASSERT_TRUE(lamp.at && lamp.direction);
  EXPECT_NEAR(core::distance(*lamp.at, {1.5, -2, 3}), 0, 1e-9);
  EXPECT_NEAR(core::distance(*lamp.direction, {0, 1, 0}), 0, 1e-9);
  EXPECT_TRUE(says(show->left_out, "'Lost'"));
  EXPECT_TRUE(says(show->left_out, "Truss"));
}

TEST(Mvr, AnExportedStudioHasItsLampsAndSaysWhatItLacks) {
  const studio::Studio studio = support::studio_from(support::studio_text(
      support::fixture_line("a", "generic/dimmer", "1ch", 2, 7) +
      "  free: {role: key, profile: generic/rgbw, mode: 4ch, mount: virtual}\n"));
  std::vector<std::string> left_out;
  const core::AimFrame aim = core::aim_frame({0, 0, 1.4}, {0, -2.6, 1.4});
  const auto bytes = mvr_of(studio, aim, left_out);
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(*bytes, *mvr_of(studio, aim, left_out));
  EXPECT_TRUE(says(left_out, "'free'"));
  const auto xml = zip_member(*bytes, "GeneralSceneDescription.xml", 1u << 20u, "x.mvr");
  ASSERT_TRUE(xml.ok());
  EXPECT_NE(xml->find("{-1500.000000,-1500.000000,2200.000000}"), std::string::npos) << *xml;
  EXPECT_NE(xml->find(">519<"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::importers
