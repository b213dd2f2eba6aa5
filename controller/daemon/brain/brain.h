// SPDX-License-Identifier: Apache-2.0
// The brain: knows the studio, the moods, the looks and what the hand does; carries out what an
// operator asks. Thread-bound to the loop; the planner, the cameras and slow errands have threads
// of their own and hand their results to the loop.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controller/camera/watch.h"
#include "controller/daemon/brain/console.h"
#include "controller/daemon/brain/placements.h"
#include "controller/daemon/brain/planner.h"
#include "controller/daemon/brain/tracking.h"
#include "controller/daemon/hand_link.h"
#include "controller/design/moods.h"
#include "controller/panel/api.h"
#include "controller/ports/world.h"
#include "controller/store/store.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {

class Brain final : public panel::Brain {
 public:
  /// Reads studio, moods and store, takes the brain's end of the boxes, starts planner and
  /// cameras. Problems: all of the studio file's, or another brain is running.
  static core::Result<std::unique_ptr<Brain>> open(ports::World& world,
                                                   const std::filesystem::path& studio_file,
                                                   Post post);
  ~Brain() override;

  const panel::State& state() const override { return state_; }
  const panel::Counters& counters() const override { return counters_; }
  std::vector<panel::LookEntry> looks() const override;
  std::variant<panel::PictureFile, panel::Refusal> picture(const panel::PictureOf& which) override;
  void perform(const panel::Gesture& gesture, panel::Answer answer) override;

  /// Hears the hand, speaks to it when due, answers who waits for it, renews the state. To be
  /// called about every 20 ms.
  void tick(ports::TimePoint now);
  /// JSON messages for every listener since the last call.
  std::vector<std::string> events();
  /// Called on the loop with each new camera picture (JPEG).
  void watch_cameras(
      std::function<void(const std::string&, std::shared_ptr<const std::string>)> f) {
    show_ = std::move(f);
  }
  void count_traffic(std::uint64_t requests, std::size_t listeners, std::size_t watchers);

 private:
  /// Looks that nobody named are kept for undo and for looking back, up to this many.
  static constexpr std::size_t kMostNameless = 50;
  struct Live {
    store::LookRecord record;
    design::Look look;
    std::vector<std::string> advice;  ///< what lamps alone cannot do of the last nudge
  };
  struct Job {
    panel::JobView view;
    panel::StartDesign ask;
    std::shared_ptr<JobBoard> board;
  };
  /// Answered only once the hand has taken the wish.
  struct Waiting {
    std::uint64_t id = 0;
    bool motion = false;  ///< the motion stop; else blackout
    ports::TimePoint until;
    panel::Answer answer;
  };
  struct Eye {
    std::atomic<bool> stop{false};
    std::shared_ptr<const std::string> jpeg;
    std::unique_ptr<camera::Watch> watch;
  };

  Brain(ports::World& world, Post post)
      : world_(world), post_(post), tracking_(world.clock, post), planner_(world.clock, post) {}
  core::Result<core::Done> start(const std::filesystem::path& studio_file);
  core::Result<core::Done> take_studio(studio::Loaded loaded);
  void prepare_twin();
  void open_cameras();
  void remember_live();

  void hear_surfaces();
  void obey_surface(const studio::Deed& deed, double times);

  // One for each gesture.
  void carry_out(const panel::StartDesign& ask, const panel::Answer& answer);
  void carry_out(const panel::CancelDesign& cancel, const panel::Answer& answer);
  void carry_out(const panel::Nudge& nudge, const panel::Answer& answer);
  void carry_out(const panel::WorkLight& light, const panel::Answer& answer);
  void carry_out(const panel::SaveLook& save, const panel::Answer& answer);
  void carry_out(const panel::RenameLook& rename, const panel::Answer& answer);
  void carry_out(const panel::ApplyLook& apply, const panel::Answer& answer);
  void carry_out(const panel::DeleteLook& remove, const panel::Answer& answer);
  void carry_out(const panel::Undo& undo, const panel::Answer& answer);
  void carry_out(const panel::SetFixture& set, const panel::Answer& answer);
  void carry_out(const panel::SetMaster& set, const panel::Answer& answer);
  void carry_out(const panel::Placed& placed, const panel::Answer& answer);
  void carry_out(const panel::Measured& measured, const panel::Answer& answer);
  void carry_out(const panel::TrySlots& slots, const panel::Answer& answer);
  void carry_out(const panel::LearnLamp& lamp, const panel::Answer& answer);
  void carry_out(const panel::TrackSubject& track, const panel::Answer& answer);
  void carry_out(const panel::Reload& reload, const panel::Answer& answer);
  void carry_out(const panel::MotionStop& stop, const panel::Answer& answer);
  void carry_out(const panel::Blackout& blackout, const panel::Answer& answer);
  void carry_out(const panel::AddMood& mood, const panel::Answer& answer);
  void keep_mood(panel::AddMood mood, const panel::Answer& answer);
  void carry_out(const panel::RemoveMood& mood, const panel::Answer& answer);

