// SPDX-License-Identifier: Apache-2.0
// What must be true of every DMX input in drivers.def, and of each output with its own input.
#include <gtest/gtest.h>

#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;

class EveryInput : public testing::TestWithParam<InputEntry> {
 protected:
  support::StageForOutputs stage_{"mock"};
  InputSettings settings_{{1, 2}, "lo", "Chiaro test"};
  std::unique_ptr<ports::DmxInput> input_ = GetParam().make(settings_, stage_.around());
  ports::TimePoint now_ = stage_.clock().now();
};

TEST_P(EveryInput, HearsNothingBeforeItIsOpenedAndIsDark) {
  EXPECT_EQ(input_->listen(now_), 0u);
  ASSERT_EQ(input_->universes(), 2u);
  EXPECT_EQ(input_->frame(1, now_).universe, 2);
  EXPECT_EQ(input_->frame(1, now_).levels, (std::array<std::uint8_t, 512>{}));
}

TEST_P(EveryInput, OpensMoreThanOnceAndSurvivesNonsense) {
  ASSERT_TRUE(input_->open());
  ASSERT_TRUE(input_->open());
  auto stranger = std::move(*stage_.network().open_datagram({"lo", 0, false, false}));
  for (const std::uint16_t port : {std::uint16_t{5568}, std::uint16_t{6454}})
    for (std::size_t size : {0u, 1u, 12u, 18u, 126u, 638u})
      stranger->send({"127.0.0.1", port}, support::Bytes(size, 0x5a));
  EXPECT_EQ(input_->listen(now_), 0u);
  EXPECT_TRUE(input_->sources(0).empty());
}

TEST_P(EveryInput, HearsTheOutputOfItsOwnKind) {
  ASSERT_TRUE(input_->open());
  OutputSettings settings;
  settings.interface = "lo";
  settings.universe = 2;
  settings.unicast = "127.0.0.1";
  auto port = make_output(std::string(GetParam().name), settings, stage_.around());
  ASSERT_TRUE(port) << "an input without an output of its name";
  ASSERT_TRUE((*port)->open());
  ports::DmxFrame frame;
  frame.levels[511] = 77;
  std::size_t heard = 0;
  for (int i = 0; i < 80; ++i) {  // two seconds: a source's priorities are awaited for 1.5
    now_ += 25ms;
    (*port)->send(frame, now_);
    heard += input_->listen(now_);
  }
  if (!(*port)->physical()) return;
  EXPECT_EQ(heard, 80u);
  EXPECT_EQ(input_->frame(1, now_).levels, frame.levels);
  EXPECT_EQ(input_->frame(0, now_).levels[511], 0);
  EXPECT_EQ(input_->sources(1).size(), 1u);
  EXPECT_EQ(input_->out_of_sequence(), 0u);
}

TEST_P(EveryInput, HoldsTheLastLevelsWhenItsSourceFallsSilent) {
  ASSERT_TRUE(input_->open());
  OutputSettings settings;
  settings.universe = 1;
  settings.unicast = "127.0.0.1";
  auto port = make_output(std::string(GetParam().name), settings, stage_.around());
  ASSERT_TRUE(port && (*port)->open());
  ports::DmxFrame frame;
  frame.levels.fill(50);
  for (int i = 0; i < 80; ++i) {
    now_ += 25ms;
    (*port)->send(frame, now_);
    input_->listen(now_);
  }
  now_ += 60s;
  input_->listen(now_);
  EXPECT_EQ(input_->frame(0, now_).levels[3], (*port)->physical() ? 50 : 0);
  EXPECT_TRUE(input_->sources(0).empty());
}

INSTANTIATE_TEST_SUITE_P(, EveryInput, testing::ValuesIn(inputs().begin(), inputs().end()),
                         [](const auto& about) { return std::string(about.param.name); });

}  // namespace
}  // namespace chiaro::drivers
