// SPDX-License-Identifier: Apache-2.0
// The file that brings the lamps back after a power cut, ended at every system call, on a full
// disk, and by a real kill -9.
#include "controller/daemon/output/last_levels.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {
namespace {

using core::Dof;

struct Killed {};

/// Ends the program before its n-th call, or makes every call of one kind fail. Remembers the names
/// of what was called.
class FaultyCalls final : public FileCalls {
 public:
  int killed_before = -1;
  std::string failing;
  int with = EIO;
  std::vector<std::string> made;

  int open(const char* path, int flags, unsigned mode) override {
    const bool folder = (flags & O_DIRECTORY) != 0;
    if (fails(folder ? "open folder" : "open")) return -1;
    const int descriptor = FileCalls::open(path, flags, mode);
    if (folder) folders_.insert(descriptor);
    return descriptor;
  }
  std::ptrdiff_t write(int descriptor, const char* bytes, std::size_t size) override {
    // A disk that is full takes some of it first; a killed writer too.
    const std::size_t part = std::max<std::size_t>(1, size / 3);
    if (fails("write")) {
      FileCalls::write(descriptor, bytes, part);
      return -1;
    }
    return FileCalls::write(descriptor, bytes, part);
  }
  int fsync(int descriptor) override {
    return fails(folders_.count(descriptor) > 0 ? "fsync folder" : "fsync")
               ? -1
               : FileCalls::fsync(descriptor);
  }
  int close(int descriptor) override {
    folders_.erase(descriptor);
    const int outcome = FileCalls::close(descriptor);
    return fails("close") ? -1 : outcome;
  }
  int rename(const char* from, const char* to) override {
    return fails("rename") ? -1 : FileCalls::rename(from, to);
  }
  int link(const char* from, const char* to) override {
    return fails("link") ? -1 : FileCalls::link(from, to);
  }
  int unlink(const char* path) override { return fails("unlink") ? -1 : FileCalls::unlink(path); }

 private:
  bool fails(const std::string& name) {
    if (static_cast<int>(made.size()) == killed_before) throw Killed{};
    made.push_back(name);
    errno = with;
    return name == failing;
  }
  std::set<int> folders_;
};

class LastLevels : public testing::Test {
 protected:
  rig::Held held(double level) const {
    rig::Held held;
    held.fixtures.resize(1);
    held.fixtures[0].set(Dof::intensity, level);
    return held;
  }
  core::Result<core::Done> write(double level, FileCalls& calls) {
    return write_last_levels(file_, studio_, held(level), calls);
  }
  double read() {
    core::Problems warnings;
    const auto found = read_last_levels(file_, studio_, warnings);
    EXPECT_TRUE(warnings.empty()) << core::to_string(warnings);
    return found ? found->fixtures.at(0).get(Dof::intensity) : -1;
  }
  support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "last-levels.json";
  const studio::Studio studio_ = support::studio_from(
      support::studio_text(support::fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1)));
};

TEST_F(LastLevels, BringsBackEverythingThatItKeeps) {
  rig::Held all = held(0.3);
  all.masters = {0.1, 0.2, 0.3, 0.4, 0.5};
  all.blackout = all.motion_stop = true;
  all.marks = {static_cast<rig::Marks>(rig::Mark::park) | static_cast<rig::Marks>(rig::Mark::solo)};
  all.own_marks = {static_cast<rig::Marks>(rig::Mark::solo)};
  all.fade_id = {1, 2, 3, 18446744073709551615ULL};
  all.own = held(0.7).fixtures;
  all.master_id = {5, 6, 7, 8, 9};
  all.blackout_id = 10;
  all.stop_id = 11;
  all.arm_id = 12;
  all.cue = 2.5;
  ASSERT_TRUE(write_last_levels(file_, studio_, all));
  core::Problems warnings;
  EXPECT_EQ(read_last_levels(file_, studio_, warnings), all);
}

TEST_F(LastLevels, WritesSyncsRenamesAndSyncsTheFolderInThatOrder) {
  FaultyCalls calls;
  ASSERT_TRUE(write(0.5, calls));
  calls.made.clear();
  ASSERT_TRUE(write(0.5, calls));
  std::vector<std::string> order;
  for (const auto& call : calls.made)
    if (order.empty() || order.back() != call) order.push_back(call);
  EXPECT_EQ(order, (std::vector<std::string>{"open", "write", "fsync", "close", "rename", "link",
                                             "rename", "open folder", "fsync folder", "close"}));
}

