// SPDX-License-Identifier: Apache-2.0
// Opening, and the brain's turn of the loop.
#include "controller/daemon/brain/brain.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/studio/load.h"
#include "drivers/registry.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::ordered_json;
/// How long a starting brain waits for a hand that may know more than its store does.
constexpr ports::Duration kAdoptionPatience = std::chrono::milliseconds(1500);
constexpr ports::Duration kRenewal = std::chrono::milliseconds(100);
constexpr ports::Duration kCounters = std::chrono::seconds(1);
/// Pictures of a camera: often while somebody looks, seldom while nobody does or a design runs.
constexpr ports::Duration kWatched = std::chrono::milliseconds(125),
                          kUnwatched = std::chrono::seconds(1);
constexpr int kJpegQuality = 85;

panel::Refusal not_taken() {
  return {503, "the output process has not answered: the lights may not have changed", "blackout",
          "run 'chiaro blackout on', or switch the lamps off at the mains"};
}

panel::Refusal not_stopped() {
  return {503, "the output process has not answered: motion may not have stopped", "motion-stop",
          "run 'chiaro motion stop', or use the emergency stop of the axes"};
}

}  // namespace

core::Result<std::unique_ptr<Brain>> Brain::open(ports::World& world,
                                                 const std::filesystem::path& studio_file,
                                                 Post post) {
  std::unique_ptr<Brain> brain(new Brain(world, std::move(post)));
  if (auto started = brain->start(studio_file); !started) return started.problems();
  return brain;
}

Brain::~Brain() {
  *here_ = false;
  if (job_) job_->board->stop = true;
  if (again_) again_->stop = true;
  for (auto& [name, eye] : eyes_) eye->stop = true;
}

core::Result<core::Done> Brain::start(const std::filesystem::path& studio_file) {
  const studio::Folders folders{world_.config_folder};
  auto loaded = studio::load_studio(studio_file, folders);
  if (!loaded) return loaded.problems();
  auto store = store::Store::open(world_.state_folder / "chiaro.sqlite");
  if (!store) return store.problems();
  store_ = std::move(*store);
  moods_ = design::load_moods(folders.moods());
  started_ = world_.clock.now();
  if (auto taken = take_studio(std::move(*loaded)); !taken) return taken;
  const Json kept = Json::parse(store_->get("live").value_or("{}"), nullptr, false);
  panel::Refusal ignored;
  if (kept.is_object() && kept.contains("look") && kept["look"].is_number_integer())
    live_ = load(kept["look"].get<std::int64_t>(), ignored);
  if (kept.is_object() && kept.contains("before") && kept["before"].is_array())
    for (const Json& id : kept["before"])
      if (id.is_number_integer()) history_.push_back(id.get<std::int64_t>());
  store_->note("brain started with " + studio_.file.string());
  renew_state();
  return core::Done{};
}

core::Result<core::Done> Brain::take_studio(studio::Loaded loaded) {
  link_.reset();  // its lock passes on to the new one
  auto link = HandLink::open(world_.runtime_folder, loaded.studio);
  if (!link) return link.problems();
  link_ = std::move(*link);
  if (console_)
    console_->carry_to(studio_, loaded.studio);
  else
    console_.emplace(loaded.studio);
  studio_ = std::move(loaded.studio);
  warnings_ = std::move(loaded.warnings);
  placements_.emplace(studio_, store_->get("placed:" + studio_.name).value_or(""));
  standing_.reset();
  sent_.reset();
  ++studio_turn_;
  prepare_twin();
  open_cameras();
  changed();
  return core::Done{};
}

void Brain::prepare_twin() {
  ready_ = false;
  twin_problems_.clear();
  planner_.prepare(standing(), world_.state_folder / "meshes",
                   [this, here = here_, turn = studio_turn_](core::Problems problems) {
                     if (!*here || turn != studio_turn_) return;
                     ready_ = true;
                     twin_problems_ = std::move(problems);
                     changed();
                   });
}

void Brain::open_cameras() {
  for (auto& [name, eye] : eyes_) eye->stop = true;
  eyes_.clear();
  for (const studio::Camera& camera : studio_.cameras) {
    const auto eye = std::make_shared<Eye>();
    eyes_[camera.name] = eye;
    if (camera.source.empty()) continue;
    auto driver = drivers::make_camera({camera.source, &eye->stop}, world_.clock);
    if (!driver) {
      warnings_.insert(warnings_.end(), driver.problems().begin(), driver.problems().end());
      continue;
    }
    const std::weak_ptr<Eye> weak = eye;
    eye->watch = std::make_unique<camera::Watch>(
        std::move(*driver), world_.clock, camera::Watch::Pace{},
        [this, weak, here = here_, name = camera.name](const camera::Watch::Frame& frame) {
          const auto bytes = core::encode_jpeg(frame->picture, kJpegQuality);
          auto jpeg = std::make_shared<const std::string>(bytes.begin(), bytes.end());
          post_([this, weak, here, name, jpeg] {
            const auto seen = weak.lock();
            if (!*here || !seen) return;
            seen->jpeg = jpeg;
            if (show_) show_(name, jpeg);
          });
        });
  }
}

