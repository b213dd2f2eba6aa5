// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/brain/brain_test.h"

#include "controller/daemon/box.h"
#include "controller/daemon/box_words.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

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

TEST_F(BrainTest, LightsAtOnceWithTheStandsWhereTheyAreAndThenLooksForBetterPlaces) {
  open();
  EXPECT_EQ(perform(like_a_picture(0.0)).status, 202);
  settle([](const panel::State& state) { return state.design->lit; });
  EXPECT_LE(brain_->state().design->status, panel::JobStatus::running);
  EXPECT_FALSE(brain_->state().look) << "not a look yet";
  settle([](const panel::State& state) { return state.look.has_value(); });
  EXPECT_EQ(brain_->state().design->status, panel::JobStatus::done);
}

TEST_F(BrainTest, UndoWhileALookIsBeingFoundStaysWithTheOneBefore) {
  open();
  EXPECT_FALSE(perform(panel::WorkLight{0}).refused);
  const auto before = brain_->state().look->id;
  EXPECT_EQ(perform(like_a_picture()).status, 202);
  EXPECT_TRUE(brain_->state().can_undo);
  EXPECT_FALSE(perform(panel::Undo{0}).refused);
  EXPECT_EQ(brain_->state().look->id, before);
  EXPECT_EQ(brain_->state().design->status, panel::JobStatus::cancelled);
  EXPECT_FALSE(brain_->state().can_undo);
}

TEST_F(BrainTest, AMoodForLockedLampsIsRefusedWithWhatToDo) {
  open();
  for (const char* lamp : {"key", "back"})
    EXPECT_FALSE(perform(panel::SetFixture{lamp, {}, {}, true}).refused);
  const auto refused = perform(like_a_picture()).refused;
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 409);
  EXPECT_NE(refused->remedy.find("unlock"), std::string::npos);
}

TEST_F(BrainTest, TheLargePreviewShowsTheWallsLightAsThePlannerReckonedWithIt) {
  std::string yaml = kStudio;
  yaml.replace(yaml.find("0.3, 0.3, 0.3"), 13, "0.9, 0.9, 0.9");
  yaml.replace(yaml.find("[64, 48]"), 8, "[64, 64]");  // the planner's own frame is square
  std::ofstream(folder_.path() / "studio.yaml") << yaml;
  open();
  const auto mean = [&](std::int64_t id) {
    const auto found = brain_->picture({panel::PictureOf::Kind::look_placed, "", id});
    const auto& bytes = std::get<panel::PictureFile>(found).bytes;
    const auto picture = core::decode_picture(
        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "preview");
    const core::Picture light = core::linear(*picture);
    double sum = 0;
    for (const float value : light.green.values) sum += value;
    return std::pair{sum / static_cast<double>(light.green.values.size()), picture->size.width};
  };
  design(like_a_picture());
  const auto id = brain_->state().look->id;
  const auto [planned, working] = mean(id);
  settle([&](const panel::State&) { return mean(id).second == 64; });
  EXPECT_GT(working, 64);
  EXPECT_NEAR(mean(id).first, planned, 0.02 * planned);
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
  ASSERT_EQ(perform_and_wait(mood).status, 201);
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

/// What the brain tells the hand, read as the hand reads it.
class Overheard {
 public:
  explicit Overheard(const ports::World& world, const std::filesystem::path& file)
      : studio_(studio::load_studio(file, {world.config_folder})->studio),
        reader_(*BoxReader::open(world.runtime_folder / "wanted.box", wanted_format(studio_))),
        words_(wanted_format(studio_).words),
        wanted_(sized_wanted(studio_)) {}
  const rig::SourceState& look() {
    if (reader_->read(words_)) from_words(words_, wanted_);
    return wanted_.sources[static_cast<std::size_t>(rig::Source::look)];
  }

 private:
  studio::Studio studio_;
  std::unique_ptr<BoxReader> reader_;
  std::vector<std::uint64_t> words_;
  rig::Wanted wanted_;
};

TEST_F(BrainTest, TheLightFollowsATrackedSubjectInSmallStepsAndComesBack) {
  open();
  panel::TrackSubject track;
  track.moved = core::Vec3{0, 0.5, 0};
  EXPECT_EQ(perform(track).refused->status, 409) << "there is no look to keep yet";
  design(like_a_picture());
  clock_.advance(3s);
  brain_->tick(clock_.now());
  Overheard hand(fake_.world, folder_.path() / "studio.yaml");
  const double before = hand.look().fixtures[0].get(core::Dof::intensity);
  ASSERT_GT(before, 0);
  ASSERT_LT(before, 0.8);
  double last = before;
  for (int i = 0; i < 30; ++i) {
    clock_.advance(40ms);
    const std::uint64_t fade = hand.look().fade_id;
    EXPECT_FALSE(perform(track).refused);
    while (hand.look().fade_id == fade) queue_.run_one();
    const double now = hand.look().fixtures[0].get(core::Dof::intensity);
    EXPECT_LE(std::abs(now - last), 0.5 * 0.041) << i;
    EXPECT_LE(hand.look().fade_s, 0.041);
    last = now;
  }
  EXPECT_GT(std::abs(last - before), 0.02) << "it stands elsewhere in the lamps' light";
  EXPECT_FALSE(perform(panel::TrackSubject{}).refused);
  EXPECT_NEAR(hand.look().fixtures[0].get(core::Dof::intensity), before, 1e-6);
}

TEST_F(BrainTest, AFaderThatAPersonHoldsStaysWhileTheSubjectIsTracked) {
  open();
  design(like_a_picture());
  core::FixtureState half;
  half.set(core::Dof::intensity, 0.5);
  perform(panel::SetFixture{"key", half, {}, {}});
  clock_.advance(3s);
  panel::TrackSubject track;
  track.moved = core::Vec3{0, 0.2, 0};
  brain_->tick(clock_.now());
  Overheard hand(fake_.world, folder_.path() / "studio.yaml");
  const std::uint64_t fade = hand.look().fade_id;
  perform(track);
  while (hand.look().fade_id == fade) queue_.run_one();
  EXPECT_EQ(key().manual.get(core::Dof::intensity), 0.5);
}

}  // namespace
}  // namespace chiaro::daemon
