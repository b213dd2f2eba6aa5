// SPDX-License-Identifier: Apache-2.0
// A recording of DMX as a file: which universe left when, with which levels; to the nanosecond of
// the loop's clock and to the byte, so that a replay is the same show again.
//
// Layout, all numbers little-endian:
//   head: "CHIAROTAPE" 0x1a, version (1 byte), Unix seconds of its begin (8), length of the
//         studio's name (1), the name
//   blocks, one for each time that was written out: "BLK!", size of the payload (4), checksum of
//   the
//         payload (8, FNV-1a), the payload
//   payload: ticks, each: nanoseconds since the tick before (varint), number of universes + 1
//         (varint), or 0: the same universes as in the tick before, none of them changed. Then for
//         each universe: its number (varint), and what changed since it was sent last: runs of
//         (slots passed over, slots that follow, those levels), ended by a run of 0 that follow.
// A universe starts as 512 zeros. A file that was cut off (a full disk, a power cut) is readable up
// to its last whole block: recordings are written out twenty times a second.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/clock.h"
#include "controller/ports/output.h"

namespace chiaro::daemon {

struct TapeHead {
  std::string studio;        ///< its name, for people; cut to 255 bytes
  std::int64_t started = 0;  ///< Unix seconds
};

class TapeWriter {
 public:
  /// Never writes over a file that is there.
  static core::Result<std::unique_ptr<TapeWriter>> create(const std::filesystem::path& file,
                                                          const TapeHead& head);
  ~TapeWriter();
  TapeWriter(const TapeWriter&) = delete;
  TapeWriter& operator=(const TapeWriter&) = delete;

  /// In the order of time; what has the same time is one tick.
  void add(ports::TimePoint at, const ports::DmxFrame& frame);
  /// Writes out what was added.
  core::Result<core::Done> flush();
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t ticks() const { return ticks_; }
  ports::Duration length() const { return at_ - begun_; }

 private:
  TapeWriter(int descriptor, std::filesystem::path file);
  core::Result<core::Done> write(std::span<const std::uint8_t> bytes);
  void end_tick();

  const int descriptor_;
  const std::filesystem::path file_;
  std::map<std::uint16_t, std::array<std::uint8_t, ports::kSlots>> levels_;
  std::vector<std::uint8_t> block_, tick_;
  std::vector<std::uint16_t> sent_, sent_before_;
  bool changed_ = false, any_ = false;
  ports::TimePoint begun_, at_, written_at_;
  std::uint64_t bytes_ = 0, ticks_ = 0;
};

class TapeReader {
 public:
  /// A problem when it is no recording, or of a newer version.
  static core::Result<std::unique_ptr<TapeReader>> open(const std::filesystem::path& file);

  const TapeHead& head() const { return head_; }
  /// The next tick; false at the end, whole or broken off.
  bool next();
  /// Of the newest tick: since the first one, and what left, in that order.
  ports::Duration at() const { return at_; }
  const std::vector<const ports::DmxFrame*>& sent() const { return sent_; }
  /// Why it broke off, once `next` has said false; nothing when it came to its end.
  const core::Problems& broke_off() const { return broke_off_; }

 private:
  explicit TapeReader(const std::filesystem::path& file);
  bool next_block();
  bool read_tick();
  bool read_changes(ports::DmxFrame& frame);
  bool number(std::uint64_t& value);
  void break_off(const std::string& what);

  const std::filesystem::path file_;
  std::ifstream in_;
  TapeHead head_;
  std::vector<std::uint8_t> block_;
  std::size_t read_ = 0;  ///< of the block
  std::map<std::uint16_t, ports::DmxFrame> frames_;
  std::vector<const ports::DmxFrame*> sent_;
  ports::Duration at_{};
  core::Problems broke_off_;
};

}  // namespace chiaro::daemon
