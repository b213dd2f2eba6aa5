// SPDX-License-Identifier: Apache-2.0
// What others hear on the wire: the promised levels, and no gap, whoever is killed.
#include <cmath>
#include <csignal>

#include "tests/end_to_end/stage.h"

namespace chiaro::end_to_end {
namespace {

class Wire : public EndToEnd {
 protected:
  void SetUp() override {
    studio_ = write_studio(changes_);
    receiver_ = receiver();
    demo_ = demo(studio_);
    ASSERT_TRUE(eventually([&] {
      const auto now = state();
      return now.is_object() && now["studio"].value("ready", false) &&
             now["hand"].value("connected", false);
    })) << demo_->err();
  }
  /// Applies look.json through the API, without a fade; the id of the look.
  std::int64_t apply(const Json& look) {
    const auto saved = ask("POST", "/api/v1/looks", {{"name", "test"}, {"look", look}});
    EXPECT_TRUE(saved.is_object());
    const auto id = saved.value("id", std::int64_t{0});
    const auto path = "/api/v1/looks/" + std::to_string(id) + "/apply";
    EXPECT_FALSE(ask("POST", path, {{"fade_s", 0}}).is_null());
    return id;
  }
  Json design() {
    const auto file = folder_.path() / "look.json";
    const auto done = chiaro({"design", studio_.string(), "--mood", "rembrandt", "--trials", "100",
                              "--out", file.string()});
    EXPECT_EQ(done.exit, 0) << done.err;
    return Json::parse(content_of(file), nullptr, false);
  }
  std::vector<int> last_levels() {
    const auto heard = packets(*receiver_);
    return heard.empty() ? std::vector<int>() : heard.back()["levels"].get<std::vector<int>>();
  }
  bool brain_answers() { return state().is_object(); }

