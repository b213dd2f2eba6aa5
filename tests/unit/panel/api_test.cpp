// SPDX-License-Identifier: Apache-2.0
// The API's contract, route by route, with input as it should be and as it should not.
#include "controller/panel/api.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/fake_brain.h"

namespace chiaro::panel {
namespace {

using Json = nlohmann::json;
using support::FakeBrain;

class ApiTest : public testing::Test {
 protected:
  Response ask(const std::string& method, const std::string& path, const std::string& body = "") {
    Request request;
    request.method = method;
    request.path = path;
    request.body = body;
    return send(request);
  }
  Response send(const Request& request) {
    Response given;
    int times = 0;
    answer(request, brain, [&](Response response) {
      given = std::move(response);
      ++times;
    });
    EXPECT_EQ(times, brain.answers ? 1 : 0);
    return given;
  }
  /// The refusal's three fields must be there and say something.
  Json refused(const Response& response, int status) {
    EXPECT_EQ(response.status, status) << response.body;
    const Json error = Json::parse(response.body).at("error");
    EXPECT_FALSE(error.at("what").get<std::string>().empty());
    EXPECT_FALSE(error.at("remedy").get<std::string>().empty());
    EXPECT_TRUE(error.contains("where"));
    EXPECT_TRUE(brain.gestures.empty()) << "a refused request must change nothing";
    return error;
  }
  template <class Wish>
  const Wish& wish() {
    static const Wish kNone{};
    EXPECT_EQ(brain.gestures.size(), 1u);
    const auto* found =
        brain.gestures.empty() ? nullptr : std::get_if<Wish>(&brain.gestures.back());
    EXPECT_NE(found, nullptr);
    return found ? *found : kNone;
  }
  FakeBrain brain;
};

TEST_F(ApiTest, GivesTheStateOnce) {
  const Response response = ask("GET", "/api/v1/state");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(Json::parse(response.body).at("fixtures").size(), 3u);
}

TEST_F(ApiTest, ListsMoodsWithTheirPictures) {
  const Json moods = Json::parse(ask("GET", "/api/v1/moods").body).at("moods");
  EXPECT_EQ(moods[0].at("name"), "rembrandt");
  EXPECT_EQ(moods[0].at("picture"), "/api/v1/moods/rembrandt/picture");
  EXPECT_EQ(ask("GET", "/api/v1/moods/rembrandt/picture").type, "image/png");
  refused(ask("GET", "/api/v1/moods/rembrant/picture"), 404);
}

TEST_F(ApiTest, ListsLooks) {
  EXPECT_EQ(Json::parse(ask("GET", "/api/v1/looks").body).at("looks")[0].at("id"), 3);
}

TEST_F(ApiTest, StartsADesignThatAppliesItself) {
  brain.outcome = {{}, 202, R"({"job":9})"};
  const Response response = ask("POST", "/api/v1/design",
                                R"({"mood":"rembrandt","goal":"perceptual","seed":7,
                                    "budget_s":2,"lock":["fill"],"apply":1.5})");
  EXPECT_EQ(response.status, 202);
  EXPECT_EQ(Json::parse(response.body).at("job"), 9);
  const auto& design = wish<StartDesign>();
  EXPECT_EQ(design.mood, "rembrandt");
  EXPECT_EQ(design.title, "Rembrandt");
  EXPECT_FALSE(design.wavelet);
  EXPECT_EQ(design.seed, 7u);
  EXPECT_EQ(design.budget_s, 2.0);
  EXPECT_EQ(design.lock, std::vector<std::string>{"fill"});
  EXPECT_EQ(design.apply_fade_s, 1.5);
}

TEST_F(ApiTest, NamesTheNearestMoodForOneItDoesNotKnow) {
  const Json error = refused(ask("POST", "/api/v1/design", R"({"mood":"rembrant"})"), 404);
  EXPECT_EQ(error.at("remedy"), "did you mean 'rembrandt'?");
}

TEST_F(ApiTest, TakesAnUploadedPictureAsExemplar) {
  const std::string png = support::small_png();
  ask("POST", "/api/v1/design",
      Json({{"exemplar", "data:image/png;base64," + support::base64(png)}, {"title", "Window"}})
          .dump());
  EXPECT_EQ(wish<StartDesign>().picture, png);
  EXPECT_EQ(wish<StartDesign>().title, "Window");
}

TEST_F(ApiTest, RefusesAnExemplarThatIsNoPicture) {
  refused(ask("POST", "/api/v1/design", R"({"exemplar":"aGVsbG8gd29ybGQ="})"), 422);
  refused(ask("POST", "/api/v1/design", R"({"exemplar":"***"})"), 400);
  refused(ask("POST", "/api/v1/design", R"({"exemplar":""})"), 422);
  const std::string text = "no picture at all, however long it is";
  refused(ask("POST", "/api/v1/design", Json({{"exemplar", support::base64(text)}}).dump()), 422);
}

TEST_F(ApiTest, WantsExactlyOneSourceForADesign) {
  refused(ask("POST", "/api/v1/design", "{}"), 400);
  refused(ask("POST", "/api/v1/design", ""), 400);
  refused(ask("POST", "/api/v1/design", R"({"mood":"split","ideal":true})"), 400);
  ask("POST", "/api/v1/design", R"({"ideal":true})");
  EXPECT_TRUE(wish<StartDesign>().ideal);
}

TEST_F(ApiTest, RefusesDesignsThatSayImpossibleThings) {
  const auto with = [&](const std::string& more) {
    return ask("POST", "/api/v1/design", R"({"mood":"split",)" + more + "}");
  };
  refused(with(R"("goal":"wavelets")"), 422);
  refused(with(R"("seed":-1)"), 400);
  refused(with(R"("seed":1.5)"), 400);
  refused(with(R"("budget_s":0)"), 422);
  refused(with(R"("budget_s":"2 s")"), 400);
  refused(with(R"("budget_s":1e999)"), 400);
  refused(with(R"("apply":-1)"), 422);
  refused(with(R"("lock":"key")"), 400);
  EXPECT_EQ(refused(with(R"("lock":["keyy"])"), 404).at("remedy"), "did you mean 'key'?");
  EXPECT_EQ(refused(with(R"("sed":1)"), 400).at("remedy"), "did you mean 'seed'?");
}

TEST_F(ApiTest, RefusesBodiesThatAreNoJsonObject) {
  refused(ask("POST", "/api/v1/design", "{\"mood\":"), 400);
  refused(ask("POST", "/api/v1/design", "[1,2]"), 400);
  refused(ask("POST", "/api/v1/blackout", "true"), 400);
  refused(ask("POST", "/api/v1/blackout", "\xff\xfe"), 400);
  refused(ask("POST", "/api/v1/design", std::string(100000, '[')), 400);
}

TEST_F(ApiTest, CancelsAJob) {
  ask("DELETE", "/api/v1/design/12");
  EXPECT_EQ(wish<CancelDesign>().job, 12u);
  brain.gestures.clear();
  refused(ask("DELETE", "/api/v1/design/twelve"), 404);
  refused(ask("DELETE", "/api/v1/design/-1"), 404);
  refused(ask("DELETE", "/api/v1/design/99999999999999999999999"), 404);
}

TEST_F(ApiTest, AppliesSavesAndDeletesLooks) {
  ask("POST", "/api/v1/looks/3/apply", R"({"fade_s":0.5})");
  EXPECT_EQ(wish<ApplyLook>().id, 3);
  EXPECT_EQ(wish<ApplyLook>().fade_s, 0.5);
  brain.gestures.clear();
  ask("POST", "/api/v1/looks", R"({"name":"Anna"})");
  EXPECT_EQ(wish<SaveLook>().name, "Anna");
  brain.gestures.clear();
  ask("POST", "/api/v1/looks", R"({"look":{"name":"x"}})");
  EXPECT_EQ(wish<SaveLook>().look_json, R"({"name":"x"})");
  brain.gestures.clear();
  ask("DELETE", "/api/v1/looks/3");
  EXPECT_EQ(wish<DeleteLook>().id, 3);
  brain.gestures.clear();
  refused(ask("POST", "/api/v1/looks", "{}"), 400);
  refused(ask("POST", "/api/v1/looks", R"({"look":"text"})"), 400);
  refused(ask("POST", "/api/v1/looks/x/apply"), 404);
  refused(ask("POST", "/api/v1/looks/3/apply", R"({"fade_s":601})"), 422);
  refused(ask("POST", "/api/v1/looks/99999999999999999999/apply"), 404);
}

TEST_F(ApiTest, SetsAFixtureByHandInPeoplesUnits) {
  ask("PUT", "/api/v1/fixtures/key", R"({"intensity":0.25,"cct_k":4300,"lock":true})");
  const auto& set = wish<SetFixture>();
  EXPECT_EQ(set.fixture, "key");
  EXPECT_EQ(set.set.get(core::Dof::intensity), 0.25);
  EXPECT_EQ(set.set.get(core::Dof::cct), 4300);
  EXPECT_EQ(set.lock, true);
}

TEST_F(ApiTest, GivesFadersBack) {
  ask("PUT", "/api/v1/fixtures/key", R"({"intensity":null})");
  EXPECT_EQ(wish<SetFixture>().release, std::vector<core::Dof>{core::Dof::intensity});
  brain.gestures.clear();
  ask("PUT", "/api/v1/fixtures/key", R"({"release":true})");
  EXPECT_EQ(wish<SetFixture>().release.size(), core::kDofs);
}

TEST_F(ApiTest, HoldsFadersWithinTheFixturesLimits) {
  refused(ask("PUT", "/api/v1/fixtures/key", R"({"intensity":0.91})"), 422);
  refused(ask("PUT", "/api/v1/fixtures/key", R"({"intensity":-0.1})"), 422);
  refused(ask("PUT", "/api/v1/fixtures/key", R"({"cct_k":9000})"), 422);
  refused(ask("PUT", "/api/v1/fixtures/key", R"({"intensity":"full"})"), 400);
  EXPECT_EQ(refused(ask("PUT", "/api/v1/fixtures/key", R"({"intensty":1})"), 400).at("remedy"),
            "did you mean 'intensity'?");
}

TEST_F(ApiTest, DoesNotPretendToMoveWhatAPersonMoves) {
  refused(ask("PUT", "/api/v1/fixtures/key", R"({"azimuth_deg":10})"), 422);
}

TEST_F(ApiTest, LeavesUncontrolledFixturesAlone) {
  refused(ask("PUT", "/api/v1/fixtures/lamp", R"({"intensity":0.5})"), 422);
}

TEST_F(ApiTest, NamesTheNearestFixture) {
  EXPECT_EQ(refused(ask("PUT", "/api/v1/fixtures/fil", "{}"), 404).at("remedy"),
            "did you mean 'fill'?");
}

TEST_F(ApiTest, TakesWhereAStandWasPut) {
  ask("POST", "/api/v1/fixtures/key/placed", R"({"azimuth_deg":-47,"elevation_deg":38})");
  const auto& placed = wish<Placed>();
  EXPECT_NEAR(placed.at.get(core::Dof::azimuth), core::radians(-47), 1e-12);
  EXPECT_FALSE(placed.at.has(core::Dof::distance));
  brain.gestures.clear();
  ask("POST", "/api/v1/fixtures/key/placed", "{}");
  EXPECT_EQ(wish<Placed>().at.present(), 0u);
  brain.gestures.clear();
  refused(ask("POST", "/api/v1/fixtures/key/placed", R"({"azimuth_deg":400})"), 422);
  refused(ask("POST", "/api/v1/fixtures/key/placed", R"({"distance_m":0})"), 422);
  refused(ask("POST", "/api/v1/fixtures/key/placed", R"({"intensity":1})"), 400);
  refused(ask("POST", "/api/v1/fixtures/fill/placed", "{}"), 422);
}

TEST_F(ApiTest, TakesAMetersReadingAsTheMeterShowsIt) {
  ask("POST", "/api/v1/fixtures/key/measured", R"({"reading":"39 fc","distance_m":1.8})");
  EXPECT_NEAR(wish<Measured>().lux.value_or(0), 39 * 10.7639, 0.1);
  EXPECT_EQ(wish<Measured>().distance_m, 1.8);
  brain.gestures.clear();
  ask("POST", "/api/v1/fixtures/key/measured", R"({"lux":420})");
  EXPECT_EQ(wish<Measured>().lux, 420);
  brain.gestures.clear();
  ask("POST", "/api/v1/fixtures/key/measured", R"({"forget":true})");
  EXPECT_FALSE(wish<Measured>().lux);
  brain.gestures.clear();
  refused(ask("POST", "/api/v1/fixtures/key/measured", R"({"reading":"bright"})"), 422);
  refused(ask("POST", "/api/v1/fixtures/key/measured", R"({"lux":-1})"), 422);
  refused(ask("POST", "/api/v1/fixtures/key/measured", "{}"), 400);
}

TEST_F(ApiTest, RaisesOnlySlotsThatNoLampHas) {
  brain.state_.fixtures[0].patch = {1, 1, 4};
  ask("PUT", "/api/v1/kit/slots", R"({"universe":1,"slots":{"21":128,"22":0}})");
  const auto& tried = wish<TrySlots>();
  ASSERT_EQ(tried.levels.size(), 2u);
  EXPECT_EQ(tried.levels[0], (std::pair<std::uint16_t, std::uint8_t>{21, 128}));
  brain.gestures.clear();
  const auto with = [&](const std::string& slots) {
    return ask("PUT", "/api/v1/kit/slots", R"({"universe":1,"slots":)" + slots + "}");
  };
  EXPECT_EQ(refused(with(R"({"4":128})"), 409).at("what"), "slot 4 belongs to 'key'");
  refused(with(R"({"0":128})"), 422);
  refused(with(R"({"513":128})"), 422);
  refused(with(R"({"21":256})"), 422);
  refused(with(R"({"21":0.5})"), 422);
  refused(with("[]"), 400);
  refused(ask("PUT", "/api/v1/kit/slots", R"({"universe":9,"slots":{"21":1}})"), 422);
  ask("DELETE", "/api/v1/kit/slots");
  EXPECT_TRUE(wish<TrySlots>().levels.empty());
}

TEST_F(ApiTest, LearnsALampOfWhatAPersonSaw) {
  const auto with = [&](const std::string& more) {
    return ask("POST", "/api/v1/kit", R"({"name":"old panel","universe":1,)" + more + "}");
  };
  with(R"("address":21,"slots":[{"sees":"dimmer"},{"sees":"keep","level":40}],"add":true)");
  const auto& lamp = wish<LearnLamp>();
  ASSERT_EQ(lamp.slots.size(), 2u);
  EXPECT_EQ(lamp.slots[1].level, 40);
  EXPECT_TRUE(lamp.add);
  brain.gestures.clear();
  refused(with(R"("slots":[])"), 400);
  refused(with(R"("slots":[{"sees":"sparks"}])"), 422);
  refused(with(R"("slots":[{"saw":"dimmer"}])"), 400);
  refused(with(R"("slots":[{"sees":"dimmer"}],"held":"crane")"), 422);
  brain.state_.fixtures[0].patch = {1, 1, 4};
  refused(with(R"("address":3,"slots":[{"sees":"dimmer"}])"), 409);
  brain.state_.fixtures[0].patch = {1, 22, 4};
  refused(with(R"("address":21,"slots":[{"sees":"dimmer"}],"held":"arc")"), 409);
  with(R"("address":21,"slots":[{"sees":"dimmer"}],"held":"hung")");
  EXPECT_EQ(wish<LearnLamp>().held, "hung");
}

TEST_F(ApiTest, ShowsEverySlotAndWhoseItIs) {
  brain.state_.outputs[0].slots[4] = 200;
  brain.state_.fixtures[1].patch = {1, 5, 2};
  const Json slots = Json::parse(ask("GET", "/api/v1/outputs/1/slots").body);
  EXPECT_EQ(slots.at("slots").size(), 512u);
  EXPECT_EQ(slots.at("slots")[4], 200);
  EXPECT_EQ(slots.at("owners")[0], Json({{"fixture", "fill"}, {"first", 5}, {"last", 6}}));
  refused(ask("GET", "/api/v1/outputs/9/slots"), 404);
}

TEST_F(ApiTest, SetsMasters) {
  ask("PUT", "/api/v1/masters/back", R"({"level":0.5})");
  EXPECT_EQ(wish<SetMaster>().master, 3u);
  EXPECT_EQ(wish<SetMaster>().level, 0.5);
  brain.gestures.clear();
  refused(ask("PUT", "/api/v1/masters/grant", R"({"level":0.5})"), 404);
  refused(ask("PUT", "/api/v1/masters/back", R"({"level":1.01})"), 422);
  refused(ask("PUT", "/api/v1/masters/back", "{}"), 400);
}

TEST_F(ApiTest, AnswersABlackoutOnlyWhenTheBrainDoes) {
  brain.answers = false;
  bool answered = false;
  Request request;
  request.method = "POST";
  request.path = "/api/v1/blackout";
  request.body = R"({"on":true})";
  answer(request, brain, [&](const Response& response) {
    answered = true;
    EXPECT_EQ(response.status, 200);
  });
  EXPECT_FALSE(answered);
  EXPECT_TRUE(wish<Blackout>().on);
  brain.waiting.front()({});
  EXPECT_TRUE(answered);
}

TEST_F(ApiTest, RefusesABlackoutThatDoesNotSayWhich) {
  refused(ask("POST", "/api/v1/blackout", "{}"), 400);
  refused(ask("POST", "/api/v1/blackout", R"({"on":"yes"})"), 400);
  refused(ask("GET", "/api/v1/blackout"), 405);
}

TEST_F(ApiTest, PassesTheBrainsRefusalOn) {
  brain.outcome.refused = Refusal{503, "no hand", "blackout", "start it"};
  const Response response = ask("POST", "/api/v1/blackout", R"({"on":true})");
  EXPECT_EQ(response.status, 503);
  EXPECT_EQ(Json::parse(response.body).at("error").at("what"), "no hand");
}

TEST_F(ApiTest, CarriesTheOtherGestures) {
  ask("POST", "/api/v1/undo", "");
  EXPECT_EQ(wish<Undo>().fade_s, 1.5);
  brain.gestures.clear();
  ask("POST", "/api/v1/studio/reload");
  wish<Reload>();
  brain.gestures.clear();
  ask("POST", "/api/v1/motion-stop", R"({"on":false})");
  EXPECT_FALSE(wish<MotionStop>().on);
  brain.gestures.clear();
  refused(ask("POST", "/api/v1/studio/reload", R"({"now":1})"), 400);
  refused(ask("POST", "/api/v1/motion-stop", "{}"), 400);
}

TEST_F(ApiTest, TakesAMoodAsAForm) {
  Request request;
  request.method = "POST";
  request.path = "/api/v1/moods";
  request.headers["content-type"] = "multipart/form-data; boundary=\"xyz\"";
  const auto form = [](const std::string& name, const std::string& picture) {
    return "--xyz\r\nContent-Disposition: form-data; name=\"name\"\r\n\r\n" + name +
           "\r\n--xyz\r\nContent-Disposition: form-data; name=\"picture\"; "
           "filename=\"a.png\"\r\nContent-Type: image/png\r\n\r\n" +
           picture + "\r\n--xyz--\r\n";
  };
  request.body = form("window", support::small_png());
  send(request);
  EXPECT_EQ(wish<AddMood>().name, "window");
  EXPECT_EQ(wish<AddMood>().picture, support::small_png());
  brain.gestures.clear();
  request.body = form("../etc", support::small_png());
  refused(send(request), 422);
  request.body = form("window", "not a picture");
  refused(send(request), 422);
  request.body = form("window", "x").substr(0, 60);
  refused(send(request), 400);
  request.headers.clear();
  refused(send(request), 400);
}

TEST_F(ApiTest, RemovesOwnMoodsOnly) {
  ask("DELETE", "/api/v1/moods/window");
  EXPECT_EQ(wish<RemoveMood>().name, "window");
  brain.gestures.clear();
  refused(ask("DELETE", "/api/v1/moods/split"), 422);
  refused(ask("DELETE", "/api/v1/moods/nothing-like-it"), 404);
}

TEST_F(ApiTest, SaysWhichMethodAnAddressTakes) {
  EXPECT_EQ(refused(ask("PATCH", "/api/v1/fixtures/key", "{}"), 405).at("remedy"), "use PUT");
  refused(ask("GET", "/api/v1/undo"), 405);
}

TEST_F(ApiTest, KnowsNothingElse) {
  refused(ask("GET", "/api/v1/rigs"), 404);
  refused(ask("GET", "/api/v2/state"), 404);
  refused(ask("POST", "/api/v1/fixtures/key/placed/now", "{}"), 404);
  refused(ask("GET", "/api/v1/looks/abc/picture"), 404);
  refused(ask("GET", "/api/v1/cameras/maim/picture"), 404);
}

TEST_F(ApiTest, PrintsMetricsThatPrometheusReads) {
  const Response response = ask("GET", "/metrics");
  EXPECT_TRUE(response.type.starts_with("text/plain; version=0.0.4"));
  EXPECT_NE(response.body.find("chiaro_output_frames_total{universe=\"1\"} 4012\n"),
            std::string::npos);
  EXPECT_NE(response.body.find("# TYPE chiaro_output_jitter_seconds summary\n"), std::string::npos);
  EXPECT_NE(response.body.find("quantile=\"0.99\"} 0.00031\n"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::panel
