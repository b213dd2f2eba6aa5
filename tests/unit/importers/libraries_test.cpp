// SPDX-License-Identifier: Apache-2.0
// GDTF and Open Fixture Library files of our own making, channel by channel; and hostile ones.
#include <algorithm>
#include <gtest/gtest.h>

#include "controller/importers/gdtf.h"
#include "controller/importers/gdtf_value.h"
#include "controller/importers/import_fixture.h"
#include "controller/importers/ofl.h"
#include "controller/importers/zip.h"
#include "tests/unit/importers/samples.h"

namespace chiaro::importers {
namespace {

using core::Dof;
using studio::Channel;
using studio::ChannelUse;

std::string gdtf_of(const std::string& xml) {
  const auto bytes = zip_of({{"description.xml", xml}});
  EXPECT_TRUE(bytes.ok());
  return bytes.ok() ? *bytes : "";
}
Imported taken(const std::string& bytes, const std::string& ending) {
  const auto made = import_fixture(bytes, ending, "acme", "sample" + ending);
  EXPECT_TRUE(made.ok()) << core::to_string(made.problems());
  return made.ok() ? *made : Imported{};
}
std::string refused(const std::string& bytes, const std::string& ending) {
  const auto made = import_fixture(bytes, ending, "acme", "f" + ending);
  EXPECT_FALSE(made.ok());
  return made.ok() ? "" : core::to_string(made.problems());
}
const Channel& at(const studio::Mode& mode, int slot) {
  for (const Channel& channel : mode.channels)
    if (channel.slot(0) == slot - 1) return channel;
  ADD_FAILURE() << "nothing at slot " << slot;
  return mode.channels.front();
}

TEST(GdtfValue, MirrorsBytesUnlessItIsShifted) {
  EXPECT_EQ(gdtf_value("255/1", 2), 65535u);
  EXPECT_EQ(gdtf_value("255/1s", 2), 65280u);
  EXPECT_EQ(gdtf_value("128/1", 3), 0x808080u);
  EXPECT_EQ(gdtf_value("32768/2", 1), 128u);
  EXPECT_EQ(gdtf_value("4660/2", 3), 0x123412u);
  EXPECT_FALSE(gdtf_value("256/1", 1));
  EXPECT_FALSE(gdtf_value("x/1", 1));
  EXPECT_FALSE(gdtf_value("1/9", 1));
}

TEST(Gdtf, ModeChannelsFollowTheGeometryTree) {
  const studio::Profile profile = taken(gdtf_of(samples::kGdtf), ".gdtf").profile;
  EXPECT_EQ(profile.name, "acme-lights/wash-two");
  ASSERT_EQ(profile.modes.size(), 1u);
  const studio::Mode& mode = profile.modes[0];
  EXPECT_EQ(mode.footprint, 18);
  EXPECT_EQ(at(mode, 1).dof, Dof::pan);
  EXPECT_EQ(at(mode, 1).bytes, 2);
  EXPECT_NEAR(profile.pan.least, core::radians(-270), 1e-9);
  EXPECT_NEAR(profile.tilt.most, core::radians(110), 1e-9);
  EXPECT_EQ(at(mode, 5).dof, Dof::intensity);
  EXPECT_EQ(at(mode, 5).slot(1), 7);  // the fine byte stands apart
  EXPECT_EQ(at(mode, 6).use, ChannelUse::open);
  EXPECT_NEAR(at(mode, 6).constant, 63.0 / 255, 1e-9);
  EXPECT_EQ(at(mode, 7).dof, Dof::zoom);
  EXPECT_NEAR(at(mode, 7).segments[0].physical_from, core::radians(50), 1e-9);
  EXPECT_NEAR(at(mode, 9).constant, 3.0 / 255, 1e-9);
  EXPECT_EQ(at(mode, 11).dof, Dof::red);
  EXPECT_EQ(at(mode, 15).dof, Dof::red);
  EXPECT_EQ(at(mode, 15).use, ChannelUse::repeats);
  EXPECT_EQ(at(mode, 18).dof, Dof::white);
}

TEST(Gdtf, EmittersHaveTheFilesColoursAndDefaultsAreMarked) {
  const studio::Profile profile = taken(gdtf_of(samples::kGdtf), ".gdtf").profile;
  ASSERT_EQ(profile.emitter.primaries.size(), 4u);
  EXPECT_NEAR(profile.emitter.primaries[0].chromaticity.x, 0.708, 0.01);  // from its spectrum
  EXPECT_NEAR(profile.emitter.primaries[1].chromaticity.y, 0.70, 1e-6);   // from its xyY
  EXPECT_NEAR(profile.emitter.primaries[2].chromaticity.x, 0.144, 0.02);  // from its wavelength
  const auto assumed = [&](const std::string& what) {
    return std::count(profile.assumed.begin(), profile.assumed.end(), what) == 1;
  };
  EXPECT_TRUE(assumed("colours"));
  EXPECT_FALSE(assumed("output"));
  EXPECT_FALSE(assumed("beam"));
  EXPECT_NEAR(profile.optic.beam, core::radians(18), 1e-9);

  std::string bare = samples::kGdtf;
  const std::string photometry =
      R"(LuminousFlux="4000" BeamAngle="18" FieldAngle="30" ColorTemperature="6000" )";
  bare.erase(bare.find(photometry), photometry.size());
  const studio::Profile defaulted = taken(gdtf_of(bare), ".gdtf").profile;
  for (const char* what : {"output", "beam"})
    EXPECT_EQ(std::count(defaulted.assumed.begin(), defaulted.assumed.end(), what), 1) << what;
}

TEST(Ofl, TakesFineBytesGapsRangesAndPixels) {
  const studio::Profile profile = taken(samples::kOfl, ".json").profile;
  EXPECT_EQ(profile.name, "acme/bar-three");
  ASSERT_EQ(profile.modes.size(), 2u);
  const studio::Mode& white = profile.modes[0];
  EXPECT_EQ(at(white, 1).bytes, 2);
  EXPECT_EQ(at(white, 1).dof, Dof::intensity);
  EXPECT_EQ(at(white, 5).use, ChannelUse::open);
  EXPECT_NEAR(at(white, 5).constant, 14.5 / 255, 0.003);
  const studio::Mode& pixels = profile.modes[1];
  EXPECT_EQ(pixels.footprint, 11);
  EXPECT_EQ(at(pixels, 3).dof, Dof::red);
  EXPECT_EQ(at(pixels, 6).use, ChannelUse::repeats);
  EXPECT_EQ(at(pixels, 11).dof, Dof::blue);
}

TEST(Gdtf, TheLastOfManyModesHasAllItsPixelsToo) {
  std::string many = samples::kGdtf;
  const std::string head = "<Axis Name=\"Head\">";
  std::string parts;
  for (int i = 0; i < 2000; ++i) parts += "<Geometry Name=\"Part\"/>";
  many.insert(many.find(head) + head.size(), parts);
  const std::size_t begin = many.find("<DMXMode "), end = many.find("</DMXModes>");
  const std::string mode = many.substr(begin, end - begin);
  std::string others;
  for (int i = 0; i < 20; ++i) others += mode;
  many.insert(end, others);
  const auto profile = taken(gdtf_of(many), ".gdtf").profile;
  ASSERT_EQ(profile.modes.size(), 21u);
  EXPECT_EQ(profile.modes.back().channels.size(), profile.modes.front().channels.size());
  EXPECT_EQ(profile.modes.back().footprint, profile.modes.front().footprint);
}

TEST(Hostile, APixelNamedLikeThePlaceOfItsNameEnds) {
  std::string own = samples::kOfl;
  const std::string pixels = R"([[["1", "2", "3"]]])";
  own.replace(own.find(pixels), pixels.size(), R"([[["$pixelKey", "2", "3"]]])");
  EXPECT_TRUE(import_fixture(own, ".json", "acme", "own.json").ok());
}

TEST(Hostile, FilesAreRefusedWithASentence) {
  const std::string good = gdtf_of(samples::kGdtf);
  EXPECT_NE(refused(good.substr(0, good.size() / 2), ".gdtf").find("no whole zip"),
            std::string::npos);
  EXPECT_NE(refused("", ".gdtf").find("no whole zip"), std::string::npos);
  EXPECT_NE(refused(samples::kGdtf, ".gdtf").find("no whole zip"), std::string::npos);
  const auto other = zip_of({{"readme.txt", "hello"}});
  ASSERT_TRUE(other.ok());
  EXPECT_NE(refused(*other, ".gdtf").find("holds no description.xml"), std::string::npos);
  EXPECT_NE(refused(gdtf_of(samples::kGdtf.substr(0, 900)), ".gdtf").find("not whole XML"),
            std::string::npos);
  EXPECT_NE(refused(samples::kOfl.substr(0, 300), ".json").find("not whole JSON"),
            std::string::npos);
  EXPECT_NE(refused(std::string(100000, '['), ".json").find("larger or deeper"), std::string::npos);
  EXPECT_NE(refused("{}", ".json").find("no fixture"), std::string::npos);
  EXPECT_NE(refused("x", ".ies").find("not read from files like this"), std::string::npos);
}

TEST(Hostile, ABombIsNotInflated) {
  const auto bomb = zip_of({{"description.xml", std::string(40u << 20u, ' ')}});
  ASSERT_TRUE(bomb.ok());
  EXPECT_LT(bomb->size(), 1u << 20u);
  EXPECT_NE(refused(*bomb, ".gdtf").find("would be larger than 16 MB"), std::string::npos);
}

TEST(Hostile, AMemberThatClimbsOutOfItsFolderEndsTheReading) {
  for (const char* name : {"../evil", "/etc/passwd", "a/../../b", "C:evil", "..\\evil"}) {
    const auto bytes = zip_of({{"description.xml", samples::kGdtf}, {name, "x"}});
    ASSERT_TRUE(bytes.ok());
    EXPECT_NE(refused(*bytes, ".gdtf").find("outside its folder"), std::string::npos) << name;
  }
}

TEST(Hostile, EntitiesAreNotExpanded) {
  const std::string laughs =
      "<!DOCTYPE x [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;\">]><GDTF><FixtureType "
      "Name=\"&b;\"/></GDTF>";
  EXPECT_NE(refused(gdtf_of(laughs), ".gdtf").find("declares entities"), std::string::npos);
  EXPECT_NE(refused(laughs, ".qxf").find("declares entities"), std::string::npos);
}

TEST(Hostile, AGeometryThatRefersToItselfEnds) {
  std::string loop = samples::kGdtf;
  const std::string beam = "<Beam Name=\"Pixel\"";
  loop.replace(loop.find(beam), beam.size(),
               "<Geometry Name=\"L\"><GeometryReference Geometry=\"L\"/><GeometryReference "
               "Geometry=\"L\"/></Geometry><Beam Name=\"Pixel\"");
  const std::string base = "Geometry=\"Base\"><DMXChannels>";
  loop.replace(loop.find(base), base.size(), "Geometry=\"L\"><DMXChannels>");
  EXPECT_TRUE(import_fixture(gdtf_of(loop), ".gdtf", "", "loop.gdtf").ok());
}

}  // namespace
}  // namespace chiaro::importers
