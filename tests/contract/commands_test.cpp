// SPDX-License-Identifier: Apache-2.0
// What is true of every verb of `chiaro`.
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

struct Verb {
  std::string name, summary;
};
const std::vector<Verb> kVerbs{
#define COMMAND(name, summary) {#name, summary},
#include "controller/daemon/commands.def"
#undef COMMAND
};

class EveryCommand : public testing::TestWithParam<Verb> {
 protected:
  ports::Exit run(std::vector<std::string> words) {
    words.insert(words.begin(), GetParam().name);
    return run_chiaro(words, world_.world);
  }
  support::TemporaryFolder folder_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network_;
  support::FakeWorld world_{clock_, network_, folder_.path()};
};

TEST_P(EveryCommand, ExplainsItself) {
  EXPECT_EQ(run({"--help"}), ports::Exit::done);
  EXPECT_NE(world_.out.str().find("Usage: chiaro " + GetParam().name), std::string::npos)
      << world_.out.str();
}

TEST_P(EveryCommand, RefusesAWordItDoesNotKnowWithTheUsageCode) {
  EXPECT_EQ(run({"--no-such-option"}), ports::Exit::usage);
  EXPECT_FALSE(world_.err.str().empty());
  EXPECT_TRUE(world_.out.str().empty()) << world_.out.str();
}

TEST_P(EveryCommand, StandsInTheProgramsOwnHelp) {
  const std::vector<std::string> help{"--help"};
  EXPECT_EQ(run_chiaro(help, world_.world), ports::Exit::done);
  EXPECT_NE(world_.out.str().find("  " + GetParam().name), std::string::npos);
  EXPECT_FALSE(GetParam().summary.empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryCommand, testing::ValuesIn(kVerbs),
                         [](const auto& verb) { return verb.param.name; });

}  // namespace
}  // namespace chiaro::daemon
