// SPDX-License-Identifier: Apache-2.0
// Counts what the calling thread allocates and frees. Include it in exactly one source of a test
// program: it replaces the program's operator new.
#pragma once

#include <cstdlib>
#include <new>

namespace chiaro::support {

inline thread_local long allocations_of_this_thread = 0;

/// Allocations and releases on this thread since construction.
class AllocationCount {
 public:
  AllocationCount() : before_(allocations_of_this_thread) {}
  long count() const { return allocations_of_this_thread - before_; }

 private:
  long before_;
};

}  // namespace chiaro::support

// Out of line: GCC 12 takes an inlined pair of these and malloc for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++chiaro::support::allocations_of_this_thread;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new[](std::size_t size) { return operator new(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  if (memory != nullptr) ++chiaro::support::allocations_of_this_thread;
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept { operator delete(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept {
  operator delete(memory);
}
