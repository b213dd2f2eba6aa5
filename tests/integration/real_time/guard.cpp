// SPDX-License-Identifier: Apache-2.0
// Each stand-in says its name and passes the call on. Calls that cannot keep their caller waiting
// (a datagram with MSG_DONTWAIT, waking somebody who waits) pass without a word.
#include "tests/integration/real_time/guard.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

namespace chiaro::real_time {
namespace {

enum class Watch : unsigned char { off, abort, count };
thread_local Watch watch = Watch::off;
constexpr std::size_t kMost = 64;
thread_local std::array<const char*, kMost> names{};
thread_local std::size_t count = 0;

void breach(const char* name) {
  if (watch == Watch::off) return;
  if (watch == Watch::count) {
    if (count < kMost) names[count++] = name;
    return;
  }
  watch = Watch::off;
  std::fprintf(stderr, "real-time breach: %s\n", name);
  std::abort();
}

/// The C library's own. Asked for without a lock or an allocation of ours: `dlsym` may come back in
/// here.
template <class Function>
Function* real(std::atomic<Function*>& kept, const char* name, const char* version = nullptr) {
  Function* function = kept.load(std::memory_order_relaxed);
  if (function == nullptr) {
    const Watch before = watch;
    watch = Watch::off;
    void* const found =
        version != nullptr ? ::dlvsym(RTLD_NEXT, name, version) : ::dlsym(RTLD_NEXT, name);
    function = reinterpret_cast<Function*>(found);
    kept.store(function, std::memory_order_relaxed);
    watch = before;
  }
  return function;
}

}  // namespace

RealTimeSection::RealTimeSection(OnBreach on_breach) {
  watch = on_breach == OnBreach::abort ? Watch::abort : Watch::count;
}
RealTimeSection::~RealTimeSection() { watch = Watch::off; }

std::vector<std::string> breaches() {
  std::vector<std::string> all(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count));
  count = 0;
  return all;
}

}  // namespace chiaro::real_time

using chiaro::real_time::breach;
using chiaro::real_time::real;

// The names are given to the assembler alone, so that no header's declaration is contradicted.
#define CHIARO_STAND_IN(name, result, parameters)          \
  extern "C" result stand_in_##name parameters asm(#name); \
  extern "C" result stand_in_##name parameters
