// SPDX-License-Identifier: Apache-2.0
// The output loop does nothing that could keep it: watched while it sends through every driver
// there is, fades, records, obeys, loses its network and is swapped.
#include <atomic>
#include <condition_variable>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <mutex>
#include <poll.h>
#include <semaphore>
#include <set>
#include <shared_mutex>
#include <sys/socket.h>
#include <syslog.h>
#include <thread>
#include <unistd.h>

#include "controller/daemon/box_words.h"
#include "controller/daemon/file_lock.h"
#include "controller/daemon/hand_link.h"
#include "controller/daemon/output/hand.h"
#include "drivers/common/real_world.h"
#include "drivers/common/system_network.h"
#include "tests/integration/real_time/guard.h"
#include "tests/support/fake_devices.h"
#include "tests/support/fake_world.h"
#include "tests/support/stage_for_outputs.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using real_time::breaches;
using real_time::OnBreach;
using real_time::RealTimeSection;

// ---- The guard catches each kind, by name.

void allocate() { ::operator delete(::operator new(100)); }
void lock() {
  static std::mutex mutex;
  const std::scoped_lock held(mutex);
}
void lock_shared() {
  static std::shared_mutex mutex;
  const std::shared_lock held(mutex);
}
void wait_for_somebody() {
  static std::mutex mutex;
  static std::condition_variable somebody;
  std::unique_lock held(mutex);
  somebody.wait_for(held, 1ms);
}
void wait_for_an_atomic() {
  static std::binary_semaphore never{0};
  (void)never.try_acquire_for(1ms);
}
void sleep_a_little() { std::this_thread::sleep_for(1us); }
void nap() { ::usleep(1); }
void poll_nothing() { ::poll(nullptr, 0, 0); }
void log_a_line() { std::cerr << "" << std::flush << "x\n"; }
void log_to_the_system() { ::syslog(LOG_DEBUG, "%s", ""); }
void write_a_file() {
  static const int null = ::open("/dev/null", O_WRONLY);
  (void)!::write(null, "x", 1);
}
void open_a_file() { ::close(::open("/dev/null", O_RDONLY)); }
void print() {
  static volatile int nothing = 0;
  std::printf("%.0d", nothing);
}
void send_and_wait() {
  const char byte = 0;
  (void)::send(-1, &byte, 1, 0);
}
void ask_the_time_of_day() { (void)std::chrono::system_clock::now(); }
void ask_the_old_way() { (void)!std::time(nullptr); }
void throw_something() {
  try {
    throw 1;
  } catch (int) {
  }
}

struct Sin {
  const char* name;
  void (*commit)();
  const char* caught_as;
};
void PrintTo(const Sin& sin, std::ostream* out) { *out << sin.name; }

class EverySin : public testing::TestWithParam<Sin> {};

TEST_P(EverySin, EndsTheProgramWithItsName) {
  const std::string words = std::string("real-time breach: ") + GetParam().caught_as;
  EXPECT_DEATH(
      {
        GetParam().commit();  // whatever it does the first time is done
        const RealTimeSection section;
        GetParam().commit();
      },
      words);
}

TEST_P(EverySin, IsCountedWhereItIsToBe) {
  GetParam().commit();
  {
    const RealTimeSection section(OnBreach::count);
    GetParam().commit();
  }
  EXPECT_FALSE(breaches().empty());
  GetParam().commit();
  EXPECT_TRUE(breaches().empty()) << "outside a section nobody minds";
}

INSTANTIATE_TEST_SUITE_P(
    All, EverySin,
    testing::Values(Sin{"Allocation", allocate, "malloc"}, Sin{"Lock", lock, "pthread_mutex_lock"},
                    Sin{"SharedLock", lock_shared, "pthread_rwlock_rdlock"},
                    Sin{"Condition", wait_for_somebody, "pthread_"},
                    Sin{"AtomicWait", wait_for_an_atomic, "(sched_yield|syscall)"},
                    Sin{"Sleep", sleep_a_little, "(clock_)?nanosleep"}, Sin{"Nap", nap, "usleep"},
                    Sin{"Poll", poll_nothing, "poll"},
                    Sin{"Log", log_a_line, "(fwrite|write|fflush)"},
                    Sin{"SystemLog", log_to_the_system, "syslog"},
                    Sin{"Write", write_a_file, "write"}, Sin{"Open", open_a_file, "open"},
                    Sin{"Print", print, "printf"}, Sin{"WaitingSend", send_and_wait, "send"},
                    Sin{"TimeOfDay", ask_the_time_of_day, "clock_gettime .time of day"},
                    Sin{"OldTimeOfDay", ask_the_old_way, "time"},
                    Sin{"Throw", throw_something, "malloc"}),
    [](const auto& sin) { return sin.param.name; });

