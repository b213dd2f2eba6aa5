// SPDX-License-Identifier: Apache-2.0
// `soak_ola UNIVERSES HZ`: what a program does that sends through olad: libola's streaming client,
// every universe at every tick, levels that change, absolute deadlines.
#include <chrono>
#include <cstdlib>
#include <ola/DmxBuffer.h>
#include <ola/client/StreamingClient.h>
#include <thread>

int main(int count, char** words) {
  if (count != 3) return 2;
  const unsigned universes = static_cast<unsigned>(std::atoi(words[1]));
  const auto period = std::chrono::nanoseconds(static_cast<long>(1e9 / std::atof(words[2])));
  ola::client::StreamingClient client{ola::client::StreamingClient::Options()};
  if (!client.Setup()) return 3;
  ola::DmxBuffer buffer;
  buffer.Blackout();
  auto next = std::chrono::steady_clock::now();
  for (unsigned tick = 0;; ++tick) {
    for (unsigned slot = 0; slot < 32; ++slot) buffer.SetChannel(slot, (tick + slot) & 255u);
    for (unsigned universe = 1; universe <= universes; ++universe)
      if (!client.SendDmx(universe, buffer)) return 3;
    next += period;
    std::this_thread::sleep_until(next);
  }
}
