// SPDX-License-Identifier: Apache-2.0
// What an operator does beside choosing moods: work light, nudges, names, meters, hands, and lamps
// that nobody knows.
#include <algorithm>

#include "controller/daemon/brain/words.h"
#include "tests/integration/brain/brain_test.h"

namespace chiaro::daemon {
namespace {

class GesturesTest : public BrainTest {
 protected:
  /// The studio file with one text for another.
  void write_studio(const std::string& from, const std::string& to) {
    std::string yaml = kStudio;
    yaml.replace(yaml.find(from), from.size(), to);
    std::ofstream(folder_.path() / "studio.yaml") << yaml;
  }
  std::int64_t look() { return brain_->state().look ? brain_->state().look->id : 0; }
  double light() { return key().wanted.get(core::Dof::intensity); }
};

TEST_F(GesturesTest, WorkLightGivesTheFaceTheLightThatExposesIt) {
  open();
  EXPECT_FALSE(perform(panel::WorkLight{0}).refused);
  ASSERT_TRUE(brain_->state().look);
  EXPECT_EQ(brain_->state().look->name, "Work light");
  EXPECT_GT(light(), 0);
  EXPECT_EQ(brain_->state().fixtures[1].wanted.get(core::Dof::intensity), 0) << "from the front";
  // The key alone stands in front: it gives the grey card its 800 lx.
  const double lux = 12000 * light() / (1.8 * 1.8);
  EXPECT_NEAR(lux, 800, 8);
}

TEST_F(GesturesTest, ANudgeBrightensAndIsUndone) {
  open();
  design(like_a_picture());
  const auto first = look();
  const double before = light();
  panel::Nudge nudge;
  nudge.by.brighter = 0.5;
  nudge.fade_s = 0;
  EXPECT_EQ(perform(nudge).status, 202);
  settle([&](const panel::State& state) { return state.look->id != first; });
  EXPECT_GT(light(), before);
  EXPECT_EQ(brain_->state().look->name, "Window");
  ASSERT_EQ(brain_->state().look->nudges.size(), 1u);
  EXPECT_EQ(brain_->state().look->nudges[0], (std::pair<std::string, double>{"brighter", 0.5}));
  EXPECT_FALSE(perform(panel::Undo{0}).refused);
  EXPECT_EQ(look(), first);
}

TEST_F(GesturesTest, WhoeverWasAnsweredFindsTheirPictureInTheState) {
  open();
  const auto has_it = [&] {
    const auto& moods = brain_->state().moods;
    return std::any_of(moods.begin(), moods.end(),
                       [](const panel::MoodView& mood) { return mood.name == "our-window"; });
  };
  std::optional<bool> known;
  const auto look_at_once = [&](const panel::Outcome&) { known = has_it(); };
  brain_->perform(panel::AddMood{"our-window", "Our window", like_a_picture().picture},
                  look_at_once);
  while (!known) queue_.run_one();
  EXPECT_EQ(known, true) << "the next question may come before the loop's next turn";
  brain_->perform(panel::RemoveMood{"our-window"}, look_at_once);
  EXPECT_EQ(known, false);
}

TEST_F(GesturesTest, ALargePhotographIsReadOffTheLoopAndKeptSmall) {
  open();
  core::EncodedPicture large({2400, 1800});
  for (std::size_t i = 0; i < large.values.size(); ++i)
    large.values[i].fill(static_cast<std::uint8_t>(i / 24000));
  const auto bytes = core::encode_jpeg(large, 95);
  std::optional<panel::Outcome> outcome;
  const panel::AddMood mood{"large", "Large", std::string(bytes.begin(), bytes.end()), false};
  brain_->perform(mood, [&](const panel::Outcome& given) { outcome = given; });
  EXPECT_FALSE(outcome) << "nothing was read on the loop";
  while (!outcome) queue_.run_one();
  EXPECT_EQ(outcome->status, 201);
  const auto kept = brain_->picture({panel::PictureOf::Kind::mood, "large", 0});
  const auto& file = std::get<panel::PictureFile>(kept);
  const auto picture = core::decode_picture(
      {reinterpret_cast<const std::uint8_t*>(file.bytes.data()), file.bytes.size()}, "kept");
  ASSERT_TRUE(picture);
  EXPECT_LE(picture->size.pixels(), core::kPixelsOfExemplar);
  EXPECT_NEAR(picture->size.width * 3.0 / picture->size.height, 4, 0.02);
  outcome.reset();
  brain_->perform(mood, [&](const panel::Outcome& given) { outcome = given; });
  while (!outcome) queue_.run_one();
  EXPECT_EQ(outcome->json, R"({"name":"large-2"})") << "nobody's picture is lost";
}

TEST_F(GesturesTest, ADamagedPhotographIsRefusedWithWordsOnceItIsRead) {
  open();
  const std::string cut = like_a_picture().picture.substr(0, 40);
  std::optional<panel::Outcome> outcome;
  brain_->perform(panel::AddMood{"cut", "Cut", cut},
                  [&](const panel::Outcome& given) { outcome = given; });
  while (!outcome) queue_.run_one();
  ASSERT_TRUE(outcome->refused);
  EXPECT_EQ(outcome->refused->status, 422);
  EXPECT_FALSE(outcome->refused->remedy.empty());
  panel::StartDesign ask = like_a_picture();
  ask.picture = cut;
  EXPECT_EQ(perform(ask).status, 202);
  settle(
      [](const panel::State& state) { return state.design->status > panel::JobStatus::running; });
  EXPECT_EQ(brain_->state().design->status, panel::JobStatus::failed);
  EXPECT_EQ(brain_->state().design->error->what, outcome->refused->what);
}

TEST_F(GesturesTest, ABentWorkLightIsBentAgainWhenAStandIsMoved) {
  open();
  EXPECT_FALSE(perform(panel::WorkLight{0}).refused);
  const auto flat = look();
  panel::Nudge nudge;
  nudge.by.brighter = 0.5;
  EXPECT_EQ(perform(nudge).status, 202);
  settle([&](const panel::State& state) { return state.look->id != flat; });
  const auto lux = [&](double distance) { return 12000 * light() / (distance * distance); };
  const double bent = lux(1.8), before = light();
  EXPECT_GT(bent, 1.2 * 800);
  core::FixtureState near;
  near.set(core::Dof::distance, 1.3);
  EXPECT_FALSE(perform(panel::Placed{"key", near}).refused);
  settle([&](const panel::State&) { return light() != before; });
  EXPECT_NEAR(lux(1.3), bent, 0.05 * bent);
  EXPECT_EQ(brain_->state().look->nudges.size(), 1u);
  EXPECT_FALSE(key().instruction) << "it stands where it was put";
}

TEST_F(GesturesTest, ThereIsNothingToNudgeBeforeALook) {
  open();
  panel::Nudge nudge;
  nudge.by.warmer = 0.25;
  EXPECT_EQ(perform(nudge).refused->status, 409);
}

TEST_F(GesturesTest, ALookIsRenamedAndKept) {
  open();
  design(like_a_picture());
  EXPECT_FALSE(brain_->looks()[0].kept);
  EXPECT_FALSE(perform(panel::RenameLook{look(), "Anna"}).refused);
  EXPECT_EQ(brain_->looks()[0].name, "Anna");
  EXPECT_TRUE(brain_->looks()[0].kept);
  EXPECT_EQ(brain_->state().look->name, "Anna");
  EXPECT_EQ(perform(panel::RenameLook{99, "x"}).refused->status, 404);
}

TEST_F(GesturesTest, AMeterSetsWhatALampGivesAndSurvivesARestart) {
  open();
  panel::Measured measured{"key", 1000, {}, 0.5};
  EXPECT_FALSE(perform(measured).refused);
  // 1000 lx from 1.8 m at half: 2 * 1000 * 1.8^2 cd.
  EXPECT_NEAR(key().output_cd, 6480, 1);
  EXPECT_TRUE(key().measured);
  open();
  EXPECT_NEAR(key().output_cd, 6480, 1);
  EXPECT_FALSE(perform(panel::Measured{"key", {}, {}, {}}).refused);
  EXPECT_EQ(key().output_cd, 12000);
}

TEST_F(GesturesTest, AMeterCannotKnowALampThatIsDark) {
  open();
  EXPECT_EQ(perform(panel::Measured{"key", 1000, {}, {}}).refused->status, 409);
}

TEST_F(GesturesTest, AFlashIsSetByHandAndSaysSoUntilItIs) {
  write_studio("    patch: {universe: 1, address: 9}\n", "    by_hand: {intensity: flash_power}\n");
  open();
  panel::StartDesign ask = like_a_picture();
  design(ask);
  const auto& back = brain_->state().fixtures[1];
  EXPECT_EQ(back.by_hand, std::vector<core::Dof>{core::Dof::intensity});
  core::FixtureState off;
  off.set(core::Dof::intensity, back.wanted.get(core::Dof::intensity) > 0.01 ? 0 : 1);
  perform(panel::Placed{"back", off});
  ASSERT_TRUE(brain_->state().fixtures[1].instruction);
  EXPECT_NE(brain_->state().fixtures[1].instruction->words.find("set back to"), std::string::npos)
      << brain_->state().fixtures[1].instruction->words;
  EXPECT_FALSE(perform(panel::Placed{"back", {}}).refused);
  EXPECT_FALSE(brain_->state().fixtures[1].instruction);
}

TEST_F(GesturesTest, TriedSlotsAreShownUntilTheyFall) {
  open();
  EXPECT_FALSE(perform(panel::TrySlots{1, {{21, 128}}}).refused);
  ASSERT_EQ(brain_->state().tried.slots.size(), 1u);
  clock_.advance(11s);
  brain_->tick(clock_.now());
  EXPECT_TRUE(brain_->state().tried.slots.empty());
}

TEST_F(GesturesTest, ALampOfAlmostTheSameNameGetsAProfileOfItsOwn) {
  open();
  panel::LearnLamp lamp;
  lamp.name = "Panel";
  lamp.address = 101;
  lamp.slots = {{"dimmer", 255}};
  lamp.add = true;
  ASSERT_FALSE(perform(lamp).refused);
  lamp.name = "PANEL";
  lamp.address = 111;
  lamp.slots = {{"dimmer", 255}, {"cct", 255}};
  const auto second = perform(lamp);
  ASSERT_FALSE(second.refused) << second.refused->what;
  EXPECT_EQ(Json::parse(second.json).at("profile"), "own/panel-2");
  const auto slots_of = [&](const std::string& name) {
    for (const auto& fixture : brain_->state().fixtures)
      if (fixture.name == name && fixture.patch) return int{fixture.patch->slots};
    return 0;
  };
  EXPECT_EQ(slots_of("Panel"), 1) << "the first keeps its profile";
  EXPECT_EQ(slots_of("PANEL"), 2);
}

TEST_F(GesturesTest, ALearnedLampIsInTheStudioAtOnce) {
  open();
  panel::LearnLamp lamp;
  lamp.name = "old panel";
  lamp.address = 101;
  lamp.slots = {{"dimmer", 255}, {"cct", 255}};
  const auto shown = perform(lamp);
  ASSERT_FALSE(shown.refused) << shown.refused->what;
  EXPECT_EQ(brain_->state().fixtures.size(), 2u) << "shown, not added";
  EXPECT_NE(Json::parse(shown.json).at("profile_yaml").get<std::string>().find("bicolour"),
            std::string::npos);
  lamp.add = true;
  const auto added = perform(lamp);
  ASSERT_FALSE(added.refused) << added.refused->what;
  EXPECT_EQ(added.status, 201);
  ASSERT_TRUE(brain_->state().fixture("old panel"));
  EXPECT_EQ(brain_->state().fixture("old panel")->patch->address, 101);
}

TEST_F(GesturesTest, ALampThatCannotBeLearnedLeavesTheStudioAlone) {
  open();
  panel::LearnLamp lamp;
  lamp.name = "odd";
  lamp.address = 101;
  lamp.slots = {{"dimmer", 255}};
  lamp.place = "somewhere";
  lamp.add = true;
  EXPECT_EQ(perform(lamp).refused->status, 422);
  lamp.place = "45 left, 35 up, 1.8 m";
  lamp.slots = {{"nothing", 255}};
  EXPECT_EQ(perform(lamp).refused->status, 422);
  EXPECT_EQ(brain_->state().fixtures.size(), 2u);
}

TEST(HandWords, SayWhatAPersonDoes) {
  studio::Fixture key;
  key.name = "key";
  key.profile.emitter.cct = {5600};
  using studio::HandKind;
  const auto words = [&](core::Dof dof, HandKind kind, double value) {
    return hand_in_words(key, {dof, kind, {}}, value);
  };
  EXPECT_EQ(words(core::Dof::intensity, HandKind::flash_power, 0.25), "set key to 1/4 power");
  EXPECT_EQ(words(core::Dof::intensity, HandKind::knob, 0.62), "turn key's level to 62 %");
  EXPECT_EQ(words(core::Dof::cct, HandKind::gel, 3200), "put ¾ CTO (Lee 285) on key, for 3200 K");
  EXPECT_EQ(words(core::Dof::cct, HandKind::gel, 5600), "take the gel off key");
  EXPECT_EQ(words(core::Dof::cct, HandKind::knob, 4300), "turn key's colour to 4300 K");
}

}  // namespace
}  // namespace chiaro::daemon
