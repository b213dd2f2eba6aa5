// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "controller/daemon/bench/report.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon::bench {
namespace {

TEST(BenchReport, SaysWhetherABarIsMet) {
  Report report;
  report.heading("Speed");
  report.add("fast enough", 150, "us", at_most(200));
  report.add("too slow", 250, "us", at_most(200));
  report.add("far enough", 400, "x", at_least(300), "note");
  report.add("never", std::numeric_limits<double>::infinity(), "s", at_most(1));
  const std::string text = report.to_text();
  EXPECT_NE(text.find("at most 200, met"), std::string::npos) << text;
  EXPECT_NE(text.find("at most 200, MISSED"), std::string::npos) << text;
  EXPECT_NE(text.find("at least 300, met"), std::string::npos) << text;
  EXPECT_NE(text.find("not reached"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(report.to_json("here", true));
  ASSERT_EQ(json["figures"].size(), 4u);
  EXPECT_EQ(json["figures"][1]["met"], false);
  EXPECT_EQ(json["figures"][2]["at_least"], 300);
  EXPECT_TRUE(json["figures"][3]["value"].is_null());
  EXPECT_EQ(json["figures"][3]["met"], false);
}

TEST(BenchReport, MedianOfEvenAndOddCounts) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
}

struct Benched {
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld world{clock, network, folder.path()};
  ports::Exit run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bench");
    return run_chiaro(arguments, world.world);
  }
};

TEST(BenchCommand, RunsItsKernelsToTheEndOnAClockThatStandsStill) {
  Benched b;
  ASSERT_EQ(b.run({"--quick", "--only", "kernels", "--json"}), ports::Exit::done)
      << b.world.err.str();
  const auto json = nlohmann::json::parse(b.world.out.str());
  EXPECT_TRUE(json["ok"]);
  EXPECT_GE(json["figures"].size(), 7u);
}

TEST(BenchCommand, FollowsAMovingSubjectWithoutAJump) {
  Benched b;
  ASSERT_EQ(b.run({"--quick", "--only", "moving", "--json"}), ports::Exit::done)
      << b.world.err.str();
  const auto json = nlohmann::json::parse(b.world.out.str());
  int steps = 0;
  for (const auto& figure : json["figures"])
    if (figure["name"] == "  largest step of a level") {
      EXPECT_TRUE(figure["met"]);
      ++steps;
    }
  EXPECT_EQ(steps, 2) << "a look kept, and a mood matched";
}

TEST(BenchCommand, AMoodThatDoesNotExistIsAProblemWithTheNearestName) {
  Benched b;
  EXPECT_EQ(b.run({"--quick", "--mood", "rembrant"}), ports::Exit::input_has_problems);
  EXPECT_NE(b.world.err.str().find("did you mean rembrandt?"), std::string::npos)
      << b.world.err.str();
}

TEST(BenchCommand, AnUnknownPartIsAUsageError) {
  Benched b;
  EXPECT_EQ(b.run({"--only", "lunch"}), ports::Exit::usage);
}

}  // namespace
}  // namespace chiaro::daemon::bench
