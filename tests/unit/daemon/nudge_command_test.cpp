// SPDX-License-Identifier: Apache-2.0
// chiaro moods and chiaro nudge, as a person types them, on what is shipped.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::daemon {
namespace {

using ::testing::HasSubstr;

class WordsOfLight : public ::testing::Test {
 protected:
  WordsOfLight() : fake_(clock_, network_, folder_.path()) {
    fake_.world.config_folder = support::shipped_folders().config;
  }
  ports::Exit run(const std::vector<std::string>& arguments) {
    fake_.out.str("");
    fake_.err.str("");
    return run_chiaro(arguments, fake_.world);
  }
  std::string portrait() const {
    return (support::shipped_folders().studios() / "portrait.yaml").string();
  }
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  /// The studio as it stands, key and fill on, as a look.json.
  std::string some_look() {
    const std::string name = file("look.json");
    EXPECT_EQ(run({"design", portrait(), "--mood", "loop", "--trials", "10", "--out", name}),
              ports::Exit::done)
        << fake_.err.str();
    return name;
  }
  std::string first_mood() { return fake_.out.str().substr(0, fake_.out.str().find(',')); }

  support::TemporaryFolder folder_;
  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::FakeWorld fake_;
};

TEST_F(WordsOfLight, FindTheMoodThatAPhotographerMeans) {
  const std::pair<std::vector<std::string>, const char*> asked[] = {
      {{"warm", "night"}, "candlelight"},    {{"cool", "night"}, "moonlight"},
      {{"bright", "airy"}, "high-key"},      {{"from", "below", "scary"}, "horror"},
      {{"sunny", "warm"}, "golden-hour"},    {{"low", "key", "triangle"}, "rembrandt"},
      {{"anonymous", "shape"}, "silhouette"}};
  for (const auto& [words, mood] : asked) {
    std::vector<std::string> arguments{"moods"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    ASSERT_EQ(run(arguments), ports::Exit::done) << fake_.err.str();
    EXPECT_EQ(first_mood(), mood) << fake_.out.str();
  }
}

TEST_F(WordsOfLight, WithoutWordsEveryMoodIsListedWithItsTurnAndTags) {
  ASSERT_EQ(run({"moods"}), ports::Exit::done);
  EXPECT_THAT(fake_.out.str(),
              AllOf(HasSubstr("rembrandt"), HasSubstr("butterfly, mid key, hard, warm"),
                    HasSubstr("turn the sitter 35° to camera left"),
                    HasSubstr("more than the shipped studio can do")));
  ASSERT_EQ(run({"moods", "--json", "warm"}), ports::Exit::done);
  const auto json = nlohmann::json::parse(fake_.out.str());
  EXPECT_GE(json["moods"].size(), 16u);
  EXPECT_GT(json["moods"][0]["qualities"]["warmth"], 0.5);
  EXPECT_EQ(json["moods"][0]["tags"]["colour"], "warm");
}

TEST_F(WordsOfLight, AWordThatNobodyKnowsIsNamed) {
  ASSERT_EQ(run({"moods", "purpel"}), ports::Exit::done);
  EXPECT_THAT(fake_.err.str(), HasSubstr("purpel"));
}

TEST_F(WordsOfLight, WordsThatAreNoUtf8StillGiveOneJsonObject) {
  ASSERT_EQ(run({"moods", "warm \xff", "--json"}), ports::Exit::done) << fake_.err.str();
  const auto json = nlohmann::json::parse(fake_.out.str());
  ASSERT_EQ(json["unknown"].size(), 1u);
  EXPECT_THAT(json["unknown"][0].get<std::string>(), HasSubstr("\uFFFD"));
}

TEST_F(WordsOfLight, NudgeALookAndWriteIt) {
  const std::string look = some_look();
  ASSERT_EQ(run({"nudge", portrait(), look, "a little warmer, brighter", "--lock", "back", "--out",
                 file("new.json"), "--picture", file("new.png")}),
            ports::Exit::done)
      << fake_.err.str();
  EXPECT_THAT(fake_.out.str(), HasSubstr("0.5 stop brighter, 20 mired warmer: "));
  const auto before = nlohmann::json::parse(std::ifstream(look));
  const auto after = nlohmann::json::parse(std::ifstream(file("new.json")));
  const auto value = [](const nlohmann::json& json, const char* lamp, const char* what) {
    return json["fixtures"][lamp]["placed"][what].get<double>();
  };
  EXPECT_GT(value(after, "key", "intensity"), 1.2 * value(before, "key", "intensity"));
  EXPECT_LT(value(after, "key", "cct_k"), value(before, "key", "cct_k") - 300);
  EXPECT_EQ(value(after, "back", "intensity"), value(before, "back", "intensity"));
  EXPECT_EQ(core::read_picture(file("new.png"))->size.height, 256);
}

TEST_F(WordsOfLight, NudgeAsJsonSaysWhatWasAskedAndDone) {
  ASSERT_EQ(run({"nudge", portrait(), some_look(), "softer", "--json"}), ports::Exit::done);
  const auto json = nlohmann::json::parse(fake_.out.str());
  EXPECT_EQ(json["asked"]["softness"], 2);
  EXPECT_THAT(json["by_hand"][0].get<std::string>(), HasSubstr("fit the softbox to key"));
  EXPECT_TRUE(json["look"].contains("fixtures"));
}

TEST_F(WordsOfLight, WhatIsNotUnderstoodIsRefusedWithTheNearestWord) {
  EXPECT_EQ(run({"nudge", portrait(), "no.json", "wamer"}), ports::Exit::input_has_problems);
  EXPECT_THAT(fake_.err.str(), HasSubstr("did you mean \"warmer\""));
  EXPECT_EQ(run({"nudge", portrait(), "no.json", "warmer"}), ports::Exit::input_has_problems);
  EXPECT_THAT(fake_.err.str(), HasSubstr("no.json"));
  EXPECT_EQ(run({"nudge", portrait()}), ports::Exit::usage);
}

}  // namespace
}  // namespace chiaro::daemon
