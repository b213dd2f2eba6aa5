// SPDX-License-Identifier: Apache-2.0
// The brain without sockets: its planner is real, its clock is the test's, and the hand is the
// other end of the boxes or nobody.
#include "controller/daemon/brain/brain.h"

#include <condition_variable>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/panel/gestures.h"
#include "tests/support/fake_brain.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

/// What the loop would run, run by the test.
class Queue {
 public:
  void post(std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    work_.push_back(std::move(work));
    changed_.notify_all();
  }
  /// One piece of work, waited for.
  void run_one() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !work_.empty(); });
    const auto work = std::move(work_.front());
    work_.pop_front();
    lock.unlock();
    work();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> work_;
};

constexpr const char* kStudio = R"(studio: test
subject: {mesh: box.obj, height: 0.6 m, at: [0, 0, 1]}
background:
  - {plane: wall, through: [0, 2, 0], normal: [0, -1, 0], size: [6, 4], diffuse: [0.3, 0.3, 0.3]}
cameras:
  main: {at: [0, -2.6, 1.3], look_at: [0, 0, 1.3], vertical_fov: 20 deg, size: [64, 48]}
fixtures:
  key:
    role: key
    profile: generic/bicolour-panel
    mode: 4ch-16bit
    mount:
      stand:
        at: {azimuth: -45 deg, elevation: 35 deg, distance: 1.8 m}
        azimuth: [-80 deg, 80 deg]
        elevation: [-10 deg, 60 deg]
        distance: [1.2 m, 2.4 m]
    patch: {universe: 1, address: 1}
  back:
    role: back
    profile: generic/daylight-dimmer
    mode: 1ch
    mount: {fixed: {at: [-0.8, 1.1, 2.3], aim_at: [0, 0, 1.3]}}
    patch: {universe: 1, address: 9}
outputs:
  universe 1: {sacn: {interface: lo, rate: 40 Hz}}
exposure: {grey_card: 800 lx, white_balance: 5600 K}
)";

constexpr const char* kBox = R"(v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v -1 -1 3
v 1 -1 3
v 1 1 3
v -1 1 3
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
f 5 6 7 8
f 4 3 2 1
)";

class BrainTest : public testing::Test {
 protected:
  BrainTest() {
    std::ofstream(folder_.path() / "studio.yaml") << kStudio;
    std::ofstream(folder_.path() / "box.obj") << kBox;
  }
  void open() {
    brain_.reset();
    auto brain = Brain::open(fake_.world, folder_.path() / "studio.yaml",
                             [this](std::function<void()> work) { queue_.post(std::move(work)); });
    ASSERT_TRUE(brain) << core::to_string(brain.problems());
    brain_ = std::move(*brain);
    brain_->tick(clock_.now());
  }
  panel::Outcome perform(const panel::Gesture& gesture) {
    std::optional<panel::Outcome> outcome;
    brain_->perform(gesture, [&](panel::Outcome given) { outcome = std::move(given); });
    EXPECT_TRUE(outcome) << "this gesture is answered at once";
    brain_->tick(clock_.now());
    return outcome.value_or(panel::Outcome{});
  }
  /// A small design like a picture that is bright on the left.
  panel::StartDesign like_a_picture(std::optional<double> apply = 0.0) {
    panel::StartDesign ask;
    core::EncodedPicture picture({32, 32});
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        picture.at(x, y) = {static_cast<std::uint8_t>(200 - 5 * x), 120, 90};
    const auto png = core::encode_png(picture);
    ask.picture.assign(png.begin(), png.end());
    ask.title = "Window";
    ask.trials = 20;
    ask.apply_fade_s = apply;
    return ask;
  }
  /// Runs what workers hand in until `enough`.
  template <class Enough>
  void settle(Enough enough) {
    for (brain_->tick(clock_.now()); !enough(brain_->state()); brain_->tick(clock_.now()))
      queue_.run_one();
  }
  void design(const panel::StartDesign& ask) {
    EXPECT_EQ(perform(ask).status, 202);
    settle([](const panel::State& state) {
      return state.design && state.design->status > panel::JobStatus::running;
    });
    ASSERT_EQ(brain_->state().design->status, panel::JobStatus::done)
        << (brain_->state().design->error ? brain_->state().design->error->what : "");
  }
  const panel::FixtureView& key() { return brain_->state().fixtures[0]; }

  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::TemporaryFolder folder_;
  support::FakeWorld fake_{clock_, network_, folder_.path()};
  Queue queue_;
  std::unique_ptr<Brain> brain_;
};

