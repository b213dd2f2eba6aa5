// SPDX-License-Identifier: Apache-2.0
// The small values everything stands on: units, degrees of freedom, fingerprints, random numbers.
#include <gtest/gtest.h>
#include <set>

#include "controller/core/dof.h"
#include "controller/core/gbuffer.h"
#include "controller/core/hash.h"
#include "controller/core/random.h"
#include "controller/core/units.h"

namespace chiaro::core {
namespace {

TEST(Units, StopsAreDoublings) {
  EXPECT_DOUBLE_EQ(from_stops(3), 8);
  EXPECT_DOUBLE_EQ(from_stops(-1), 0.5);
  EXPECT_DOUBLE_EQ(to_stops(8), 3);
}

TEST(Units, RangesContainTheirEnds) {
  const Range range{-1, 2};
  EXPECT_TRUE(range.contains(-1) && range.contains(2));
  EXPECT_FALSE(range.contains(2.001));
  EXPECT_DOUBLE_EQ(range.clamp(9), 2);
  EXPECT_DOUBLE_EQ(range.clamp(-9), -1);
  EXPECT_DOUBLE_EQ(range.width(), 3);
}

TEST(Dof, EveryOneIsFoundByBothItsNames) {
  std::set<std::string_view> names;
  for (const DofInfo& each : dofs()) {
    EXPECT_EQ(dof_named(each.name), each.dof);
    EXPECT_EQ(dof_named(each.file_name), each.dof);
    EXPECT_EQ(&info(each.dof), &each);
    EXPECT_FALSE(each.help.empty());
    names.insert(each.name);
  }
  EXPECT_EQ(names.size(), kDofs);
  EXPECT_FALSE(dof_named("brightness"));
}

TEST(Dof, OnlyAnglesChangeBetweenFileAndInside) {
  EXPECT_DOUBLE_EQ(inside_value(Dof::azimuth, 180), kPi);
  EXPECT_DOUBLE_EQ(file_value(Dof::azimuth, kPi), 180);
  EXPECT_DOUBLE_EQ(inside_value(Dof::distance, 1.8), 1.8);
  EXPECT_DOUBLE_EQ(inside_value(Dof::cct, 5600), 5600);
}

TEST(Dof, KindsDoNotOverlap) {
  for (const DofInfo& each : dofs()) EXPECT_FALSE(is_colour(each.dof) && is_placement(each.dof));
  EXPECT_FALSE(is_colour(Dof::intensity) || is_placement(Dof::intensity));
  EXPECT_TRUE(is_colour(Dof::cyan) && is_colour(Dof::cct));
  EXPECT_TRUE(is_placement(Dof::azimuth) && is_placement(Dof::zoom));
}

TEST(FixtureState, AbsentIsNotZero) {
  FixtureState state;
  EXPECT_DOUBLE_EQ(state.get(Dof::cct, 5600), 5600);
  state.set(Dof::cct, 0);
  EXPECT_DOUBLE_EQ(state.get(Dof::cct, 5600), 0);
  state.clear(Dof::cct);
  EXPECT_EQ(state, FixtureState{});
}

TEST(FixtureState, OverlayTakesOnlyWhatIsPresent) {
  FixtureState below, above;
  below.set(Dof::intensity, 0.5);
  below.set(Dof::cct, 3200);
  above.set(Dof::cct, 5600);
  below.overlay(above);
  EXPECT_DOUBLE_EQ(below.get(Dof::intensity), 0.5);
  EXPECT_DOUBLE_EQ(below.get(Dof::cct), 5600);
}

TEST(Fingerprint, ValuesOfFnv1a) {
  EXPECT_EQ(Fingerprint().value(), 0xcbf29ce484222325ULL);
  EXPECT_EQ(Fingerprint().add("a").value(), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(Fingerprint().add("foobar").value(), 0x85944171f73967e8ULL);
  EXPECT_EQ(Fingerprint().add("foo").add("bar").value(), 0x85944171f73967e8ULL);
  EXPECT_EQ(hex(0x1fULL), "000000000000001f");
}

TEST(Random, IsTheSameEverywhereForASeed) {
  // The published check values of PCG32 with seed 42, stream 54.
  Random random(42, 54);
  for (const std::uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, StreamsDifferAndDrawsStayInRange) {
  Random a(1, 0), b(1, 1);
  EXPECT_NE(a.next(), b.next());
  double sum = 0, squares = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = a.uniform();
    EXPECT_TRUE(u >= 0 && u < 1);
    EXPECT_LT(a.below(7), 7u);
    const double n = a.normal();
    sum += n;
    squares += n * n;
  }
  EXPECT_NEAR(sum / 20000, 0, 0.03);
  EXPECT_NEAR(squares / 20000, 1, 0.05);
}

TEST(GBuffer, PlanesAreFullSizeWithNothingWhereNothingIsSeen) {
  GBuffer buffer;
  buffer.size = {2, 1};
  buffer.pixel = {1};
  buffer.normal_x = {0};
  buffer.normal_y = {-1};
  buffer.normal_z = {0};
  buffer.depth = {2.5f};
  buffer.object = {1};
  buffer.objects = {{"bust", true}};
  const GeometryPlanes seen = planes(buffer);
  EXPECT_TRUE(std::isinf(seen.depth.at(0, 0)));
  EXPECT_EQ(seen.object.at(0, 0), kNothing);
  EXPECT_EQ(seen.subject.at(0, 0), 0);
  EXPECT_FLOAT_EQ(seen.depth.at(1, 0), 2.5f);
  EXPECT_FLOAT_EQ(seen.normal_y.at(1, 0), -1);
  EXPECT_EQ(seen.subject.at(1, 0), 1);
}

}  // namespace
}  // namespace chiaro::core
