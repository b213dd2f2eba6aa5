// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "controller/core/hash.h"
#include "controller/daemon/output/tape_file.h"
#include "controller/daemon/output/tape_marks.h"

namespace chiaro::daemon {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put_number(Bytes& into, std::uint64_t value) {
  while (value >= 0x80) {
    into.push_back(static_cast<std::uint8_t>(value | 0x80u));
    value >>= 7u;
  }
  into.push_back(static_cast<std::uint8_t>(value));
}

void put_fixed(Bytes& into, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    into.push_back(static_cast<std::uint8_t>(value >> 8u * i & 0xffu));
}

/// Runs that differ, with up to two equal slots bridged: a new run costs as much. True when
/// anything differs.
bool put_changes(Bytes& into, std::span<const std::uint8_t> before,
                 std::span<const std::uint8_t> now) {
  constexpr std::size_t kBridge = 2;
  bool any = false;
  std::size_t done = 0;
  for (std::size_t at = 0; at < now.size(); ++at) {
    if (before[at] == now[at]) continue;
    std::size_t end = at + 1, equal = 0;
    for (std::size_t i = end; i < now.size() && equal <= kBridge; ++i) {
      equal = before[i] == now[i] ? equal + 1 : 0;
      if (equal == 0) end = i + 1;
    }
    put_number(into, at - done);
    put_number(into, end - at);
    into.insert(into.end(), now.begin() + static_cast<std::ptrdiff_t>(at),
                now.begin() + static_cast<std::ptrdiff_t>(end));
    done = at = end;
    --at;
    any = true;
  }
  put_number(into, 0);
  put_number(into, 0);
  return any;
}

}  // namespace

TapeWriter::TapeWriter(int descriptor, std::filesystem::path file)
    : descriptor_(descriptor), file_(std::move(file)) {}
TapeWriter::~TapeWriter() {
  (void)flush();
  ::close(descriptor_);
}

core::Result<std::unique_ptr<TapeWriter>> TapeWriter::create(const std::filesystem::path& file,
                                                             const TapeHead& head) {
  const int descriptor =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0)
    return core::Problem{{file.string()},
                         std::string("cannot begin a recording here: ") + std::strerror(errno),
                         errno == EEXIST
                             ? "recordings are never written over: choose another name"
                             : "is its folder there, and may chiaro-output write in it?"};
  std::unique_ptr<TapeWriter> writer(new TapeWriter(descriptor, file));
  Bytes bytes(tape::kMagic.begin(), tape::kMagic.end());
  bytes.push_back(tape::kVersion);
  put_fixed(bytes, static_cast<std::uint64_t>(head.started), 8);
  const std::string name = head.studio.substr(0, 255);
  bytes.push_back(static_cast<std::uint8_t>(name.size()));
  bytes.insert(bytes.end(), name.begin(), name.end());
  if (const auto written = writer->write(bytes); !written) return written.problems();
  return writer;
}

void TapeWriter::add(ports::TimePoint at, const ports::DmxFrame& frame) {
  if (!any_) begun_ = written_at_ = at_ = at;
  if (any_ && at != at_) end_tick();
  any_ = true;
  at_ = at;
  auto& before = levels_[frame.universe];
  sent_.push_back(frame.universe);
  put_number(tick_, frame.universe);
  changed_ |= put_changes(tick_, before, frame.levels);
  before = frame.levels;
}

void TapeWriter::end_tick() {
  if (sent_.empty()) return;
  ++ticks_;
  put_number(block_, static_cast<std::uint64_t>((at_ - written_at_).count()));
  written_at_ = at_;
  if (!changed_ && sent_ == sent_before_) {
    put_number(block_, 0);
  } else {
    put_number(block_, sent_.size() + 1);
    block_.insert(block_.end(), tick_.begin(), tick_.end());
  }
  sent_before_.swap(sent_);
  sent_.clear();
  tick_.clear();
  changed_ = false;
}

core::Result<core::Done> TapeWriter::flush() {
  end_tick();
  if (block_.empty()) return core::Done{};
  Bytes bytes(tape::kBlock.begin(), tape::kBlock.end());
  put_fixed(bytes, block_.size(), 4);
  put_fixed(bytes, core::Fingerprint().add(block_).value(), 8);
  bytes.insert(bytes.end(), block_.begin(), block_.end());
  block_.clear();
  return write(bytes);
}

core::Result<core::Done> TapeWriter::write(std::span<const std::uint8_t> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto wrote = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0)
      return core::Problem{{file_.string()},
                           std::string("the recording cannot be written: ") + std::strerror(errno),
                           "it is readable up to here; make room and begin another"};
    done += static_cast<std::size_t>(wrote);
    bytes_ += static_cast<std::uint64_t>(wrote);
  }
  return core::Done{};
}

}  // namespace chiaro::daemon
