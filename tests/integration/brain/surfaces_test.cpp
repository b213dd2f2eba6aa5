// SPDX-License-Identifier: Apache-2.0
// What people ask for at control surfaces that needs a brain: the hand counts, the brain does.
#include "controller/daemon/box_words.h"
#include "tests/integration/brain/brain_test.h"

namespace chiaro::daemon {
namespace {

class SurfacesTest : public BrainTest {
 protected:
  SurfacesTest() {
    std::filesystem::create_directories(folder_.path() / "surfaces/my");
    std::ofstream(folder_.path() / "surfaces/my/pad.yaml")
        << "surface: my/pad\nmaker: M\ndevice: D\ndriver: osc\ncontrols:\n"
           "  dark: {osc: /dark, do: blackout on}\n"
           "  up: {osc: /up, do: {brighter: 0.5 stops}}\n"
           "  anna: {osc: /anna, do: {look: Anna}}\n";
    std::ofstream(folder_.path() / "studio.yaml")
        << kStudio << "surfaces:\n  pad: {osc: {map: my/pad, interface: lo}}\n";
  }
  void open_both() {
    open();
    const auto loaded = studio::load_studio(folder_.path() / "studio.yaml",
                                            studio::Folders{fake_.world.config_folder});
    ASSERT_TRUE(loaded) << core::to_string(loaded.problems());
    studio_ = loaded->studio;
    box_ = std::move(
        *BoxWriter::create(fake_.world.runtime_folder / "sent.box", sent_format(studio_)));
    sent_ = sized_sent(studio_);
    sent_.studio_fingerprint = studio_.fingerprint;
    sent_.asks_id = 7;
    report();
  }
  void report() {
    clock_.advance(50ms);
    sent_.sent_ns = clock_.now().time_since_epoch().count();
    std::vector<std::uint64_t> words(sent_format(studio_).words);
    to_words(sent_, words);
    box_->post(words);
    brain_->tick(clock_.now());
  }
  std::int64_t look() { return brain_->state().look ? brain_->state().look->id : 0; }

  studio::Studio studio_;
  std::unique_ptr<BoxWriter> box_;
  rig::Sent sent_;
};

TEST_F(SurfacesTest, ACountedPressIsANudgeAndWhatWasPressedBeforeIsNot) {
  open_both();
  ASSERT_EQ(sent_.asks.size(), 2u);
  design(like_a_picture());
  const auto first = look();
  sent_.asks_id = 8;  // another hand, whose people have pressed already
  sent_.asks[0] = 5;
  report();
  EXPECT_EQ(look(), first);
  sent_.asks[0] = 6;
  report();
  settle([&](const panel::State& state) { return state.look->id != first; });
  ASSERT_EQ(brain_->state().look->nudges.size(), 1u);
  EXPECT_EQ(brain_->state().look->nudges[0], (std::pair<std::string, double>{"brighter", 0.5}));
}

TEST_F(SurfacesTest, RecallsALookByItsNameAndSaysWhenThereIsNone) {
  open_both();
  sent_.asks[1] += 1;
  report();
  brain_->tick(clock_.now());
  const std::string told = panel::state_to_json(brain_->state());
  EXPECT_NE(told.find("a surface asked for look Anna"), std::string::npos) << told;
  design(like_a_picture());
  EXPECT_FALSE(perform(panel::SaveLook{"Anna", ""}).refused);
  const auto anna = look();
  perform(panel::WorkLight{0});
  ASSERT_NE(look(), anna);
  sent_.asks[1] += 1;
  report();
  EXPECT_EQ(brain_->state().look->name, "Anna");
}

}  // namespace
}  // namespace chiaro::daemon