void Brain::remember_live() {
  Json json = {{"look", live_ ? live_->record.id : 0}, {"before", history_}};
  if (auto kept = store_->set("live", json.dump()); !kept)
    notes_.push_back(core::to_string(kept.problems()));
}

void Brain::tick(ports::TimePoint now) {
  hear(now);
  speak(now);
  answer_waiting(now);
  if (world_.reload.exchange(false)) perform(panel::Reload{}, [](const panel::Outcome&) {});
  if (now - last_renewal_ < kRenewal && !dirty_) return;
  last_renewal_ = now;
  dirty_ = false;
  tell_progress();
  pace_cameras();
  renew_state();
  const std::string telling = panel::state_to_json(state_, false);
  if (telling == told_ && now - last_counters_ < kCounters) return;
  if (telling != told_) ++state_.version;
  told_ = telling;
  last_counters_ = now;
  events_.push_back(R"({"type":"state","state":)" + panel::state_to_json(state_) + "}");
}

void Brain::hear(ports::TimePoint now) {
  if (auto report = link_->report()) {
    constexpr auto kOwn = static_cast<std::size_t>(rig::Source::own);
    if (sent_ && (sent_->blackout != report->blackout || sent_->masters != report->masters ||
                  sent_->sources[kOwn].fade_id != report->sources[kOwn].fade_id))
      changed();
    sent_ = std::move(report);
  }
  hear_surfaces();
  const bool alive = link_->hand_alive(now);
  if (alive != hand_alive_) changed();
  hand_alive_ = alive;
  const bool modest = alive && sent_ && !sent_->real_time;
  planner_.be_modest(modest);
  tracking_.be_modest(modest);
}

void Brain::adopt(ports::TimePoint now) {
  if (adopted_) return;
  if (const auto hand = link_->adopted()) console_->adopt(*hand);
  adopted_ = true;
  // A hand that knows no look (or none at all): the one that was live is wanted again.
  if (live_ && !console_->has_look()) console_->apply(studio_, live_->look.placed, 1.0, now);
  changed();
}

void Brain::speak(ports::TimePoint now) {
  if (!adopted_) {
    if (!link_->adopted() && now - started_ < kAdoptionPatience) return;
    adopt(now);
  }
  if (spoken_ && now - last_word_ < kHeartbeat / 2 && !dirty_) return;
  link_->post(console_->wanted(), now);
  spoken_ = true;
  last_word_ = now;
}

void Brain::answer_waiting(ports::TimePoint now) {
  std::vector<Waiting> still;
  for (Waiting& waiting : waiting_) {
    const std::uint64_t heard = !hand_alive_ || !sent_ ? 0
                                : waiting.motion       ? sent_->motion_stop.id
                                                       : sent_->blackout_id;
    if (heard >= waiting.id) {
      changed();
      waiting.answer({{},
                      200,
                      waiting.motion ? fmt::format(R"({{"motion_stop":{}}})", sent_->motion_stop.on)
                                     : fmt::format(R"({{"blackout":{}}})", sent_->blackout)});
    } else if (now >= waiting.until) {
      waiting.answer({waiting.motion ? not_stopped() : not_taken()});
    } else {
      still.push_back(std::move(waiting));
    }
  }
  waiting_ = std::move(still);
}

void Brain::tell_progress() {
  if (!job_ || (job_->view.status != panel::JobStatus::queued &&
                job_->view.status != panel::JobStatus::running))
    return;
  const JobBoard::Seen seen = job_->board->seen();
  panel::JobView& view = job_->view;
  const bool news = job_->board->started &&
                    (view.status == panel::JobStatus::queued || view.trial != seen.progress.trial);
  if (job_->board->started) view.status = panel::JobStatus::running;
  view.stage = job_->board->started ? seen.progress.stage : "preparing the preview";
  view.trial = seen.progress.trial;
  view.trials = seen.progress.trials;
  view.best = seen.progress.best;
  view.seconds = seen.seconds;
  if (news) events_.push_back(R"({"type":"design","design":)" + panel::job_to_json(view) + "}");
}

void Brain::pace_cameras() {
  const bool designing = job_ && job_->view.status <= panel::JobStatus::running;
  const ports::Duration period = watchers_ > 0 && !designing ? kWatched : kUnwatched;
  for (auto& [name, eye] : eyes_)
    if (eye->watch) eye->watch->set_period(period);
}

std::vector<std::string> Brain::events() {
  std::vector<std::string> told(events_.begin(), events_.end());
  events_.clear();
  return told;
}

void Brain::count_traffic(std::uint64_t requests, std::size_t listeners, std::size_t watchers) {
  watchers_ = watchers;
  counters_.requests = requests;
  counters_.event_listeners = listeners;
}

}  // namespace chiaro::daemon