TEST_F(BrainTest, DesignsAppliesAndRemembersOverARestart) {
  open();
  design(like_a_picture());
  ASSERT_TRUE(brain_->state().look);
  const auto id = brain_->state().look->id;
  EXPECT_EQ(brain_->state().look->name, "Window");
  EXPECT_EQ(brain_->looks().size(), 1u);
  const auto wanted = key().wanted;
  open();
  ASSERT_TRUE(brain_->state().look);
  EXPECT_EQ(brain_->state().look->id, id);
  EXPECT_NEAR(key().wanted.get(core::Dof::intensity), wanted.get(core::Dof::intensity), 1e-6);
}

TEST_F(BrainTest, ServesThePicturesOfALook) {
  open();
  design(like_a_picture());
  using Kind = panel::PictureOf::Kind;
  const auto id = brain_->state().look->id;
  for (const Kind kind : {Kind::look_wanted, Kind::look_placed, Kind::look_reference}) {
    const auto picture = brain_->picture({kind, "", id});
    ASSERT_TRUE(std::holds_alternative<panel::PictureFile>(picture));
    EXPECT_EQ(std::get<panel::PictureFile>(picture).type, "image/png");
  }
  EXPECT_TRUE(
      std::holds_alternative<panel::Refusal>(brain_->picture({Kind::look_wanted, "", id + 1})));
}

TEST_F(BrainTest, KeepsADesignThatWasNotToBeApplied) {
  open();
  design(like_a_picture(std::nullopt));
  EXPECT_FALSE(brain_->state().look);
  ASSERT_EQ(brain_->looks().size(), 1u);
  const auto id = brain_->looks()[0].id;
  EXPECT_FALSE(perform(panel::ApplyLook{id, 0}).refused);
  EXPECT_EQ(brain_->state().look->id, id);
}

TEST_F(BrainTest, SolvesLevelsAgainForWhereAStandWasPut) {
  open();
  design(like_a_picture());
  core::FixtureState near;
  near.set(core::Dof::distance, 1.2);
  const double before = key().wanted.get(core::Dof::intensity);
  ASSERT_GT(before, 0);
  EXPECT_FALSE(perform(panel::Placed{"key", near}).refused);
  EXPECT_EQ(key().placed.get(core::Dof::distance), 1.2);
  settle([&](const panel::State& state) {
    return state.fixtures[0].wanted.get(core::Dof::intensity) != before;
  });
  open();
  EXPECT_EQ(key().placed.get(core::Dof::distance), 1.2) << "where a stand is survives a restart";
}

TEST_F(BrainTest, GoesBackToTheLookBefore) {
  open();
  EXPECT_EQ(perform(panel::Undo{0}).refused->status, 409);
  design(like_a_picture());
  const auto first = brain_->state().look->id;
  panel::StartDesign second = like_a_picture();
  second.seed = 2;
  design(second);
  EXPECT_NE(brain_->state().look->id, first);
  EXPECT_TRUE(brain_->state().can_undo);
  EXPECT_FALSE(perform(panel::Undo{0}).refused);
  EXPECT_EQ(brain_->state().look->id, first);
}

TEST_F(BrainTest, LetsTheNewestClickWin) {
  open();
  EXPECT_EQ(perform(like_a_picture()).status, 202);
  design(like_a_picture());
  EXPECT_EQ(brain_->state().design->job, 2u);
  EXPECT_EQ(brain_->counters().designs_cancelled, 1u);
  EXPECT_EQ(brain_->looks().size(), 1u);
}

TEST_F(BrainTest, CancelsARunningJobOnce) {
  open();
  perform(like_a_picture());
  EXPECT_FALSE(perform(panel::CancelDesign{1}).refused);
  EXPECT_EQ(brain_->state().design->status, panel::JobStatus::cancelled);
  EXPECT_EQ(perform(panel::CancelDesign{1}).refused->status, 404);
  EXPECT_EQ(perform(panel::CancelDesign{9}).refused->status, 404);
}