  std::vector<std::pair<std::string, std::string>> changes_;
  std::filesystem::path studio_;
  std::unique_ptr<Process> receiver_, demo_;
};

int sixteen(const std::vector<int>& levels, std::size_t address) {
  return levels.at(address - 1) * 256 + levels.at(address);
}

/// Whether the wire carries what look.json promises for the places that it wants. The bytes are
/// worked out by hand from config/fixtures: tunable-panel in 4ch-16bit has a linear 16-bit level
/// and a 16-bit CCT from 2000 to 20000 K; the back light one linear 8-bit level; the wall's RGBW
/// has no dimmer of its own, so that each emitter carries the level.
bool carries(const std::vector<int>& levels, const Json& look) {
  if (levels.size() != 512) return false;
  bool all = true;
  const auto near = [&](double seen, double promised) {
    all = all && std::abs(seen - promised) <= 1;
  };
  const auto& fixtures = look["fixtures"];
  for (const auto& [name, address] : {std::pair{"key", 1u}, std::pair{"fill", 5u}}) {
    const auto& wanted = fixtures[name]["wanted"];
    near(sixteen(levels, address), 65535 * wanted.value("intensity", -1.0));
    near(sixteen(levels, address + 2), 65535 * (wanted.value("cct_k", 0.0) - 2000) / 18000);
  }
  near(levels[8], 255 * fixtures["back"]["wanted"].value("intensity", -1.0));
  const auto& wall = fixtures["wall"]["wanted"];
  const char* const emitters[] = {"red", "green", "blue", "white"};
  for (std::size_t i = 0; i < 4; ++i)
    near(levels[10 + i], 255 * wall.value("intensity", -1.0) * wall.value(emitters[i], -1.0));
  return all;
}

/// No light, whatever the colour channels say.
bool is_dark(const std::vector<int>& levels) {
  if (levels.size() != 512) return false;
  int light = sixteen(levels, 1) + sixteen(levels, 5);
  for (std::size_t slot = 9; slot <= 14; ++slot) light += levels[slot - 1];
  return light == 0;
}

/// The shipped studio with its stands nailed down: what look.json wants is where the lamps are.
std::vector<std::pair<std::string, std::string>> nailed_down() {
  const auto stand = [](const std::string& at, const std::string& up) {
    return "mount:\n      stand:\n        at: {" + at +
           "}\n        azimuth: [-80 deg, 80 deg]\n        elevation: [-45 deg, " + up +
           "]\n        distance: [1.2 m, 2.";
  };
  return {{stand("azimuth: -45 deg, elevation: 35 deg, distance: 1.8 m", "70 deg") + "4 m]",
           "mount: {fixed: {at: [-1.04, -1.04, 2.5], aim_at: [0, 0, 1.5]}}"},
          {stand("azimuth: 40 deg, elevation: 10 deg, distance: 2.0 m", "60 deg") + "6 m]",
           "mount: {fixed: {at: [1.27, -1.5, 1.85], aim_at: [0, 0, 1.5]}}"}};
}

class WireOfFixedLamps : public Wire {
 protected:
  WireOfFixedLamps() { changes_ = nailed_down(); }
};

TEST_F(WireOfFixedLamps, OthersHearTheLevelsThatTheLookPromises) {
  const auto look = design();
  apply(look);
  EXPECT_TRUE(eventually([&] { return carries(last_levels(), look); }, 60))
      << look.dump(1) << "\n"
      << Json(last_levels()).dump();
  for (const auto& packet : packets(*receiver_)) {
    EXPECT_FALSE(packet.contains("problem")) << packet.dump();
    EXPECT_EQ(packet.value("priority", 0), 100);
  }
}

TEST_F(Wire, KillingTheBrainLeavesTheSequenceUnbrokenAndItReturnsWithTheSameLook) {
  apply(design());
  ASSERT_TRUE(eventually([&] {
    const auto now = state();
    return now.is_object() && now["instructions"].empty() && now["look"].is_object() &&
           now["look"].value("name", "") == "test" && now["look"].value("fade", 0.0) >= 1;
  })) << demo_->err();
  const auto before = state();
  const auto levels = last_levels();
  const auto heard_before = packets(*receiver_).size();
  const pid_t brain = child_of(demo_->pid(), "chiarod");
  ASSERT_GT(brain, 0);
  ASSERT_EQ(::kill(brain, SIGKILL), 0);
  ASSERT_TRUE(eventually([&] {
    const pid_t next = child_of(demo_->pid(), "chiarod");
    return next > 0 && next != brain && brain_answers() && state()["studio"].value("ready", false);
  })) << demo_->err();
  const auto after = state();
  EXPECT_EQ(after["look"].value("name", "?"), before["look"].value("name", ""));
  EXPECT_EQ(after["look"].value("id", -1), before["look"].value("id", 0));
  ASSERT_TRUE(eventually([&] { return packets(*receiver_).size() > heard_before + 120; }));
  const auto heard = packets(*receiver_);
  for (std::size_t i = 1; i < heard.size(); ++i) {
    ASSERT_TRUE(heard[i].contains("sequence")) << heard[i].dump();
    EXPECT_EQ(heard[i]["sequence"].get<int>(), (heard[i - 1]["sequence"].get<int>() + 1) % 256);
    EXPECT_EQ(heard[i]["cid"], heard[0]["cid"]);
  }
  for (std::size_t i = heard_before; i < heard.size(); ++i)
    ASSERT_EQ(heard[i]["levels"].get<std::vector<int>>(), levels) << "packet " << i;
}

TEST_F(Wire, ABrainThatIsStoppedAndContinuedChangesNothing) {
  apply(design());
  ASSERT_TRUE(eventually([&] {
    const auto now = state();
    return now.is_object() && now["instructions"].empty() && now["look"].is_object() &&
           now["look"].value("fade", 0.0) >= 1;
  })) << demo_->err();
  const auto levels = last_levels();
  const auto before = packets(*receiver_).size();
  const pid_t brain = child_of(demo_->pid(), "chiarod");
  ASSERT_GT(brain, 0);
  ASSERT_EQ(::kill(brain, SIGSTOP), 0);
  // Longer than the second after which the hand counts it as silent.
  ASSERT_TRUE(eventually([&] { return packets(*receiver_).size() > before + 100; }));
  ASSERT_EQ(::kill(brain, SIGCONT), 0);
  ASSERT_TRUE(eventually([&] { return brain_answers(); }));
  const auto continued = packets(*receiver_).size();
  ASSERT_TRUE(eventually([&] { return packets(*receiver_).size() > continued + 60; }));
  const auto heard = packets(*receiver_);
  for (std::size_t i = before; i < heard.size(); ++i) {
    ASSERT_TRUE(heard[i].contains("sequence")) << heard[i].dump();
    EXPECT_EQ(heard[i]["sequence"].get<int>(), (heard[i - 1]["sequence"].get<int>() + 1) % 256);
    ASSERT_EQ(heard[i]["levels"].get<std::vector<int>>(), levels) << "packet " << i;
  }
}

TEST_F(Wire, BlackoutWorksWithTheBrainDead) {
  apply(design());
  ASSERT_TRUE(eventually([&] {
    const auto levels = last_levels();
    return levels.size() == 512 && levels[0] > 0;
  }));
  ASSERT_EQ(::kill(demo_->pid(), SIGSTOP), 0);  // the supervisor cannot bring the brain back
  const pid_t brain = child_of(demo_->pid(), "chiarod");
  ASSERT_EQ(::kill(brain, SIGKILL), 0);
  environment_["CHIARO_RUNTIME"] += "/demo";
  EXPECT_EQ(chiaro({"blackout", "on"}).exit, 0);
  EXPECT_TRUE(eventually([&] { return is_dark(last_levels()); }, 20))
      << Json(last_levels()).dump().substr(0, 80);
  ::kill(demo_->pid(), SIGCONT);
}

TEST_F(Wire, EndingTheDemoEndsEverythingAndSaysGoodbyeOnTheWire) {
  const pid_t hand = child_of(demo_->pid(), "chiaro-output");
  ASSERT_GT(hand, 0);
  EXPECT_EQ(demo_->stop(), 0) << demo_->err();
  EXPECT_EQ(::kill(hand, 0), -1);
  ASSERT_TRUE(eventually(
      [&] {
        const auto heard = packets(*receiver_);
        std::size_t goodbyes = 0;
        for (const auto& packet : heard) goodbyes += packet.value("terminated", false);
        return goodbyes == 3;
      },
      20));
}

}  // namespace
}  // namespace chiaro::end_to_end
