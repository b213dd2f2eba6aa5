// SPDX-License-Identifier: Apache-2.0
// The state's JSON is a contract with the page, the stagehand and scripts: any change shows here.
#include "controller/panel/state.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/fake_brain.h"

namespace chiaro::panel {
namespace {

using Json = nlohmann::json;

State full_state() {
  State state = support::FakeBrain().state();
  core::FixtureState to;
  to.set(core::Dof::azimuth, core::radians(-47));
  to.set(core::Dof::elevation, core::radians(38));
  to.set(core::Dof::distance, 1.6);
  state.fixtures.resize(1);
  state.fixtures[0].wanted = to;
  state.fixtures[0].instruction = Instruction{"key", "move key", to};
  LookView look;
  look.id = 3;
  look.name = "Rembrandt";
  look.mood = "rembrandt";
  look.verdict = "reached";
  look.verdict_when_placed = "near";
  look.ratio = "4:1 (2 stops)";
  look.light = "820 lx (76 fc)";
  look.nudges = {{"brighter", 0.25}};
  look.advice = {"bring the softbox nearer"};
  look.can_nudge = true;
  look.edition = 2;
  look.fade = 0.5;
  look.reference = "/api/v1/moods/rembrandt/picture";
  look.trials = 4000;
  look.seconds = 0.8;
  state.look = look;
  state.fixtures[0].light = "640 lx (59 fc)";
  state.fixtures[0].lux = 640;
  state.fixtures[0].output_cd = 12000;
  state.fixtures[0].patch = {1, 1, 4};
  state.tried = {1, {{21, 128}}};
  state.design = JobView{5,
                         "rembrandt",
                         "Rembrandt",
                         JobStatus::failed,
                         "",
                         10,
                         20,
                         0.25,
                         1.5,
                         std::nullopt,
                         Refusal{422, "what", "where", "remedy"}};
  state.problems = {{{"a.yaml", 3, 7}, "wrong", "mend it", true}};
  return state;
}

TEST(StateJson, IsAsDocumented) {
  const Json expected = Json::parse(R"json({
    "version": 17,
    "studio": {"name": "portrait", "file": "/studios/portrait.yaml",
               "fingerprint": "00000000000000ff", "ready": true, "stage": ""},
    "hand": {"connected": true, "refused": false, "real_time": false},
    "caution": "normal", "blackout": false,
    "motion": {"stopped": false, "armed": false, "axes_waiting": 0},
    "masters": {"grand": 1.0, "key": 1.0, "fill": 1.0, "back": 1.0, "background": 1.0},
    "look": {"id": 3, "name": "Rembrandt", "mood": "rembrandt", "verdict": "reached",
             "verdict_when_placed": "near", "remedy": "",
             "ratio": "4:1 (2 stops)", "light": "820 lx (76 fc)", "nudges": {"brighter": 0.25},
             "advice": ["bring the softbox nearer"], "can_nudge": true, "kept": false,
             "edition": 2, "fade": 0.5,
             "picture": "/api/v1/looks/3/picture",
             "placed_picture": "/api/v1/looks/3/placed_picture",
             "reference": "/api/v1/moods/rembrandt/picture", "trials": 4000, "seconds": 0.8},
    "design": {"job": 5, "mood": "rembrandt", "title": "Rembrandt", "status": "failed",
               "stage": "", "trial": 10, "trials": 20, "best": 0.25, "seconds": 1.5,
               "lit": false, "look": null, "error": {"what": "what", "where": "where", "remedy": "remedy"}},
    "fixtures": [{"name": "key", "role": "key", "mount": "stand",
      "words": "45° camera left, 35° up, 1.8 m", "level": "50 %, 1.0 stop below full",
      "colour": "4300 K", "light": "640 lx (59 fc)", "lux": 640.0, "output_cd": 12000.0,
      "measured": false, "patch": {"universe": 1, "address": 1, "slots": 4},
      "wanted": {"azimuth_deg": -47.0, "elevation_deg": 38.0, "distance_m": 1.6},
      "placed": {"azimuth_deg": -45.0, "elevation_deg": 35.0, "distance_m": 1.8},
      "sent": {"intensity": 0.5, "cct_k": 4300.0}, "manual": {},
      "limits": {"intensity": [0.0, 0.9], "cct_k": [3200.0, 5600.0], "azimuth_deg": [-80.0, 80.0]},
      "locked": false, "controlled": true,
      "by_hand": ["azimuth_deg", "elevation_deg", "distance_m"],
      "instruction": {"words": "move key",
        "to": {"azimuth_deg": -47.0, "elevation_deg": 38.0, "distance_m": 1.6}}}],
    "instructions": [{"fixture": "key", "words": "move key",
        "to": {"azimuth_deg": -47.0, "elevation_deg": 38.0, "distance_m": 1.6}}],
    "outputs": [{"universe": 1, "health": "good", "rate_hz": 40.0, "frames": 4012, "late": 0,
                 "failed": 0, "missed": 0, "jitter_us_p50": 40.0, "jitter_us_p99": 310.0,
                 "jitter_us_p999": 0.0}],
    "cameras": [{"name": "main", "health": "good", "frames": 120, "reconnects": 0,
                 "picture": "/api/v1/cameras/main/picture",
                 "stream": "/api/v1/cameras/main/stream"}],
    "tried": {"universe": 1, "slots": {"21": 128}},
    "problems": [{"what": "wrong", "where": "a.yaml:3:7", "remedy": "mend it", "warning": true}],
    "can_undo": false})json");
  EXPECT_EQ(Json::parse(state_to_json(full_state())), expected);
}

TEST(StateJson, IsNullWhereThereIsNothing) {
  const Json json = Json::parse(state_to_json(State{}));
  EXPECT_TRUE(json.at("look").is_null());
  EXPECT_TRUE(json.at("design").is_null());
  EXPECT_TRUE(json.at("instructions").empty());
}

TEST(StateJson, WithoutCountersIsEqualWhileOnlyCountersMove) {
  const State before = full_state();
  State after = before;
  after.version = 18;
  after.outputs[0].frames += 40;
  after.outputs[0].jitter_us_p99 = 99;
  after.look->fade = 0.6;
  after.design->trial = 11;
  EXPECT_EQ(state_to_json(before, false), state_to_json(after, false));
  after.blackout = true;
  EXPECT_NE(state_to_json(before, false), state_to_json(after, false));
}

TEST(StateJson, SurvivesNamesThatAreNotUtf8) {
  State state;
  state.file = "/tmp/\xff\xfe.yaml";
  EXPECT_FALSE(Json::parse(state_to_json(state)).at("studio").at("file").empty());
}

TEST(RefusalJson, CarriesEveryProblemOfAFile) {
  Refusal refusal{422, "a", "b", "c", {{{"f", 1, 2}, "x", "y"}, {{"f", 3, 4}, "z", ""}}};
  const Json error = Json::parse(refusal_to_json(refusal)).at("error");
  EXPECT_EQ(error.at("problems").size(), 2u);
  EXPECT_EQ(error.at("problems")[1].at("where"), "f:3:4");
}

}  // namespace
}  // namespace chiaro::panel
