// SPDX-License-Identifier: Apache-2.0
// A one-way box in shared memory: one process lays its newest state in, another takes it out, and
// neither can hurt the other. Either may be killed between any two stores: the reader then keeps
// the last good value. (A plain triple buffer breaks when its writer is killed between the store of
// the value and the store of the index.)
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "controller/core/result.h"

namespace chiaro::daemon {

enum class BoxKind : std::uint64_t { wanted = 1, sent = 2 };

/// What writer and reader must agree on; any difference is refused.
struct BoxFormat {
  BoxKind kind = BoxKind::wanted;
  std::uint64_t fingerprint = 0;  ///< of the studio
  std::size_t words = 0;          ///< of the value
};

// The memory: a header of 8 words, then kBoxSlots slots of {sequence, checksum, value}. Every word
// is touched through std::atomic_ref only.
inline constexpr std::size_t kBoxHeader = 8, kBoxSlots = 4, kSlotHeader = 2;
constexpr std::size_t box_words(std::size_t value_words) {
  return kBoxHeader + kBoxSlots * (kSlotHeader + value_words);
}
std::uint64_t slot_checksum(std::uint64_t sequence, std::span<const std::uint64_t> value);

/// All the stores of one post, in their order, through `store(word, value)`, which must be a
/// release store: production's is, a test's may stop anywhere. Precondition: sequence > 0.
///
/// The slot is first marked empty (0), so a reader that catches it half-written sees 0 or a
/// sequence that has changed; the checksum catches what a writer that died left behind.
template <class Store>
void lay_in(std::span<std::uint64_t> box, std::uint64_t sequence,
            std::span<const std::uint64_t> value, Store&& store) {
  const std::size_t at = kBoxHeader + sequence % kBoxSlots * (kSlotHeader + value.size());
  store(box[at], std::uint64_t{0});
  for (std::size_t i = 0; i < value.size(); ++i) store(box[at + kSlotHeader + i], value[i]);
  store(box[at + 1], slot_checksum(sequence, value));
  store(box[at], sequence);
}
struct ReleaseStore {
  void operator()(std::uint64_t& word, std::uint64_t value) const {
    std::atomic_ref(word).store(value, std::memory_order_release);
  }
};

/// Copies the newest whole value whose sequence is above `seen` into `into` and returns its
/// sequence; 0 when there is none. Then `into` may hold rubbish. Real-time.
std::uint64_t take_out(std::span<const std::uint64_t> box, std::uint64_t seen,
                       std::span<std::uint64_t> into);

void write_header(std::span<std::uint64_t> box, const BoxFormat& format);
/// Done, or in words why the two do not fit together.
core::Result<core::Done> check_header(std::span<const std::uint64_t> box, const BoxFormat& format);

/// A file mapped into memory.
class Mapping {
 public:
  Mapping(void* address, std::size_t bytes) : address_(address), bytes_(bytes) {}
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  std::span<std::uint64_t> words() const {
    return {static_cast<std::uint64_t*>(address_), bytes_ / sizeof(std::uint64_t)};
  }

 private:
  void* address_;
  std::size_t bytes_;
};

/// The writing end. The caller holds the lock that makes it the only one (file_lock.h).
class BoxWriter {
 public:
  /// Lays out a new empty box and puts it in the place of any old one, in one step.
  static core::Result<std::unique_ptr<BoxWriter>> create(const std::filesystem::path& file,
                                                         const BoxFormat& format);
  /// Real-time. Precondition: value.size() == format.words.
  void post(std::span<const std::uint64_t> value);

 private:
  explicit BoxWriter(std::unique_ptr<Mapping> memory) : memory_(std::move(memory)) {}
  std::unique_ptr<Mapping> memory_;
  std::uint64_t sequence_ = 0;
};

/// The reading end; the memory is mapped read-only.
class BoxReader {
 public:
  static core::Result<std::unique_ptr<BoxReader>> open(const std::filesystem::path& file,
                                                       const BoxFormat& format);
  /// True when a newer value was there; it is then in `into`. Otherwise `into` may hold rubbish.
  /// Real-time. Precondition: into.size() == format.words.
  bool read(std::span<std::uint64_t> into);
  /// True when another box, or none, is now in the file's place. Not real-time.
  bool replaced() const;

 private:
  BoxReader(std::unique_ptr<Mapping> memory, std::filesystem::path file, std::uint64_t identity)
      : memory_(std::move(memory)), file_(std::move(file)), identity_(identity) {}
  std::unique_ptr<Mapping> memory_;
  std::filesystem::path file_;
  std::uint64_t identity_;
  std::uint64_t seen_ = 0;
};

/// Tells one box file from the next in the same place; 0 when there is none.
std::uint64_t box_identity(const std::filesystem::path& file);

}  // namespace chiaro::daemon