TEST(Guard, LetsADatagramPassThatCannotWait) {
  drivers::SystemNetwork network;
  auto socket = network.open_datagram({"lo", 0, false, false});
  ASSERT_TRUE(socket) << core::to_string(socket.problems());
  const ports::Endpoint nobody{"127.0.0.1", 9};
  const std::array<std::uint8_t, 638> packet{};
  const RealTimeSection section;
  (*socket)->send(nobody, packet);
}

/// Setting the clock (an NTP step, a person) changes no deadline: the loop sleeps until an absolute
/// time of the monotonic clock, which nobody can set, and asks the guarded loop below for no other.
TEST(Guard, TheProgramsClockIsTheMonotonicOne) {
  ports::Clock& clock = drivers::real_world("").clock;
  const RealTimeSection section(OnBreach::count);
  const auto now = clock.now();
  clock.sleep_until(now);
  const std::vector<std::string> found = breaches();
  EXPECT_EQ(found, std::vector<std::string>{"clock_nanosleep (monotonic, absolute)"});
}

// ---- The loop with every driver.

class PlainClock final : public ports::Clock {
 public:
  ports::TimePoint now() const override { return ports::TimePoint(ports::Duration(now_.load())); }
  void sleep_until(ports::TimePoint then) override {
    std::int64_t now = now_, next = then.time_since_epoch().count();
    while (now < next && !now_.compare_exchange_weak(now, next)) {
    }
    std::this_thread::yield();  // threads of ports sleep on this clock too
  }

 private:
  std::atomic<std::int64_t> now_{1'000'000'000'000};
};

/// A network that counts, and can be pulled.
class PlainNetwork final : public ports::Network {
 public:
  class Socket final : public ports::DatagramSocket {
   public:
    explicit Socket(PlainNetwork& network) : network_(network) {}
    bool send(const ports::Endpoint&, std::span<const std::uint8_t>) override {
      if (!network_.unplugged) ++network_.sent;
      return !network_.unplugged;
    }
    std::optional<std::size_t> receive(std::span<std::uint8_t>, ports::Endpoint*) override {
      return std::nullopt;
    }
    core::Result<core::Done> join(const std::string&) override { return core::Done{}; }

   private:
    PlainNetwork& network_;
  };
  core::Result<std::unique_ptr<ports::DatagramSocket>> open_datagram(const Options&) override {
    return std::unique_ptr<ports::DatagramSocket>(std::make_unique<Socket>(*this));
  }
  std::optional<Address> address_of(const std::string&) override {
    return Address{"127.0.0.1", "127.255.255.255", {}};
  }
  std::atomic<bool> unplugged{false};
  std::atomic<std::uint64_t> sent{0};
};

class EveryDriver : public testing::Test {
 protected:
  EveryDriver() {
    const auto pro = devices_.plug_serial({"/dev/ttyUSB0", 0x0403, 0x6001, "PRO1", "1-1", "", ""});
    pro->answer = support::usbpro_answers;
    const auto modbus = devices_.plug_modbus("10.0.0.5");
    modbus->units[1] = {};
    far_ends_ = {pro, modbus, devices_.plug_ola(),
                 devices_.plug_serial({"/dev/ttyUSB1", 0x0403, 0x6001, "OPEN1", "1-3", "", ""}),
                 devices_.plug_usb({"", 0x16c0, 0x05dc, "", "1-2", "www.anyma.ch", "uDMX"})};
    std::filesystem::create_directories(world_.state_folder);
    std::filesystem::create_directories(world_.runtime_folder);
  }
  /// Every output once, over two universes of the network; a lamp in each, a head and a circuit.
  static studio::Studio studio(int lamps) {
    const std::vector<std::string> outputs{
        "{sacn: {interface: lo, sync: 7000}}",
        "{sacn: {interface: lo, sync: 7000, quiet: yes}}",
        "{artnet: {interface: lo, unicast: 127.0.0.1, sync: yes}}",
        "{artnet: {interface: lo}}",
        "{usbpro: {serial: PRO1}}",
        "{opendmx: {serial: OPEN1}}",
        "udmx",
        "ola",
        "mock",
        "{modbus: {bus: rack, unit: 1, map: generic/dali-64}}"};
    std::string fixtures, out = "outputs:\n";
    for (std::size_t u = 1; u <= outputs.size(); ++u) {
      for (int n = 0; n < lamps; ++n)
        fixtures += support::fixture_line("l" + std::to_string(u) + "-" + std::to_string(n),
                                          "generic/rgb", "4ch-dimmer", static_cast<int>(u),
                                          1 + 4 * n, "limits: {dark_to_full: 250 ms}");
      out += "  universe " + std::to_string(u) + ": " + outputs[u - 1] + "\n";
    }
    std::string text =
        support::studio_text(fixtures,
                             "buses: {rack: {device: \"tcp://10.0.0.5:502\"}}\n"
                             "safety: {when_silent: {fade_to_safe: {after: 2 s, over: 1 s}}}\n");
    const auto begin = text.find("outputs:");
    const auto end = text.find("\n", text.find("universe 2:")) + 1;
    text.replace(begin, end - begin, out);
    return support::studio_from(text);
  }
  std::unique_ptr<Show> show(const studio::Studio& studio, const Show* before = nullptr,
                             bool dry_run = false) {
    core::Problems warnings;
    Show::Options options;
    options.dry_run = dry_run;
    options.around = &around_;
    auto made = Show::make(studio, options, world_, nullptr, before, warnings);
    if (!made) throw std::runtime_error(core::to_string(made.problems()));
    return std::move(*made);
  }
  void frames(Hand& hand, int count) {
    for (int i = 0; i < count; ++i) {
      {
        const RealTimeSection section;
        hand.frame(clock_);
      }
      clock_.sleep_until(hand.next_deadline());
    }
  }

