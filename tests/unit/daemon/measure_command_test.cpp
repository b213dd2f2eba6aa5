// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/design/moods.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

/// `chiaro measure …` in a world of its own.
struct Measured {
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld world{clock, network, folder.path()};
  ports::Exit exit = ports::Exit::internal_fault;

  std::string file(const std::string& name) const { return (folder.path() / name).string(); }
  void run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "measure");
    exit = run_chiaro(arguments, world.world);
  }
  std::string picture(core::Size size, std::array<std::uint8_t, 3> left,
                      std::array<std::uint8_t, 3> right) const {
    core::EncodedPicture p(size);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) p.at(x, y) = x < size.width / 2 ? left : right;
    EXPECT_TRUE(core::write_png(file("p.png"), p).ok());
    return file("p.png");
  }
};

TEST(MeasureCommand, PrintsEveryComponentAndTheSpectrumForPeople) {
  Measured m;
  m.run({m.picture({64, 64}, {0, 0, 0}, {255, 255, 255})});
  EXPECT_EQ(m.exit, ports::Exit::done);
  const std::string text = m.world.out.str();
  for (const char* word : {"edge", "mean", "gradient", "variance", "histogram", "contrast",
                           "wavelet", "--studio", "64 x 64"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  EXPECT_TRUE(m.world.err.str().empty()) << m.world.err.str();
}

// [I-29]
TEST(MeasureCommand, TargetsAreWrittenAsDesignReadsThem) {
  Measured m;
  m.run({m.picture({320, 256}, {30, 30, 30}, {220, 220, 220}), "--targets", m.file("t.yaml")});
  ASSERT_EQ(m.exit, ports::Exit::done) << m.world.err.str();
  const auto targets = design::load_targets(m.file("t.yaml"));
  ASSERT_TRUE(targets) << core::to_string(targets.problems());
  EXPECT_FALSE(targets->edge) << "no geometry is known";
  EXPECT_NEAR(targets->mean.value(), (2.55 * 11.3 + 2.55 * 87.6) / 2, 4);
  EXPECT_NEAR(targets->variance.value(), 2.55 * (87.6 - 11.3) / 2, 4);
  ASSERT_TRUE(targets->histogram);
  double sum = 0;
  for (const double share : *targets->histogram) sum += share;
  EXPECT_NEAR(sum, 1, 1e-4);
}

TEST(MeasureCommand, JsonHoldsTheNumbersOfAHalfBlackHalfWhitePicture) {
  Measured m;
  m.run({m.picture({256, 256}, {0, 0, 0}, {255, 255, 255}), "--json"});
  ASSERT_EQ(m.exit, ports::Exit::done);
  const auto json = nlohmann::json::parse(m.world.out.str());
  const auto& c = json["components"];
  EXPECT_NEAR(c["mean"], 127.5, 1e-3);
  EXPECT_NEAR(c["variance"], 127.5, 1e-3);
  EXPECT_DOUBLE_EQ(c["histogram"][0], 0.5);
  EXPECT_DOUBLE_EQ(c["histogram"][255], 0.5);
  EXPECT_TRUE(c["edge"].is_null());
  EXPECT_TRUE(c["contrast"].is_null());
  EXPECT_EQ(json["wavelet"]["first_coefficients"].size(), 64u);
  EXPECT_NEAR(json["wavelet"]["first_coefficients"][0], 127.5, 1e-3);
  EXPECT_NEAR(json["wavelet"]["first_coefficients"][1], -255, 1e-2);  // left minus right
  EXPECT_NEAR(json["wavelet"]["levels"][0]["vertical_rms"], 0, 1e-3);
  EXPECT_EQ(json["wavelet"]["levels"].size(), 8u);
}

TEST(MeasureCommand, WithTheStudioEdgeAndContrastExist) {
  Measured m;
  const auto studio = m.world.world.config_folder / "studios" / "portrait.yaml";
  m.run({m.picture({320, 240}, {30, 30, 30}, {200, 200, 200}), "--studio", studio.string(),
         "--json"});
  ASSERT_EQ(m.exit, ports::Exit::done) << m.world.err.str();
  const auto json = nlohmann::json::parse(m.world.out.str());
  EXPECT_TRUE(json["geometry"]);
  EXPECT_TRUE(json["components"]["edge"].is_number());
  EXPECT_TRUE(json["components"]["contrast"].is_number());
}

TEST(MeasureCommand, APictureOfAnotherShapeIsRefusedWithAReason) {
  Measured m;
  const auto studio = m.world.world.config_folder / "studios" / "portrait.yaml";
  m.run({m.picture({200, 400}, {0, 0, 0}, {9, 9, 9}), "--studio", studio.string()});
  EXPECT_EQ(m.exit, ports::Exit::input_has_problems);
  EXPECT_NE(m.world.err.str().find("200 x 400"), std::string::npos);
  EXPECT_NE(m.world.err.str().find("crop"), std::string::npos);
}

TEST(MeasureCommand, BadPicturesAreProblemsNotCrashes) {
  for (const std::string content : {"", "not a picture", "\x89PNG\r\n\x1a\n"}) {
    Measured m;
    std::ofstream(m.file("bad.png")) << content;
    m.run({m.file("bad.png"), "--json"});
    EXPECT_EQ(m.exit, ports::Exit::input_has_problems);
    EXPECT_NE(m.world.err.str().find("bad.png"), std::string::npos);
    EXPECT_FALSE(nlohmann::json::parse(m.world.out.str())["ok"]);
  }
  Measured m;
  m.run({m.file("absent.png")});
  EXPECT_EQ(m.exit, ports::Exit::input_has_problems);
}

TEST(MeasureCommand, ALookNeedsItsStudio) {
  Measured m;
  m.run({m.picture({8, 8}, {0, 0, 0}, {9, 9, 9}), "--look", "look.json"});
  EXPECT_EQ(m.exit, ports::Exit::usage);
}

TEST(MeasureCommand, ATinyPictureHasNumbersToo) {
  Measured m;
  m.run({m.picture({1, 1}, {0, 0, 0}, {255, 255, 255}), "--json"});
  ASSERT_EQ(m.exit, ports::Exit::done);
  EXPECT_NEAR(nlohmann::json::parse(m.world.out.str())["components"]["mean"], 255, 1e-3);
}

}  // namespace
}  // namespace chiaro::daemon
