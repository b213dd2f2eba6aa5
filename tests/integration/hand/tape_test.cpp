// SPDX-License-Identifier: Apache-2.0
// Recordings: what was sent, byte for byte and to the nanosecond, also of a file that was cut off.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "controller/daemon/output/live_tape.h"
#include "controller/daemon/output/replay.h"
#include "controller/daemon/output/tape_file.h"
#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using support::fixture_line;

struct Heard {
  ports::Duration at;
  ports::DmxFrame frame;
  friend bool operator==(const Heard&, const Heard&) = default;
};

class TapeTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "show.tape"; }
  /// Three universes of different rates for `ticks` ticks, some changing, some standing.
  std::vector<Heard> write(int ticks) {
    std::mt19937 random(7);
    auto writer = TapeWriter::create(file(), {"a studio", 1234567890});
    EXPECT_TRUE(writer);
    std::vector<Heard> all;
    std::array<ports::DmxFrame, 3> frames{};
    ports::TimePoint now{1000s};
    const ports::TimePoint begun = now;
    for (int tick = 0; tick < ticks; ++tick) {
      for (std::uint16_t u = 0; u < 3; ++u) {
        if (tick % (u + 1) != 0) continue;
        frames[u].universe = static_cast<std::uint16_t>(u * 30000 + 1);
        for (auto n = random() % 4 * (tick % 5 != 0); n > 0; --n)
          frames[u].levels[random() % ports::kSlots] = static_cast<std::uint8_t>(random());
        (*writer)->add(now, frames[u]);
        all.push_back({now - begun, frames[u]});
      }
      if (tick % 3 == 2) {
        EXPECT_TRUE((*writer)->flush());
      }
      now += ports::Duration(25'000'000 + static_cast<int>(random() % 2000) - 1000);
    }
    return all;
  }
  static std::vector<Heard> read(TapeReader& tape) {
    std::vector<Heard> all;
    while (tape.next())
      for (const auto* frame : tape.sent()) all.push_back({tape.at(), *frame});
    return all;
  }
  std::string bytes() const {
    std::ifstream in(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& bytes) const {
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << bytes;
  }
  static bool begins(const std::vector<Heard>& whole, const std::vector<Heard>& part) {
    return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
  }
  support::TemporaryFolder folder_;
};

TEST_F(TapeTest, BringsBackEveryByteAtItsTime) {
  const auto written = write(50);
  auto tape = TapeReader::open(file());
  ASSERT_TRUE(tape) << core::to_string(tape.problems());
  EXPECT_EQ((*tape)->head().studio, "a studio");
  EXPECT_EQ((*tape)->head().started, 1234567890);
  EXPECT_EQ(read(**tape), written);
  EXPECT_TRUE((*tape)->broke_off().empty());
}

TEST_F(TapeTest, IsReadableUpToWhereverItWasCutOff) {
  const auto written = write(12);
  const std::string whole = bytes();
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(whole.substr(0, size));
    auto tape = TapeReader::open(file());
    if (!tape) {
      ASSERT_LT(size, 29u);  // the head, with "a studio"
      continue;
    }
    const auto part = read(**tape);
    ASSERT_TRUE(begins(written, part)) << size;
    ASSERT_GE(part.size(), most) << size;  // more of the file, never less of the show
    most = part.size();
    if ((*tape)->broke_off().empty()) continue;
    ASSERT_NE((*tape)->broke_off()[0].what.find("cut off"), std::string::npos);
  }
  EXPECT_GT(most, written.size() / 2);
}

TEST_F(TapeTest, NeverReplaysWhatWasDamaged) {
  const auto written = write(12);
  const std::string whole = bytes();
  std::mt19937 random(3);
  for (int i = 0; i < 400; ++i) {
    std::string damaged = whole;
    const std::size_t at = 28 + random() % (whole.size() - 28);
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1u << random() % 8));
    put(damaged);
    auto tape = TapeReader::open(file());
    ASSERT_TRUE(tape);
    ASSERT_TRUE(begins(written, read(**tape))) << at;
    ASSERT_EQ((*tape)->broke_off().size(), 1u) << at;
  }
}

TEST_F(TapeTest, SaysWhatIsWrongWithAFileThatIsNone) {
  const auto what = [&](const std::string& text) {
    put(text);
    const auto tape = TapeReader::open(file());
    return tape ? "opened" : tape.problems()[0].what;
  };
  EXPECT_EQ(what(""), "this is no recording of Chiaro's");
  EXPECT_EQ(what("studio: portrait\n"), "this is no recording of Chiaro's");
  EXPECT_NE(what("CHIAROTAPE\x1a\x02"
                 "abcdefghijk")
                .find("version 2"),
            std::string::npos);
  EXPECT_NE(what("CHIAROTAPE\x1a\x01").find("cut off before its first frame"), std::string::npos);
  const auto missing = TapeReader::open(folder_.path() / "none");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.problems()[0].what.find("cannot be opened"), std::string::npos);
}

TEST_F(TapeTest, NeverWritesOverAFile) {
  put("dear to somebody");
  const auto writer = TapeWriter::create(file(), {});
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.problems()[0].remedy.find("never written over"), std::string::npos);
  EXPECT_EQ(bytes(), "dear to somebody");
}