TEST_F(BrainTest, HoldsFadersAboveTheLookUntilTheNextLook) {
  open();
  core::FixtureState half;
  half.set(core::Dof::intensity, 0.5);
  perform(panel::SetFixture{"key", half, {}, {}});
  EXPECT_EQ(key().manual.get(core::Dof::intensity), 0.5);
  design(like_a_picture());
  EXPECT_EQ(key().manual.present(), 0u);
}

TEST_F(BrainTest, RefusesABadStudioFileWithAllItsProblemsAndChangesNothing) {
  open();
  const std::string fingerprint = brain_->state().fingerprint;
  std::ofstream(folder_.path() / "studio.yaml") << "studio: test\nfixturs: {}\ncameras: 3\n";
  const auto outcome = perform(panel::Reload{});
  ASSERT_TRUE(outcome.refused);
  EXPECT_EQ(outcome.refused->status, 422);
  EXPECT_GE(outcome.refused->problems.size(), 2u);
  EXPECT_EQ(brain_->state().fingerprint, fingerprint);
}

TEST_F(BrainTest, TakesAChangedStudioFileAndKeepsItsFaders) {
  open();
  core::FixtureState half;
  half.set(core::Dof::intensity, 0.5);
  perform(panel::SetFixture{"back", half, {}, {}});
  std::string yaml = kStudio;
  yaml.replace(yaml.find("  key:"), 6, "  main key:");
  std::ofstream(folder_.path() / "studio.yaml") << yaml;
  EXPECT_FALSE(perform(panel::Reload{}).refused);
  EXPECT_EQ(key().name, "main key");
  EXPECT_EQ(brain_->state().fixture("back")->manual.get(core::Dof::intensity), 0.5);
}

TEST_F(BrainTest, DoesNotClaimABlackoutThatNobodyTook) {
  open();
  std::optional<panel::Outcome> outcome;
  brain_->perform(panel::Blackout{true}, [&](panel::Outcome given) { outcome = given; });
  brain_->tick(clock_.now());
  EXPECT_FALSE(outcome) << "answered before the hand had it";
  clock_.advance(3s);
  brain_->tick(clock_.now());
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->refused->status, 503);
}

TEST_F(BrainTest, SaysWhenTheHandIsNotThere) {
  open();
  clock_.advance(3s);
  brain_->tick(clock_.now());
  EXPECT_FALSE(brain_->state().hand_connected);
  bool told = false;
  for (const auto& problem : brain_->state().problems)
    told = told || problem.what.find("output process") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST_F(BrainTest, LetsOnlyOneBrainIn) {
  open();
  const auto second =
      Brain::open(fake_.world, folder_.path() / "studio.yaml", [](const std::function<void()>&) {});
  EXPECT_FALSE(second);
}

TEST_F(BrainTest, LightsLikeAMoodOfOnesOwn) {
  open();
  panel::AddMood mood{"my-window", "By the window", like_a_picture().picture};
  EXPECT_EQ(perform(mood).status, 201);
  panel::StartDesign ask;
  ask.mood = "my-window";
  ask.title = "By the window";
  ask.trials = 20;
  ask.apply_fade_s = 0;
  design(ask);
  EXPECT_EQ(brain_->state().look->mood, "my-window");
}

TEST_F(BrainTest, TakesALookThatWasMadeElsewhere) {
  open();
  design(like_a_picture());
  const auto store = store::Store::open(fake_.world.state_folder / "chiaro.sqlite");
  ASSERT_TRUE(store);
  const std::string json = (*store)->look(brain_->state().look->id)->json;
  const auto outcome = perform(panel::SaveLook{"Taken", json});
  ASSERT_FALSE(outcome.refused);
  const auto id = Json::parse(outcome.json).at("id").get<std::int64_t>();
  EXPECT_FALSE(perform(panel::ApplyLook{id, 0}).refused);
  EXPECT_EQ(brain_->state().look->name, "Taken");
  EXPECT_EQ(perform(panel::SaveLook{"x", "{}"}).refused->status, 422);
}

}  // namespace
}  // namespace chiaro::daemon
