// SPDX-License-Identifier: Apache-2.0
// A brain that never rests: `soak_brain STUDIO RUNTIME` posts a new look of every lamp each second,
// with a fade of 0.9 s, so that the levels of all universes change in nearly every frame; and the
// heartbeat between.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "controller/daemon/hand_link.h"
#include "controller/studio/load.h"

int main(int count, char** words) {
  using namespace chiaro;
  if (count != 4) return std::fprintf(stderr, "soak_brain STUDIO RUNTIME CONFIG\n"), 2;
  const auto loaded = studio::load_studio(words[1], studio::Folders{words[3]});
  if (!loaded) return std::fputs(core::to_string(loaded.problems()).c_str(), stderr), 1;
  const auto link = daemon::HandLink::open(words[2], loaded->studio);
  if (!link) return std::fputs(core::to_string(link.problems()).c_str(), stderr), 3;
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
  look.fixtures.resize(loaded->studio.fixtures.size());
  look.fade_s = 0.9;
  for (int tick = 0;; ++tick) {
    if (tick % 4 == 0) {
      ++look.fade_id;
      for (std::size_t i = 0; i < look.fixtures.size(); ++i)
        look.fixtures[i].set(core::Dof::intensity,
                             0.5 + 0.4 * std::sin(0.7 * tick + static_cast<double>(i)));
    }
    (*link)->post(wanted, ports::TimePoint(std::chrono::steady_clock::now()));
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
}
