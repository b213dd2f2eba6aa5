// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/supervisor.h"

#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>

#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;

class SupervisorTest : public testing::Test {
 protected:
  static Program shell(const std::string& name, const std::string& script) {
    return {name, "/bin/sh", {"-c", script}, {{"CHIARO_WORD", "hello"}}};
  }
  /// Tends until `until` holds or something is a problem; ctest's timeout ends a loop without end.
  /// Time moves on only while the program "a" does not run: no machine is too slow for the test.
  core::Result<core::Done> tend_until(const std::function<bool()>& until) {
    while (!until()) {
      if (!supervisor_.pid("a")) now_ += 50ms;
      if (auto state = supervisor_.tend(now_); !state) return state;
      std::this_thread::yield();
    }
    return core::Done{};
  }
  std::string log_of(const std::string& name) const {
    std::ifstream file(folder_.path() / (name + ".log"));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  support::TemporaryFolder folder_;
  Supervisor supervisor_{folder_.path()};
  ports::TimePoint now_{1000s};
};

TEST_F(SupervisorTest, RunsAProgramWithItsEnvironmentAndKeepsItsWords) {
  ASSERT_TRUE(supervisor_.start(shell("a", "echo $CHIARO_WORD; exec sleep 1000"), now_));
  ASSERT_TRUE(tend_until([&] { return log_of("a") == "hello\n"; }));
  EXPECT_TRUE(supervisor_.pid("a"));
  EXPECT_EQ(supervisor_.restarts("a"), 0);
}

TEST_F(SupervisorTest, StartsAgainWhoWasKilled) {
  ASSERT_TRUE(supervisor_.start(shell("a", "exec sleep 1000"), now_));
  const pid_t first = *supervisor_.pid("a");
  ::kill(first, SIGKILL);
  ASSERT_TRUE(tend_until([&] { return supervisor_.restarts("a") == 1; }));
  ASSERT_TRUE(supervisor_.pid("a"));
  EXPECT_NE(*supervisor_.pid("a"), first);
}

TEST_F(SupervisorTest, GivesUpOnAProgramThatDiesAgainAndAgainAndSaysItsLastWords) {
  ASSERT_TRUE(supervisor_.start(shell("a", "echo out of ideas; exit 4"), now_));
  const auto end = tend_until([] { return false; });
  ASSERT_FALSE(end);
  EXPECT_EQ(supervisor_.restarts("a"), 4);
  EXPECT_NE(end.problems().front().what.find("out of ideas"), std::string::npos);
  EXPECT_NE(end.problems().front().remedy.find("a.log"), std::string::npos);
}

TEST_F(SupervisorTest, GivesUpAtOnceWhenTryingAgainIsHopeless) {
  ASSERT_TRUE(supervisor_.start(shell("a", "echo port 8090 is in use; exit 3"), now_));
  EXPECT_FALSE(tend_until([] { return false; }));
  EXPECT_EQ(supervisor_.restarts("a"), 0);
}

TEST_F(SupervisorTest, LeavesNobodyBehind) {
  ASSERT_TRUE(supervisor_.start(shell("a", "exec sleep 1000"), now_));
  ASSERT_TRUE(supervisor_.start(shell("b", "exec sleep 1000"), now_));
  const pid_t a = *supervisor_.pid("a"), b = *supervisor_.pid("b");
  supervisor_.end();
  EXPECT_EQ(::kill(a, 0), -1);
  EXPECT_EQ(::kill(b, 0), -1);
}

/// Neither gone nor a zombie that nobody has collected yet.
bool lives(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  file >> number >> name >> state;
  return !state.empty() && state != "Z";
}

TEST_F(SupervisorTest, ItsChildrenDieWithItEvenWhenItIsKilled) {
  const auto pid_file = folder_.path() / "pid";
  const pid_t parent = ::fork();
  if (parent == 0) {
    Supervisor own(folder_.path() / "own");
    (void)own.start(shell("a", "echo $$ > " + pid_file.string() + "; exec sleep 1000"), now_);
    ::pause();
    ::_exit(0);
  }
  pid_t child = 0;
  while (child == 0) {
    std::ifstream(pid_file) >> child;
    std::this_thread::yield();
  }
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  while (lives(child)) std::this_thread::yield();  // ctest's timeout is the judge
  EXPECT_FALSE(lives(child));
}

TEST_F(SupervisorTest, AProgramThatIsNotThereIsAProblem) {
  EXPECT_FALSE(supervisor_.start({"x", folder_.path() / "nothing", {}, {}}, now_));
}

}  // namespace
}  // namespace chiaro::daemon
