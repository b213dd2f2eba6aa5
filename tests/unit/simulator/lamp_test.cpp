// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/lamp.h"

#include <cmath>
#include <gtest/gtest.h>

namespace chiaro::simulator {
namespace {

using core::Dof;

core::FixtureState at_level(double level) {
  core::FixtureState state;
  state.set(Dof::intensity, level);
  return state;
}

Lamp lamp(const Departures& departures) {
  return Lamp(core::FixtureState{}, character(departures, 7, 3));
}

TEST(Lamp, WithoutDeparturesDoesExactlyWhatItIsAsked) {
  auto perfect = lamp(Departures::none());
  auto state = at_level(0.3712);
  state.set(Dof::cct, 4300);
  state.set(Dof::red, 0.77);
  core::FixtureState place;
  place.set(Dof::azimuth, 0.5);
  perfect.ask(state);
  perfect.put(place);
  perfect.advance(0.001);
  state.overlay(place);
  EXPECT_EQ(perfect.light(), state);
}

TEST(Lamp, LagsByItsTimeConstant) {
  Departures lag = Departures::none();
  lag.lag = true;
  auto slow = lamp(lag);
  const double constant = slow.character().lag_s;
  ASSERT_GE(constant, 0.03);
  ASSERT_LE(constant, 0.09);
  slow.ask(at_level(0));
  slow.advance(10);
  slow.ask(at_level(1));
  slow.advance(constant);
  EXPECT_NEAR(slow.light().get(Dof::intensity), 1 - std::exp(-1.0), 1e-12);
  slow.advance(30 * constant);
  EXPECT_NEAR(slow.light().get(Dof::intensity), 1, 1e-9);
}

TEST(Lamp, LagDoesNotDependOnHowTheTimeIsCut) {
  Departures lag = Departures::none();
  lag.lag = true;
  auto whole = lamp(lag), pieces = lamp(lag);
  for (auto* one : {&whole, &pieces}) {
    one->ask(at_level(0));
    one->advance(10);
    one->ask(at_level(0.8));
  }
  whole.advance(0.05);
  for (int i = 0; i < 50; ++i) pieces.advance(0.001);
  EXPECT_NEAR(whole.light().get(Dof::intensity), pieces.light().get(Dof::intensity), 1e-12);
}

TEST(Lamp, HasStepsOfTwelveBits) {
  Departures steps = Departures::none();
  steps.steps = true;
  auto coarse = lamp(steps);
  coarse.ask(at_level(1.4 / 4095));
  coarse.advance(1);
  EXPECT_DOUBLE_EQ(coarse.light().get(Dof::intensity), 1.0 / 4095);
}

TEST(Lamp, BendsItsCurveAndMissesItsOutputALittle) {
  Departures both = Departures::none();
  both.curve = both.output = true;
  auto real = lamp(both);
  real.ask(at_level(0.25));
  real.advance(1);
  const auto& c = real.character();
  EXPECT_NE(c.curve, 1);
  EXPECT_NE(c.output, 1);
  EXPECT_NEAR(real.light().get(Dof::intensity), std::pow(0.25, c.curve) * c.output, 1e-12);
  EXPECT_NEAR(real.light().get(Dof::intensity), 0.25, 0.25 * 0.1);
}

TEST(Lamp, DarkIsDark) {
  auto real = lamp(Departures{});
  real.ask(at_level(0));
  real.advance(10);
  EXPECT_EQ(real.light().get(Dof::intensity), 0);
}

TEST(Lamp, KeepsWhatTheWireDoesNotName) {
  auto one = lamp(Departures::none());
  auto state = at_level(0.5);
  state.set(Dof::cct, 3200);
  one.ask(state);
  one.ask(at_level(0.6));
  one.advance(1);
  EXPECT_EQ(one.light().get(Dof::cct), 3200);
  EXPECT_EQ(one.light().get(Dof::intensity), 0.6);
}

TEST(Character, IsTheSameForTheSameSeedAndDiffersBetweenLamps) {
  EXPECT_EQ(character({}, 1, 0).output, character({}, 1, 0).output);
  EXPECT_NE(character({}, 1, 0).output, character({}, 1, 1).output);
  EXPECT_NE(character({}, 1, 0).output, character({}, 2, 0).output);
}

TEST(Character, SwitchingOneDepartureOffLeavesTheOthers) {
  Departures without;
  without.output = without.lag = false;
  const auto all = character({}, 5, 2), some = character(without, 5, 2);
  EXPECT_EQ(some.output, 1);
  EXPECT_EQ(some.lag_s, 0);
  EXPECT_EQ(some.cct, all.cct);
  EXPECT_EQ(some.aim_up, all.aim_up);
  EXPECT_EQ(some.distance, all.distance);
}

TEST(Departures, AreNamedOnTheCommandLine) {
  EXPECT_EQ(*departures_named("on"), Departures{});
  EXPECT_EQ(*departures_named("off"), Departures::none());
  const auto some = departures_named("lag,aim");
  ASSERT_TRUE(some);
  EXPECT_TRUE(some->lag && some->aim);
  EXPECT_FALSE(some->output || some->colour || some->placement || some->curve || some->steps);
  EXPECT_FALSE(departures_named("leg"));
}

}  // namespace
}  // namespace chiaro::simulator