TEST_F(TapeTest, AStandingShowTakesAFewBytesATick) {
  auto writer = TapeWriter::create(file(), {});
  ports::TimePoint now{5s};
  for (int tick = 0; tick < 400; ++tick, now += 25ms)
    for (std::uint16_t u = 1; u <= 256; ++u) (*writer)->add(now, {u, {}});
  ASSERT_TRUE((*writer)->flush());
  EXPECT_LT((*writer)->bytes(), 400 * 6 + 256 * 8);
}

/// Remembers what it was given and when.
class Ear final : public ports::OutputPort {
 public:
  explicit Ear(std::vector<Heard>& heard) : heard_(heard) {}
  core::Result<core::Done> open() override { return core::Done{}; }
  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    heard_.push_back({now.time_since_epoch(), frame});
  }
  void release(ports::TimePoint) override {}
  ports::PortReport report() const override { return {}; }
  bool physical() const override { return true; }

 private:
  std::vector<Heard>& heard_;
};

TEST_F(TapeTest, AReplaySendsTheSameBytesAtTheSameTimes) {
  const auto written = write(60);
  for (int round = 0; round < 2; ++round) {
    support::FakeClock clock(support::FakeClock::Sleep::jumps);
    const ports::TimePoint start = clock.now() + 1s;
    std::vector<Heard> heard;
    std::vector<std::unique_ptr<PortSlot>> slots;
    for (const std::uint16_t universe : {std::uint16_t{1}, std::uint16_t{30001}}) {
      drivers::OutputSettings settings;
      settings.universe = universe;
      slots.push_back(std::make_unique<PortSlot>("ear", settings, std::make_unique<Ear>(heard), 40,
                                                 clock, false));
    }
    auto tape = TapeReader::open(file());
    const std::atomic<bool> stop{false};
    const Replayed done = replay(**tape, slots, clock, start, stop);
    std::vector<Heard> expected;
    for (Heard each : written) {
      each.at += start.time_since_epoch();
      if (each.frame.universe != 60001) expected.push_back(each);
    }
    EXPECT_EQ(heard, expected);
    EXPECT_EQ(done.frames, written.size());
    EXPECT_EQ(done.nowhere.at(60001), 20u);
  }
}

TEST(LiveTapeTest, CountsWhatADiskWasTooSlowForAndNeverWaits) {
  LiveTape tape(1);
  tape.put(ports::TimePoint{1s}, {});  // not begun
  tape.begin();
  for (int i = 0; i < 300; ++i) tape.put(ports::TimePoint{std::chrono::seconds(i)}, {});
  EXPECT_EQ(tape.lost(), 300u - 256u);
  EXPECT_EQ(tape.oldest()->at, ports::TimePoint{0s});
  tape.taken();
  tape.put(ports::TimePoint{1000s}, {});
  EXPECT_EQ(tape.lost(), 300u - 256u);
  tape.end();
  tape.put(ports::TimePoint{1001s}, {});
  tape.begin();
  EXPECT_EQ(tape.oldest(), nullptr);
}

class RecordingHand : public RunningHand {
 protected:
  RecordingHand() {
    write_studio(support::studio_text(fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1) +
                                      fixture_line("c", "generic/daylight-dimmer", "1ch", 2, 1)));
  }
  nlohmann::json ask(const std::string& line) {
    const auto answer = meanwhile([&] { return hand_request(runtime(), line, 20s); });
    return answer ? nlohmann::json::parse(*answer)
                  : nlohmann::json{{"refused", core::to_string(answer.problems())}};
  }
};

TEST_F(RecordingHand, KeepsEveryFrameThatLeftInItsOrder) {
  start();
  const auto tape_file = folder_.path() / "show.tape";
  EXPECT_EQ(ask("record start " + tape_file.string())["recording"], true);
  EXPECT_NE(ask("record start " + tape_file.string())["refused"].get<std::string>().find(
                "under way already"),
            std::string::npos);
  auto brain = this->brain();
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
  look.fade_id = 1;
  look.fade_s = 1;
  look.fixtures.resize(2);
  look.fixtures[0].set(core::Dof::intensity, 1);
  brain->post(wanted, clock_->now());
  run(2s);
  const auto stopped = ask("record stop");
  EXPECT_EQ(stopped["lost"], 0);
  EXPECT_NE(ask("record stop")["refused"].get<std::string>().find("nothing is being recorded"),
            std::string::npos);
  auto tape = TapeReader::open(tape_file);
  ASSERT_TRUE(tape);
  EXPECT_EQ((*tape)->head().studio, "test");
  std::vector<ports::DmxFrame> recorded;
  std::size_t cut = 0;
  ports::Duration last{-25ms};
  while ((*tape)->next()) {
    ASSERT_EQ((*tape)->at() - last, 25ms);
    last = (*tape)->at();
    if ((*tape)->sent().size() != 2u) {  // the last tick may be cut short, no other
      ASSERT_FALSE((*tape)->next());
      ++cut;
      break;
    }
    recorded.push_back(*(*tape)->sent()[0]);
  }
  EXPECT_EQ(stopped["ticks"], recorded.size() + cut);
  ASSERT_GE(recorded.size(), 79u);
  // What a lamp heard: somewhere in it stands the recording, whole.
  std::vector<int> heard, kept;
  for (const auto& packet : hear()) heard.push_back(packet.level(1));
  for (const auto& frame : recorded) kept.push_back(frame.levels[0]);
  EXPECT_NE(std::search(heard.begin(), heard.end(), kept.begin(), kept.end()), heard.end());
  EXPECT_EQ(kept.back(), 255);
}

}  // namespace
}  // namespace chiaro::daemon
