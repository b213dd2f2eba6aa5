// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/design/design.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

studio::Studio one_key() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-40), core::radians(30), 2.2}, 3000),
                     support::fixed_lamp("fill", studio::Role::fill, {1.4, -1.6, 1.5}, 2000)};
  return studio;
}

Look some_look(const studio::Studio& studio) {
  Look look;
  look.name = "rembrandt";
  look.goal = "by example, wavelet: rembrandt";
  look.optimiser = "sbplx";
  look.seed = 7;
  look.trials = 1200;
  look.seconds = 0.93;
  look.cost = 4.5;
  look.wanted = look.placed = studio::placed_rig(studio);
  support::stand(look.wanted, 0, -47, 38, 1.6, 0.35);
  look.wanted.states[1].set(core::Dof::intensity, 0.1);
  look.wanted.states[1].set(core::Dof::cct, 4300);
  look.judgement = {Verdict::near, 0.12, "key", 1.25, "key 1⅓ stops short: ISO 400"};
  look.components = {{"mean", 101.5, 99.25}, {"edge", std::nullopt, 0.5}};
  look.instructions = {"move key to 47° camera left, 38° up, 1.6 m from the face"};
  look.warnings = {"back stands where it should not"};
  look.advised_white_balance_k = 4800;
  return look;
}

TEST(LookJson, ComesBackAsItWent) {
  const studio::Studio studio = one_key();
  const Look look = some_look(studio);
  const auto back = look_from_json(studio, look_to_json(studio, look), "look.json");
  ASSERT_TRUE(back.ok()) << core::to_string(back.problems());
  EXPECT_EQ(back->name, look.name);
  EXPECT_EQ(back->goal, look.goal);
  EXPECT_EQ(back->optimiser, "sbplx");
  EXPECT_EQ(back->seed, 7u);
  EXPECT_EQ(back->trials, 1200u);
  EXPECT_DOUBLE_EQ(back->seconds, 0.93);
  EXPECT_EQ(back->judgement.verdict, Verdict::near);
  EXPECT_DOUBLE_EQ(back->judgement.residual, 0.12);
  EXPECT_EQ(back->judgement.limiting_fixture, "key");
  EXPECT_EQ(back->judgement.remedy, look.judgement.remedy);
  EXPECT_EQ(back->instructions, look.instructions);
  EXPECT_EQ(back->warnings, look.warnings);
  EXPECT_EQ(back->advised_white_balance_k, 4800);
  ASSERT_EQ(back->components.size(), 2u);
  EXPECT_EQ(back->components[0].target, 101.5);
  EXPECT_EQ(back->components[1].target, std::nullopt);
  for (std::size_t i = 0; i < 2; ++i)
    for (const core::DofInfo& each : core::dofs()) {
      EXPECT_EQ(back->wanted.states[i].has(each.dof), look.wanted.states[i].has(each.dof));
      EXPECT_NEAR(back->wanted.states[i].get(each.dof), look.wanted.states[i].get(each.dof), 1e-6);
    }
}

TEST(LookJson, CarriesUnitsInItsNamesAndTheTradesWords) {
  const studio::Studio studio = one_key();
  const auto json = nlohmann::json::parse(look_to_json(studio, some_look(studio)));
  const auto& key = json["fixtures"]["key"];
  EXPECT_EQ(key["role"], "key");
  EXPECT_NEAR(key["wanted"]["azimuth_deg"].get<double>(), -47, 1e-6);
  EXPECT_NEAR(key["wanted"]["elevation_deg"].get<double>(), 38, 1e-6);
  EXPECT_EQ(key["wanted"]["distance_m"], 1.6);
  EXPECT_EQ(key["wanted"]["intensity"], 0.35);
  EXPECT_EQ(json["fixtures"]["fill"]["wanted"]["cct_k"], 4300);
  EXPECT_EQ(key["in_words"], "47° camera left, 38° up, 1.6 m, 35 %");
  EXPECT_EQ(json["judgement"]["verdict"], "near");
  EXPECT_EQ(json["studio_fingerprint"], "0000000000c41a20");
}

core::Problems problems_of_text(const std::string& text) {
  const auto look = look_from_json(one_key(), text, "look.json");
  EXPECT_FALSE(look.ok());
  return look.problems();
}

TEST(LookJson, NamesLineAndColumnOfEveryMistake) {
  const auto problems = problems_of_text(
      "{\n"
      "  \"format\": \"chiaro look 1\",\n"
      "  \"fixtures\": {\n"
      "    \"kye\": {},\n"
      "    \"fill\": {\"wanted\": {\"intensty\": 0.3,\n"
      "      \"intensity\": 3, \"cct_k\": \"warm\"}}\n"
      "  }\n"
      "}\n");
  ASSERT_EQ(problems.size(), 4u) << core::to_string(problems);
  EXPECT_EQ(core::to_string(problems[0].where), "look.json:4:5");
  EXPECT_NE(problems[0].remedy.find("key"), std::string::npos);
  EXPECT_EQ(problems[1].where.line, 5);
  EXPECT_NE(problems[1].remedy.find("intensity"), std::string::npos);
  EXPECT_EQ(problems[2].where.line, 6);
  EXPECT_EQ(problems[3].where.line, 6);
}

TEST(LookJson, RefusesWhatIsNoLook) {
  for (const std::string text :
       {"", "{", "[1, 2]", "{\"format\": \"else\"}", "\"text\"", "{\"format\": \"chiaro look 1\"}",
        "{\"format\": \"chiaro look 1\", \"fixtures\": []}", "\x01\xff\xfe", "a: [b"})
    EXPECT_FALSE(problems_of_text(text).empty()) << text;
}

}  // namespace
}  // namespace chiaro::design
