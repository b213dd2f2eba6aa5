// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/recorder.h"

#include <ctime>

namespace chiaro::daemon {

core::Result<core::Done> Recorder::start(const std::filesystem::path& file,
                                         const studio::Studio& studio) {
  const std::scoped_lock lock(mutex_);
  if (writer_)
    return core::Problem{
        {file_}, "a recording is under way already", "`chiaro record --stop` ends it"};
  auto writer =
      TapeWriter::create(file, {studio.name, static_cast<std::int64_t>(std::time(nullptr))});
  if (!writer) return writer.problems();
  writer_ = std::move(*writer);
  file_ = file.string();
  if (!tape_) {
    tape_ = std::make_unique<LiveTape>(studio.outputs.size());
    hand_.record_to(*tape_);
  }
  tape_->begin();
  return core::Done{};
}

core::Result<core::Done> Recorder::drain() {
  while (const LiveTape::Sent* sent = tape_->oldest()) {
    writer_->add(sent->at, sent->frame);
    tape_->taken();
  }
  return writer_->flush();
}

core::Problems Recorder::tick() {
  const std::scoped_lock lock(mutex_);
  if (!writer_) return {};
  const auto written = drain();
  if (written) return {};
  tape_->end();
  writer_.reset();
  return written.problems();
}

core::Result<Recorder::State> Recorder::stop() {
  const std::scoped_lock lock(mutex_);
  if (!writer_)
    return core::Problem{{}, "nothing is being recorded", "`chiaro record FILE` begins"};
  tape_->end();
  const auto written = drain();
  State state = state_now();
  state.on = false;
  writer_.reset();
  if (!written) return written.problems();
  return state;
}

Recorder::State Recorder::state() const {
  const std::scoped_lock lock(mutex_);
  return state_now();
}

Recorder::State Recorder::state_now() const {
  State state;
  state.on = writer_ != nullptr;
  state.file = file_;
  if (!writer_) return state;
  state.seconds = std::chrono::duration<double>(writer_->length()).count();
  state.ticks = writer_->ticks();
  state.bytes = writer_->bytes();
  state.lost = tape_->lost();
  return state;
}

}  // namespace chiaro::daemon