TEST_F(LastLevels, HoldsTheOldOrTheNewLevelsWhereverTheWriterIsKilled) {
  FaultyCalls count;
  for (int i = 1; i <= 7; ++i) ASSERT_TRUE(write(i * 0.1, count));
  count.made.clear();
  ASSERT_TRUE(write(0.7, count));
  const int calls = static_cast<int>(count.made.size());
  double last = 0.7;
  int old = 0, fresh = 0;
  for (int at = 0; at <= calls; ++at) {
    FaultyCalls faulty;
    faulty.killed_before = at;
    const double next = last + 0.001;
    try {
      (void)write(next, faulty);
    } catch (const Killed&) {
    }
    const double now = read();
    ASSERT_TRUE(now == last || now == next) << "killed before call " << at << ": " << now;
    ++(now == next ? fresh : old);
    last = now;
    // And the next writer goes on as if nothing had been.
    FileCalls whole;
    ASSERT_TRUE(write(last += 0.001, whole));
    ASSERT_EQ(read(), last);
  }
  EXPECT_GT(old, 5);
  EXPECT_GT(fresh, 2);
}

TEST_F(LastLevels, KeepsTheOldLevelsAndSaysSoWhenAnyCallFails) {
  for (const char* failing : {"open", "write", "fsync"}) {
    FileCalls whole;
    ASSERT_TRUE(write(0.25, whole));
    FaultyCalls full;
    full.failing = failing;
    full.with = ENOSPC;
    const auto outcome = write(0.75, full);
    ASSERT_FALSE(outcome) << failing;
    EXPECT_NE(core::to_string(outcome.problems()).find("No space left"), std::string::npos);
    EXPECT_EQ(read(), 0.25) << failing;
    EXPECT_FALSE(std::filesystem::exists(file_.string() + ".new")) << failing;
  }
  FaultyCalls no_links;  // a file system without them keeps one version, whole
  no_links.failing = "link";
  EXPECT_TRUE(write(0.5, no_links));
  EXPECT_EQ(read(), 0.5);
}

TEST_F(LastLevels, KeepsFiveGenerationsAndTakesTheNewestThatIsWhole) {
  FileCalls calls;
  for (int i = 1; i <= 7; ++i) ASSERT_TRUE(write(i * 0.1, calls));
  EXPECT_FALSE(std::filesystem::exists(generation_of(file_, 5)));
  for (int g = 0; g < 4; ++g) {
    std::ofstream(generation_of(file_, g)) << std::string(4096, '\0');
    core::Problems warnings;
    const auto found = read_last_levels(file_, studio_, warnings);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->fixtures[0].get(Dof::intensity), (6 - g) * 0.1);
    EXPECT_EQ(warnings.size(), static_cast<std::size_t>(g) + 1);
  }
}

TEST_F(LastLevels, RefusesAFileInWhichOneDigitHasChanged) {
  FileCalls calls;
  ASSERT_TRUE(write(0.25, calls));
  ASSERT_TRUE(write(0.5, calls));
  std::ifstream in(file_);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.replace(text.find("0.5"), 3, "0.6");
  std::ofstream(file_) << text;
  core::Problems warnings;
  EXPECT_EQ(read_last_levels(file_, studio_, warnings)->fixtures[0].get(Dof::intensity), 0.25);
}

TEST_F(LastLevels, SurvivesARealKillAtWhateverMomentItComes) {
  FileCalls calls;
  ASSERT_TRUE(write(0, calls));
  double least = 0;
  for (int round = 0; round < 30; ++round) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t writer = ::fork();
    if (writer == 0) {
      for (int i = 1;; ++i) {
        FileCalls real;
        const double level = least + i * 1e-6;
        if (!write_last_levels(file_, studio_, held(level), real)) ::_exit(1);
        if (::write(pipe[1], "x", 1) != 1) ::_exit(1);
      }
    }
    char byte = 0;
    for (int i = 0; i <= round % 7; ++i) ASSERT_EQ(::read(pipe[0], &byte, 1), 1);
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    ::close(pipe[0]);
    ::close(pipe[1]);
    const double now = read();
    ASSERT_GE(now, least + (round % 7 + 1) * 1e-6 - 1e-12) << "a kept level went back";
    least = now;
  }
}

}  // namespace
}  // namespace chiaro::daemon
