// SPDX-License-Identifier: Apache-2.0
// The control socket itself: a blackout is not kept by what else is being asked.
#include "controller/daemon/output/control.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {
namespace {

int connect_to(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(path.begin(), path.end(), address.sun_path);
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_EQ(::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return descriptor;
}

TEST(ControlTest, ABlackoutOvertakesWhatWaitsForTheHousekeeper) {
  support::TemporaryFolder folder;
  support::FakeClock clock{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network;
  support::FakeWorld world{clock, network, folder.path()};
  drivers::Surroundings around{world.world.network, world.world.devices, world.world.clock};
  const auto studio = support::studio_from(
      support::studio_text(support::fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1)));
  core::Problems warnings;
  Show::Options options;
  options.around = &around;
  auto show = Show::make(studio, options, world.world, nullptr, nullptr, warnings);
  ASSERT_TRUE(show);
  Hand hand(std::move(*show));
  Housekeeper housekeeper(hand, folder.path() / "none.yaml", options, world.world);
  std::atomic<bool> release{false};
  const std::string socket = (folder.path() / "run/output.sock").string();
  auto control =
      Control::open(socket, Answers(hand, housekeeper, release, world.world.state_folder), false);
  ASSERT_TRUE(control) << core::to_string(control.problems());
  hand.start(clock.now());
  const int client = connect_to(socket);
  // The first waits for a report, which no housekeeper brings.
  const std::string asked = "motion stop\nblackout on\n";
  ASSERT_EQ(::send(client, asked.data(), asked.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(asked.size()));
  std::string answer;
  while (answer.find('\n') == std::string::npos) {
    hand.frame(clock);
    clock.sleep_until(hand.next_deadline());
    pollfd ready{client, POLLIN, 0};
    if (::poll(&ready, 1, 1) <= 0) continue;
    std::array<char, 4096> bytes;
    const auto got = ::read(client, bytes.data(), bytes.size());
    ASSERT_GT(got, 0);
    answer.append(bytes.data(), static_cast<std::size_t>(got));
  }
  EXPECT_EQ(answer.substr(0, answer.find('\n')), "{\"blackout\":true}");
  ::close(client);
  control->reset();
}

}  // namespace
}  // namespace chiaro::daemon