  // Jobs and looks.
  core::Result<GoalReader> goal_of(const panel::StartDesign& ask) const;
  /// Cancels what runs and gives the planner `task` in its place; answers 202.
  void begin(const panel::StartDesign& ask, DesignTask task, const panel::Answer& answer);
  /// Even light from the front, as far as the lamps reach.
  studio::Rig work_light() const;
  design::Look flat_look() const;
  void renew_work_light(double fade_s);
  bool drawn_on_our_sitter(const panel::StartDesign& ask) const;
  DesignTask task_of(const panel::StartDesign& ask, GoalReader goal) const;
  bool running() const { return job_ && job_->view.status <= panel::JobStatus::running; }
  /// `back`: a first answer that is on the lamps already gives way to the live look again.
  void cancel_running(bool back = true);
  void first_light(std::uint64_t job, const studio::Rig& placed);
  void take_back_first_light();
  void finished(std::uint64_t job, core::Result<Designed> result);
  void keep(const panel::StartDesign& ask, Designed designed);
  std::optional<Live> load(std::int64_t look, panel::Refusal& refusal) const;
  /// As it can be asked for again; an empty request when the look does not say.
  std::string request_of(const std::string& look_json) const;
  /// Pictures as large as the camera's, once there is time for them.
  void draw(std::int64_t look, studio::Rig wanted, studio::Rig placed);
  core::Result<core::Done> keep_placements();
  /// Applies now, or first solves the levels for where the lamps stand by now.
  void go_live(Live live, double fade_s, bool remember_last);
  void solve_again(double fade_s);
  /// The live look for the light to keep; one object as long as nothing of it changes.
  std::shared_ptr<const TrackedLook> tracked_look();
  void take_frame(core::Result<Followed> followed);
  void solved_again(std::int64_t look, double fade_s, core::Result<Designed> result);

  // The state.
  void changed() { dirty_ = true; }
  void renew_state();
  panel::FixtureView view_of(std::size_t fixture, const studio::Rig& rig) const;
  std::optional<panel::LookView> live_view(const studio::Rig& rig) const;
  std::optional<panel::Instruction> instruction_for(std::size_t fixture) const;
  /// The studio with its stands, knobs and outputs as they are now.
  const studio::Studio& standing() const;
  /// What the lamps are being told, on the standing studio.
  studio::Rig sent_rig() const;
  void hear(ports::TimePoint now);
  /// Takes over what the hand does before the first word to it, once.
  void adopt(ports::TimePoint now);
  void speak(ports::TimePoint now);
  void answer_waiting(ports::TimePoint now);
  void tell_progress();
  void pace_cameras();

  ports::World& world_;
  Post post_;
  std::unique_ptr<store::Store> store_;
  studio::Studio studio_;
  core::Problems warnings_;
  design::Moods moods_;
  std::optional<Placements> placements_;
  mutable std::optional<studio::Studio> standing_;  ///< forgotten when a placement changes
  std::optional<Console> console_;
  std::unique_ptr<HandLink> link_;
  std::optional<rig::Sent> sent_;
  std::vector<studio::Deed> asks_;  ///< what surfaces may ask for, and how often they have
  std::vector<double> asked_;
  std::uint64_t asks_id_ = 0;
  bool hand_alive_ = false, adopted_ = false, spoken_ = false, ready_ = false;
  ports::TimePoint started_, last_word_, last_renewal_, last_counters_;
  core::Problems twin_problems_;
  std::vector<std::string> notes_;  ///< what went wrong lately, for people

  std::optional<Live> live_;
  std::uint64_t edition_ = 0;  ///< of the live look's pictures
  panel::TrySlots tried_;
  ports::TimePoint tried_until_;
  std::vector<std::int64_t> history_;  ///< looks that were live before, newest last
  std::optional<Job> job_;
  std::uint64_t jobs_ = 0, studio_turn_ = 0;
  std::shared_ptr<const TrackedLook> tracked_;  ///< null: nobody tracks the subject
  std::uint64_t trackings_ = 0;
  std::shared_ptr<JobBoard> again_;  ///< of the solve-again that is under way
  std::map<std::string, std::shared_ptr<Eye>> eyes_;
  std::function<void(const std::string&, std::shared_ptr<const std::string>)> show_;
  std::vector<Waiting> waiting_;

  std::size_t watchers_ = 0;
  panel::State state_;
  panel::Counters counters_;
  std::string told_;  ///< the last state told, without counters
  std::deque<std::string> events_;
  bool dirty_ = true;
  std::shared_ptr<bool> here_ = std::make_shared<bool>(true);
  Worker errands_;  // slow talks with the hand
  Worker reader_;   // photographs that were sent
  // Last: their threads use what is above through the loop only.
  Tracking tracking_;
  Planner planner_;
};

}  // namespace chiaro::daemon
