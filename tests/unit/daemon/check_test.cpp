// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::daemon {
namespace {

class CheckCommand : public ::testing::Test {
 protected:
  CheckCommand() : fake_(clock_, network_, folder_.path()) {
    fake_.world.config_folder = support::shipped_folders().config;
    support::write_full_studio_files(folder_.path());
  }
  ports::Exit run(std::vector<std::string> arguments) {
    fake_.out.str("");
    fake_.err.str("");
    return run_chiaro(arguments, fake_.world);
  }
  std::string written(const std::string& text) const {
    const auto file = folder_.path() / "studio.yaml";
    std::ofstream(file) << text;
    return file.string();
  }
  std::string portrait() const {
    return (support::shipped_folders().studios() / "portrait.yaml").string();
  }
  support::TemporaryFolder folder_;
  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::FakeWorld fake_;
};

TEST_F(CheckCommand, PrintsThePatchSheetOfTheShippedStudio) {
  ASSERT_EQ(run({"check", portrait()}), ports::Exit::done) << fake_.err.str();
  EXPECT_EQ(fake_.err.str(), "");
  const std::string sheet = fake_.out.str();
  EXPECT_NE(sheet.find("key      key         generic/tunable-panel 4ch-16bit  1.001-004  14000 cd, "
                       "bare  stand, 45° camera left, 35° up, 1.80 m\n"),
            std::string::npos)
      << sheet;
  EXPECT_NE(sheet.find("universe 1: sACN on lo at 40 Hz, priority 100\n"), std::string::npos);
}

TEST_F(CheckCommand, JsonIsOneObjectWithEveryFixture) {
  ASSERT_EQ(run({"check", portrait(), "--json"}), ports::Exit::done);
  const auto answer = nlohmann::json::parse(fake_.out.str());
  EXPECT_EQ(answer["ok"], true);
  ASSERT_EQ(answer["fixtures"].size(), 4u);
  EXPECT_EQ(answer["fixtures"][0]["patch"],
            (nlohmann::json{{"universe", 1}, {"address", 1}, {"slots", 4}}));
  EXPECT_EQ(answer["fixtures"][0]["placed"]["azimuth_deg"], -45.0);
  EXPECT_EQ(answer["fixtures"][1]["in_words"], "40° camera right, 10° up, 2.00 m");
}

TEST_F(CheckCommand, ListsEveryProblemWithFileLineAndColumnAndFails) {
  const std::string file = written(
      support::edited(support::edited(support::full_studio_text(), "role: hair", "role: hare"),
                      "iso: 400", "iso: x"));
  EXPECT_EQ(run({"check", file}), ports::Exit::input_has_problems);
  EXPECT_EQ(fake_.out.str(), "");
  const std::string said = fake_.err.str();
  EXPECT_NE(said.find(file + ":27:10: 'iso' is 'x', expected a number, 1 to 1e+07"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find(file + ":52:11: 'role' is 'hare'"), std::string::npos) << said;
  EXPECT_NE(said.find("2 problems\n"), std::string::npos) << said;
}

TEST_F(CheckCommand, JsonListsTheProblemsToo) {
  const std::string file = written("studio: a\n");
  EXPECT_EQ(run({"--json", "check", file}), ports::Exit::input_has_problems);
  const auto answer = nlohmann::json::parse(fake_.out.str());
  EXPECT_EQ(answer["ok"], false);
  ASSERT_EQ(answer["problems"].size(), 3u);
  EXPECT_EQ(answer["problems"][0]["line"], 1);
  EXPECT_EQ(answer["problems"][0]["file"], file);
}

TEST_F(CheckCommand, AMissingFileIsAProblemOfTheInput) {
  EXPECT_EQ(run({"check", "/nowhere.yaml"}), ports::Exit::input_has_problems);
  EXPECT_EQ(fake_.err.str(), "/nowhere.yaml: there is no such file (check the path)\n");
}

TEST_F(CheckCommand, AMeshThatIsCutShortIsFound) {
  const auto mesh = folder_.path() / "short.ply";
  std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 30\n";
  std::ifstream in(portrait());
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::string file =
      written(support::edited(text, "mesh: subjects/bust.ply", "mesh: short.ply"));
  EXPECT_EQ(run({"check", file}), ports::Exit::input_has_problems);
  EXPECT_NE(fake_.err.str().find("short.ply"), std::string::npos) << fake_.err.str();
}

TEST_F(CheckCommand, WithoutAFileItSaysHowItIsUsed) {
  EXPECT_EQ(run({"check"}), ports::Exit::usage);
  EXPECT_NE(fake_.err.str().find("STUDIO"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::daemon
