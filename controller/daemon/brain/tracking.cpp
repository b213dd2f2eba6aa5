// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/tracking.h"

#include <algorithm>

#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/refusals.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon {
namespace {

/// A tracker that pauses must not make up for it in one step.
constexpr double kUsual = 1.0 / 30, kLongest = 0.25;
constexpr double kBack = 1.5;  // seconds, to the look as it was

}  // namespace

void Tracking::follow(std::shared_ptr<const TrackedLook> look, std::filesystem::path mesh_cache,
                      Pose pose, std::function<void(core::Result<Followed>)> done) {
  {
    const std::lock_guard lock(mutex_);
    const bool under_way = waiting_.has_value();
    waiting_ = Wanted{std::move(look), std::move(mesh_cache), pose, std::move(done)};
    if (under_way) return;
  }
  worker_.add([this] { next(); });
}

void Tracking::stop() {
  const std::lock_guard lock(mutex_);
  waiting_.reset();
  worker_.add([this] {
    follower_.reset();
    look_.reset();
  });
}

void Tracking::next() {
  std::optional<Wanted> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted.swap(waiting_);
  }
  if (!wanted) return;
  daemon::be_modest(modest_);
  const auto result = std::make_shared<core::Result<Followed>>([&]() -> core::Result<Followed> {
    try {
      return frame(*wanted);
    } catch (const std::exception& fault) {  // must not take the daemon down with it
      return core::Problem{{}, fault.what(), "this is a fault of Chiaro: please report it"};
    }
  }());
  post_([done = wanted->done, result] { done(std::move(*result)); });
}

core::Result<Followed> Tracking::frame(const Wanted& wanted) {
  const ports::TimePoint now = clock_.now();
  double seconds = kUsual;
  if (follower_ && look_->edition == wanted.look->edition) {
    seconds = std::clamp(std::chrono::duration<double>(now - last_).count(), 0.0, kLongest);
  } else {
    follower_.reset();
    look_ = wanted.look;
    auto geometry = twin::build_geometry(look_->studio, wanted.mesh_cache);
    if (!geometry) return geometry.problems();
    about_ = (*geometry)->aim.origin;
    follower_ =
        std::make_unique<design::Follower>(look_->studio, *geometry, look_->look, look_->locked);
  }
  last_ = now;
  const render::Motion motion =
      render::turned_and_moved(about_, wanted.pose.turned, wanted.pose.moved);
  return Followed{follower_->follow(motion, seconds).rig, seconds};
}

std::shared_ptr<const TrackedLook> Brain::tracked_look() {
  std::vector<std::string> locked;
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i)
    if (placements_->locked(i)) locked.push_back(studio_.fixtures[i].name);
  if (tracked_ && tracked_->studio_turn == studio_turn_ && tracked_->locked == locked &&
      tracked_->look == live_->look.placed)
    return tracked_;
  auto look = std::make_shared<TrackedLook>();
  look->edition = ++trackings_;
  look->studio_turn = studio_turn_;
  look->studio = standing();
  look->look = live_->look.placed;
  look->locked = std::move(locked);
  return tracked_ = std::move(look);
}

void Brain::carry_out(const panel::TrackSubject& track, const panel::Answer& answer) {
  if (!track.moved) {
    tracking_.stop();
    if (tracked_ && live_) console_->follow(studio_, live_->look.placed, kBack, world_.clock.now());
    tracked_.reset();
    changed();
    return answer({});
  }
  if (!live_)
    return answer({panel::Refusal{409, "there is no look for the light to keep", "subject",
                                  "design or apply one first"}});
  if (ready_ && any_error(twin_problems_)) return answer({refusal_of(twin_problems_)});
  const auto look = tracked_look();
  tracking_.follow(look, world_.state_folder / "meshes", {*track.moved, track.turned},
                   [this, here = here_, look](core::Result<Followed> followed) {
                     if (*here && look == tracked_) take_frame(std::move(followed));
                   });
  answer({});
}

/// Sent at once: thirty times a second is too often to wait for the brain's turn.
void Brain::take_frame(core::Result<Followed> followed) {
  if (!followed) {
    notes_.push_back("the light does not follow: " + followed.problems().front().what);
    tracked_.reset();
    return changed();
  }
  const ports::TimePoint now = world_.clock.now();
  if (now < console_->faded()) return;           // a look's own fade is not cut short
  if (sent_ && sent_->cue.playing >= 0) return;  // nor is a cue ended
  console_->follow(studio_, followed->rig, followed->seconds, now);
  if (!adopted_) return;
  link_->post(console_->wanted(), now);
  last_word_ = now;
}

}  // namespace chiaro::daemon
