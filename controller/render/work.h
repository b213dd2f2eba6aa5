// SPDX-License-Identifier: Apache-2.0
// The counters behind render::work_done().
#pragma once

#include <atomic>
#include <cstdint>

namespace chiaro::render {

/// Relaxed: they are added up, never waited for.
class Counter {
 public:
  void operator+=(std::uint64_t n) { value_.fetch_add(n, std::memory_order_relaxed); }
  std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_{0};
};
struct Counters {
  Counter primary_rays, shadow_rays, layers, nodes;
};
Counters& work();

}  // namespace chiaro::render