#define CHIARO_WATCHED_AS(name, version, result, parameters, arguments) \
  CHIARO_STAND_IN(name, result, parameters) {                           \
    using Real = result parameters;                                     \
    static std::atomic<Real*> kept{nullptr};                            \
    breach(#name);                                                      \
    return real(kept, #name, version) arguments;                        \
  }
#define CHIARO_WATCHED(name, result, parameters, arguments) \
  CHIARO_WATCHED_AS(name, nullptr, result, parameters, arguments)

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

// Memory.
CHIARO_STAND_IN(malloc, void*, (std::size_t size)) {
  breach("malloc");
  return __libc_malloc(size);
}
CHIARO_STAND_IN(calloc, void*, (std::size_t n, std::size_t size)) {
  breach("calloc");
  return __libc_calloc(n, size);
}
CHIARO_STAND_IN(realloc, void*, (void* memory, std::size_t size)) {
  breach("realloc");
  return __libc_realloc(memory, size);
}
CHIARO_STAND_IN(aligned_alloc, void*, (std::size_t alignment, std::size_t size)) {
  breach("aligned_alloc");
  return __libc_memalign(alignment, size);
}
CHIARO_STAND_IN(memalign, void*, (std::size_t alignment, std::size_t size)) {
  breach("memalign");
  return __libc_memalign(alignment, size);
}
CHIARO_STAND_IN(posix_memalign, int, (void** into, std::size_t alignment, std::size_t size)) {
  breach("posix_memalign");
  *into = __libc_memalign(alignment, size);
  return *into == nullptr ? ENOMEM : 0;
}
CHIARO_STAND_IN(free, void, (void* memory)) {
  if (memory != nullptr) breach("free");
  __libc_free(memory);
}
CHIARO_WATCHED(mmap, void*,
               (void* at, std::size_t size, int rights, int flags, int file, long from),
               (at, size, rights, flags, file, from))
CHIARO_WATCHED(munmap, int, (void* at, std::size_t size), (at, size))

// Locks.
CHIARO_WATCHED(pthread_mutex_lock, int, (void* lock), (lock))
CHIARO_WATCHED(pthread_mutex_timedlock, int, (void* lock, const void* until), (lock, until))
CHIARO_WATCHED(pthread_mutex_clocklock, int, (void* lock, int clock, const void* until),
               (lock, clock, until))
CHIARO_WATCHED(pthread_rwlock_rdlock, int, (void* lock), (lock))
CHIARO_WATCHED(pthread_rwlock_wrlock, int, (void* lock), (lock))
CHIARO_WATCHED(pthread_spin_lock, int, (void* lock), (lock))

// Waits.
CHIARO_WATCHED_AS(pthread_cond_wait, "GLIBC_2.3.2", int, (void* condition, void* lock),
                  (condition, lock))
CHIARO_WATCHED_AS(pthread_cond_timedwait, "GLIBC_2.3.2", int,
                  (void* condition, void* lock, const void* until), (condition, lock, until))
CHIARO_WATCHED(pthread_cond_clockwait, int,
               (void* condition, void* lock, int clock, const void* until),
               (condition, lock, clock, until))
CHIARO_WATCHED(pthread_join, int, (unsigned long thread, void** result), (thread, result))
CHIARO_WATCHED(sem_wait, int, (void* semaphore), (semaphore))
CHIARO_WATCHED(sem_timedwait, int, (void* semaphore, const void* until), (semaphore, until))
CHIARO_WATCHED(sem_clockwait, int, (void* semaphore, int clock, const void* until),
               (semaphore, clock, until))
CHIARO_WATCHED(nanosleep, int, (const void* time, void* left), (time, left))
CHIARO_STAND_IN(clock_nanosleep, int, (int clock, int flags, const void* time, void* left)) {
  static std::atomic<int (*)(int, int, const void*, void*)> kept{nullptr};
  constexpr int kMonotonic = 1, kAbsolute = 1;
  breach(clock == kMonotonic && flags == kAbsolute ? "clock_nanosleep (monotonic, absolute)"
                                                   : "clock_nanosleep");
  return real(kept, "clock_nanosleep")(clock, flags, time, left);
}
CHIARO_WATCHED(usleep, int, (unsigned time), (time))
CHIARO_WATCHED(sleep, unsigned, (unsigned time), (time))
CHIARO_WATCHED(sched_yield, int, (), ())
CHIARO_WATCHED(poll, int, (void* waits, unsigned long n, int time), (waits, n, time))
CHIARO_WATCHED(ppoll, int, (void* waits, unsigned long n, const void* time, const void* mask),
               (waits, n, time, mask))
CHIARO_WATCHED(select, int, (int n, void* in, void* out, void* other, void* time),
               (n, in, out, other, time))
CHIARO_WATCHED(epoll_wait, int, (int descriptor, void* events, int most, int time),
               (descriptor, events, most, time))
/// std::atomic::wait and semaphores come here: futex (202 on x86-64, 98 on arm64).
CHIARO_STAND_IN(syscall, long, (long number, long a, long b, long c, long d, long e, long f)) {
  static std::atomic<long (*)(long, long, long, long, long, long, long)> kept{nullptr};
#if defined(__x86_64__)
  constexpr long kFutex = 202;
#else
  constexpr long kFutex = 98;
#endif
  constexpr long kCommand = 127, kWake = 1;
  if (number != kFutex || (b & kCommand) != kWake) breach("syscall");
  auto* function = kept.load();
  if (function == nullptr)
    kept = function = reinterpret_cast<decltype(function)>(::dlsym(RTLD_NEXT, "syscall"));
  return function(number, a, b, c, d, e, f);
}

// The time of day may be set at any moment: what must not care does not ask.
CHIARO_STAND_IN(clock_gettime, int, (int clock, void* into)) {
  static std::atomic<int (*)(int, void*)> kept{nullptr};
  constexpr int kTimeOfDay = 0, kCoarse = 5, kAtomicTime = 11;
  if (clock == kTimeOfDay || clock == kCoarse || clock == kAtomicTime)
    breach("clock_gettime (time of day)");
  return real(kept, "clock_gettime")(clock, into);
}
CHIARO_WATCHED(time, long, (long* into), (into))
CHIARO_WATCHED(gettimeofday, int, (void* into, void* zone), (into, zone))

// Files and logs.
CHIARO_WATCHED(open, int, (const char* file, int flags, unsigned mode), (file, flags, mode))
CHIARO_WATCHED(open64, int, (const char* file, int flags, unsigned mode), (file, flags, mode))
CHIARO_WATCHED(openat, int, (int folder, const char* file, int flags, unsigned mode),
               (folder, file, flags, mode))
CHIARO_WATCHED(fopen, void*, (const char* file, const char* mode), (file, mode))
CHIARO_WATCHED(fopen64, void*, (const char* file, const char* mode), (file, mode))
CHIARO_WATCHED(fclose, int, (void* file), (file))
CHIARO_WATCHED(read, long, (int file, void* into, std::size_t size), (file, into, size))
CHIARO_WATCHED(write, long, (int file, const void* bytes, std::size_t size), (file, bytes, size))
CHIARO_WATCHED(writev, long, (int file, const void* pieces, int n), (file, pieces, n))
CHIARO_WATCHED(pwrite, long, (int file, const void* bytes, std::size_t size, long at),
               (file, bytes, size, at))
CHIARO_WATCHED(fsync, int, (int file), (file))
CHIARO_WATCHED(fdatasync, int, (int file), (file))
CHIARO_WATCHED(rename, int, (const char* from, const char* to), (from, to))
CHIARO_WATCHED(fwrite, std::size_t,
               (const void* bytes, std::size_t size, std::size_t n, void* file),
               (bytes, size, n, file))
CHIARO_WATCHED(fputs, int, (const char* text, void* file), (text, file))
CHIARO_WATCHED(fputc, int, (int c, void* file), (c, file))
CHIARO_WATCHED(putc, int, (int c, void* file), (c, file))
CHIARO_WATCHED(puts, int, (const char* text), (text))
CHIARO_WATCHED(fflush, int, (void* file), (file))
CHIARO_WATCHED(vsyslog, void, (int priority, const char* format, std::va_list words),
               (priority, format, words))
CHIARO_STAND_IN(printf, int, (const char* format, ...)) {
  breach("printf");
  std::va_list words;
  va_start(words, format);
  const int written = std::vfprintf(stdout, format, words);
  va_end(words);
  return written;
}
CHIARO_STAND_IN(syslog, void, (int priority, const char* format, ...)) {
  breach("syslog");
  std::va_list words;
  va_start(words, format);
  stand_in_vsyslog(priority, format, words);
  va_end(words);
}
CHIARO_WATCHED(tcdrain, int, (int file), (file))
CHIARO_STAND_IN(ioctl, int, (int file, unsigned long request, void* argument)) {
  static std::atomic<int (*)(int, unsigned long, ...)> kept{nullptr};
  breach("ioctl");
  auto* function = kept.load();
  if (function == nullptr)
    kept = function = reinterpret_cast<decltype(function)>(::dlsym(RTLD_NEXT, "ioctl"));
  return function(file, request, argument);
}

// Sockets: only what comes back at once.
namespace {
constexpr int kDontWait = 0x40;
void breach_unless(int flags, const char* name) {
  if ((flags & kDontWait) == 0) breach(name);
}
}  // namespace
#define CHIARO_WATCHED_SOCKET(name, result, parameters, arguments) \
  CHIARO_STAND_IN(name, result, parameters) {                      \
    using Real = result parameters;                                \
    static std::atomic<Real*> kept{nullptr};                       \
    breach_unless(flags, #name);                                   \
    return real(kept, #name) arguments;                            \
  }
CHIARO_WATCHED_SOCKET(send, long, (int socket, const void* bytes, std::size_t size, int flags),
                      (socket, bytes, size, flags))
CHIARO_WATCHED_SOCKET(sendto, long,
                      (int socket, const void* bytes, std::size_t size, int flags, const void* to,
                       unsigned length),
                      (socket, bytes, size, flags, to, length))
CHIARO_WATCHED_SOCKET(sendmsg, long, (int socket, const void* message, int flags),
                      (socket, message, flags))
CHIARO_WATCHED_SOCKET(sendmmsg, int, (int socket, void* messages, unsigned n, int flags),
                      (socket, messages, n, flags))
CHIARO_WATCHED_SOCKET(recv, long, (int socket, void* into, std::size_t size, int flags),
                      (socket, into, size, flags))
CHIARO_WATCHED_SOCKET(recvfrom, long,
                      (int socket, void* into, std::size_t size, int flags, void* from,
                       unsigned* length),
                      (socket, into, size, flags, from, length))
CHIARO_WATCHED(connect, int, (int socket, const void* to, unsigned length), (socket, to, length))
CHIARO_WATCHED(accept, int, (int socket, void* from, unsigned* length), (socket, from, length))