  support::TemporaryFolder folder_;
  PlainClock clock_;
  PlainNetwork network_;
  support::FakeClock no_clock_;
  support::FakeNetwork no_network_;
  support::FakeWorld shipped_{no_clock_, no_network_, folder_.path()};  ///< for its folders
  support::FakeDevices devices_;
  std::vector<std::shared_ptr<support::FakeDevice>> far_ends_;
  std::istringstream in_;
  std::ostringstream out_, err_;
  std::atomic<bool> stop_{false}, reload_{false};
  ports::World world_{clock_,
                      network_,
                      devices_,
                      in_,
                      out_,
                      err_,
                      false,
                      shipped_.world.config_folder,
                      folder_.path() / "state",
                      folder_.path() / "run",
                      stop_,
                      reload_};
  drivers::Surroundings around_{network_, devices_, clock_};
};

TEST_F(EveryDriver, IsSentThroughWithoutAnythingThatCouldKeepTheLoop) {
  const auto studio = this->studio(8);
  auto link = HandLink::open(world_.runtime_folder, studio);
  ASSERT_TRUE(link);
  Hand hand(show(studio));
  std::set<std::string> used;
  for (const auto& port : hand.show().ports()) used.insert(port->driver());
  for (const auto& entry : drivers::outputs())
    EXPECT_EQ(used.count(std::string(entry.name)), 1u) << entry.name << " is not in this test";
  auto reader = BoxReader::open(world_.runtime_folder / "wanted.box", wanted_format(studio));
  ASSERT_TRUE(reader);
  hand.show().give_reader(std::move(*reader));
  LiveTape tape(studio.outputs.size());
  hand.record_to(tape);
  tape.begin();
  hand.start(clock_.now());
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
  look.fixtures.resize(studio.fixtures.size());
  look.fade_s = 0.5;
  const auto wish = [&](Wish::Kind kind, bool on, double number = 0) {
    Wish asked;
    asked.kind = kind;
    asked.on = on;
    asked.number = number;
    asked.fixture = Wish::kEvery;
    asked.studio = studio.fingerprint;
    EXPECT_NE(hand.wish(asked), 0u);
  };
  for (int round = 0; round < 24; ++round) {
    look.fade_id = static_cast<std::uint64_t>(round) + 1;
    for (auto& state : look.fixtures) {
      state.set(core::Dof::intensity, round % 2);
      state.set(core::Dof::red, 0.1 * (round % 10));
    }
    if (round < 18) (*link)->post(wanted, clock_.now());  // then it falls silent
    if (round == 3) wish(Wish::Kind::mark, true);
    if (round == 4) wish(Wish::Kind::level, true, 0.5);
    if (round == 5) wish(Wish::Kind::master, true, 0.5);
    if (round == 6) wish(Wish::Kind::release, true);
    if (round == 7) hand.wish_blackout(true);
    if (round == 9) hand.wish_blackout(false);
    if (round == 10) wish(Wish::Kind::cue_go, true);
    if (round == 11) network_.unplugged = true;
    if (round == 13) network_.unplugged = false;
    if (round == 15) hand.offer(show(this->studio(7), &hand.show()));
    frames(hand, 20);
    while (tape.oldest() != nullptr) tape.taken();
  }
  EXPECT_NE(hand.collect(), nullptr);
  EXPECT_GT(network_.sent, 500u);
  EXPECT_EQ(tape.lost(), 0u);
}

TEST_F(EveryDriver, IsNotEvenOpenedInADryRun) {
  Hand hand(show(studio(1), nullptr, true));
  hand.start(clock_.now());
  frames(hand, 100);
  hand.show().release(clock_.now());
  for (const auto& port : hand.show().ports()) {
    EXPECT_FALSE(port->port().physical()) << port->driver();
    // Those on threads of their own take the newest frame: how many of them is the scheduler's.
    EXPECT_GE(port->port().report().frames_sent, 1u) << port->driver();
  }
  for (const auto& far : far_ends_)
    EXPECT_EQ(far->opens, 0) << ports::to_string(far->found.identity);
  EXPECT_EQ(network_.sent, 0u);
}

}  // namespace
}  // namespace chiaro::daemon
