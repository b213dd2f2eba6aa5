// SPDX-License-Identifier: Apache-2.0
// A planner busy on every core: arithmetic over more memory than the caches hold, for ever.
// `soak_load idle` runs SCHED_IDLE, as our planner does beside a hand without real-time rights.
#include <pthread.h>
#include <sched.h>
#include <string_view>
#include <thread>
#include <vector>

int main(int count, char** words) {
  const bool idle = count > 1 && std::string_view(words[1]) == "idle";
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i)
    threads.emplace_back([idle] {
      if (idle) {
        const sched_param none{};
        pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);
      }
      std::vector<float> layers(16u << 20u, 0.5f);
      for (float k = 1;; k += 1e-3f) {
        for (float& value : layers) value = value * 0.999f + k * 1e-6f;
        asm volatile("" : : "r"(layers.data()) : "memory");  // somebody might read them
      }
    });
  for (auto& thread : threads) thread.join();
}
