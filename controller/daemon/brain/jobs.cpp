// SPDX-License-Identifier: Apache-2.0
// Design jobs, and how a look becomes the live one.
#include <algorithm>
#include <fmt/format.h>

#include "controller/daemon/brain/asked.h"
#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/pictures.h"
#include "controller/daemon/brain/refusals.h"

namespace chiaro::daemon {
namespace {

constexpr std::size_t kMostHistory = 20;

/// The studio with its motors where `states` has them.
void keep_motors(studio::Studio& studio, const std::vector<core::FixtureState>& states) {
  using core::Dof;
  for (std::size_t i = 0; i < std::min(states.size(), studio.fixtures.size()); ++i)
    for (const Dof dof : {Dof::pan, Dof::tilt, Dof::arc, Dof::track})
      if (states[i].has(dof)) studio.fixtures[i].initial.set(dof, states[i].get(dof));
}

bool all_locked(const studio::Studio& studio, const Placements& placements) {
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].controlled && !placements.locked(i)) return false;
  return !studio.fixtures.empty();
}

}  // namespace

core::Result<GoalReader> Brain::goal_of(const panel::StartDesign& ask) const {
  if (ask.ideal) return GoalReader([] { return ReadGoal{design::IdealGoal{}, ""}; });
  const auto objective = ask.wavelet ? design::Objective::wavelet : design::Objective::perceptual;
  if (!ask.picture.empty()) return goal_like(ask.picture, ask.title, objective);
  for (const design::Mood& mood : moods_.moods)
    if (mood.name == ask.mood)
      return GoalReader([mood, objective]() -> core::Result<ReadGoal> {
        auto goal = design::goal_of(mood, objective);
        if (!goal) return goal.problems();
        return ReadGoal{*std::move(goal), ""};
      });
  if (auto own = store_->mood(ask.mood))
    return goal_like(std::move(own->picture), own->title, objective);
  return core::Problem{{}, "the mood '" + ask.mood + "' is gone", "choose another"};
}

/// The shipped moods show the shipped bust: on it they need neither alignment nor allowance for
/// skin and clothes. Anybody else's picture does, and so does any other sitter.
bool Brain::drawn_on_our_sitter(const panel::StartDesign& ask) const {
  const bool shipped = std::any_of(moods_.moods.begin(), moods_.moods.end(),
                                   [&](const design::Mood& mood) { return mood.name == ask.mood; });
  const auto bust = studio::Folders{world_.config_folder}.subjects() / "bust.ply";
  std::error_code code;
  return shipped && !studio_.subjects.empty() &&
         std::filesystem::equivalent(studio_.subjects.front().mesh, bust, code);
}

DesignTask Brain::task_of(const panel::StartDesign& ask, GoalReader goal) const {
  DesignTask task;
  task.studio = standing();
  task.goal = std::move(goal);
  task.board = std::make_shared<JobBoard>();
  task.nudge = steps_of(ask.nudges);
  task.options.seed = ask.seed;
  task.options.trials = ask.trials;
  task.options.budget_s = ask.budget_s;
  task.options.move_stands = ask.move_stands;
  task.options.align = task.options.normalise = true;
  task.options.locked = ask.lock;
  task.options.align = task.options.normalise = !drawn_on_our_sitter(ask);
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i) {
    const std::string& name = studio_.fixtures[i].name;
    if (placements_->locked(i) &&
        std::find(ask.lock.begin(), ask.lock.end(), name) == ask.lock.end())
      task.options.locked.push_back(name);
  }
  // Motors stand where the hand last sent them, not where the file has them at first.
  if (sent_) keep_motors(task.studio, sent_->fixtures);
  // A locked lamp keeps the light that it gives now.
  for (const std::string& name : task.options.locked)
    if (const auto i = studio_.fixture_index(name); i && sent_ && *i < sent_->fixtures.size())
      task.studio.fixtures[*i].initial.overlay(sent_->fixtures[*i]);
  return task;
}

void Brain::cancel_running(bool back) {
  if (!running()) return;
  if (back) take_back_first_light();
  job_->board->stop = true;
  job_->view.status = panel::JobStatus::cancelled;
  ++counters_.designs_cancelled;
  events_.push_back(R"({"type":"design","design":)" + panel::job_to_json(job_->view) + "}");
  changed();
}

void Brain::carry_out(const panel::StartDesign& ask, const panel::Answer& answer) {
  if (ready_ && any_error(twin_problems_)) return answer({refusal_of(twin_problems_)});
  if (all_locked(studio_, *placements_))
    return answer({panel::Refusal{409,
                                  "every lamp is locked",
                                  "lock",
                                  "unlock at least one: moods leave locked lamps alone",
                                  {}}});
  auto goal = goal_of(ask);
  if (!goal) return answer({refusal_of(goal.problems())});
  begin(ask, task_of(ask, std::move(*goal)), answer);
}

void Brain::begin(const panel::StartDesign& ask, DesignTask task, const panel::Answer& answer) {
  cancel_running(!ask.apply_fade_s);  // the newest click wins
  Job job{{}, ask, task.board};
  job.view.job = ++jobs_;
  job.view.mood = ask.mood;
  job.view.title = ask.title;
  job_ = job;
  const bool stands = std::any_of(
      studio_.fixtures.begin(), studio_.fixtures.end(), [](const studio::Fixture& fixture) {
        return std::holds_alternative<studio::StandMount>(fixture.mount);
      });
  if (ask.apply_fade_s && ask.move_stands && stands)
    task.first_light = [this, here = here_, id = job.view.job](const studio::Rig& placed) {
      if (*here) first_light(id, placed);
    };
  planner_.add(std::move(task),
               [this, here = here_, id = job.view.job](core::Result<Designed> result) {
                 if (*here) finished(id, std::move(result));
               });
  changed();
  answer({{}, 202, fmt::format(R"({{"job":{}}})", job.view.job)});
}

void Brain::first_light(std::uint64_t id, const studio::Rig& placed) {
  if (!running() || job_->view.job != id) return;
  job_->view.lit = true;
  console_->apply(studio_, placed, *job_->ask.apply_fade_s, world_.clock.now());
  changed();
}

void Brain::take_back_first_light() {
  if (!job_ || !job_->view.lit || !live_) return;
  console_->apply(studio_, live_->look.placed, *job_->ask.apply_fade_s, world_.clock.now());
}

void Brain::carry_out(const panel::CancelDesign& cancel, const panel::Answer& answer) {
  if (!running() || job_->view.job != cancel.job)
    return answer({panel::Refusal{404, fmt::format("job {} is not running", cancel.job), "job",
                                  "it has ended, or never was"}});
  cancel_running();
  answer({});
}

void Brain::finished(std::uint64_t id, core::Result<Designed> result) {
  if (!job_ || job_->view.job != id || job_->view.status == panel::JobStatus::cancelled) return;
  panel::JobView& view = job_->view;
  const JobBoard::Seen seen = job_->board->seen();
  view.stage = "";
  if (result) {
    view.trial = view.trials = result->look.trials;
    view.best = result->look.cost;
    view.seconds = result->look.seconds;
    counters_.trials += result->look.trials;
    counters_.design_seconds += result->look.seconds;
    keep(job_->ask, std::move(*result));
  } else {
    take_back_first_light();
    view.status = panel::JobStatus::failed;
    view.error = refusal_of(result.problems());
    view.seconds = seen.seconds;
  }
  ++(view.status == panel::JobStatus::done ? counters_.designs_done : counters_.designs_failed);
  events_.push_back(R"({"type":"design","design":)" + panel::job_to_json(view) + "}");
  changed();
}

void Brain::keep(const panel::StartDesign& ask, Designed designed) {
  Live live;
  live.look = std::move(designed.look);
  live.advice = std::move(designed.by_hand);
  store::LookRecord& record = live.record;
  record.name = ask.title;
  record.mood = ask.mood;
  record.verdict = design::name_of(live.look.judgement.verdict);
  record.request = asked_to_json(ask);
  record.json = std::move(designed.json);
  record.picture = std::move(designed.picture_png);
  record.placed_picture = std::move(designed.placed_png);
  if (!ask.picture.empty())
    record.reference = designed.reference.empty() ? ask.picture : std::move(designed.reference);
  const auto id = store_->save_look(record);
  if (!id) {
    job_->view.status = panel::JobStatus::failed;
    job_->view.error = refusal_of(id.problems());
    return;
  }
  record.id = *id;
  job_->view.look = *id;
  job_->view.status = panel::JobStatus::done;
  store_->note("look " + std::to_string(*id) + ": " + record.name + ", " + record.verdict);
  studio::Rig wanted = live.look.wanted, placed = live.look.placed;
  if (ask.apply_fade_s) go_live(std::move(live), *ask.apply_fade_s, true);
  store_->prune_looks(kMostNameless, live_ ? live_->record.id : *id);
  draw(*id, std::move(wanted), std::move(placed));
}

std::optional<Brain::Live> Brain::load(std::int64_t id, panel::Refusal& refusal) const {
  auto record = store_->look(id);
  if (!record) {
    refusal = {404, fmt::format("there is no look {}", id), "look", "see GET /api/v1/looks"};
    return std::nullopt;
  }
  auto look = design::look_from_json(studio_, record->json, record->name);
  if (!look) {
    refusal = refusal_of(look.problems());
    return std::nullopt;
  }
  return Live{std::move(*record), std::move(*look), {}};
}

void Brain::go_live(Live live, double fade_s, bool remember_last) {
  if (again_) again_->stop = true;
  if (remember_last && live_ && live_->record.id != live.record.id) {
    history_.push_back(live_->record.id);
    if (history_.size() > kMostHistory) history_.erase(history_.begin());
  }
  live_ = std::move(live);
  ++edition_;
  remember_live();
  changed();
  bool stands = true;
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i)
    stands = stands && stands_there(live_->look.placed.states[i], placements_->at(i));
  if (!stands) return solve_again(fade_s);
  console_->apply(studio_, live_->look.placed, fade_s, world_.clock.now());
}

void Brain::solve_again(double fade_s) {
  if (!live_) return;
  panel::StartDesign ask = asked_from_json(live_->record.request, live_->record.reference);
  const bool bent = steps_of(ask.nudges) != design::Nudge{};
  if (ask.flat && !bent) return renew_work_light(fade_s);
  ask.move_stands = false;
  auto goal = can_be_solved(ask) ? goal_of(ask) : core::Problem{{}, "", ""};
  if (!goal && !ask.flat) {
    // A look that came as a file has no goal to solve for: its levels are all there is.
    console_->apply(studio_, live_->look.placed, fade_s, world_.clock.now());
    return;
  }
  if (again_) again_->stop = true;
  DesignTask task = task_of(ask, goal ? std::move(*goal) : GoalReader{});
  if (ask.flat) task.from = flat_look();  // bent again from where the lamps stand now
  keep_motors(task.studio, live_->look.placed.states);
  task.options.mirrored = live_->look.mirrored;
  again_ = task.board;
  planner_.add(std::move(task), [this, here = here_, board = again_, id = live_->record.id,
                                 fade_s](core::Result<Designed> result) {
    if (*here && !board->stop) solved_again(id, fade_s, std::move(result));
  });
}

void Brain::solved_again(std::int64_t id, double fade_s, core::Result<Designed> result) {
  again_.reset();
  if (!live_ || live_->record.id != id) return;
  changed();
  if (!result) {
    notes_.push_back("the levels could not be solved again: " + result.problems().front().what);
    return;
  }
  design::Look& look = live_->look;
  if (asked_from_json(live_->record.request, "").flat) look.wanted = result->look.wanted;
  look.placed = result->look.placed;
  look.placed_judgement = result->look.placed_judgement;
  look.placed_picture = std::move(result->look.placed_picture);
  store::LookRecord& record = live_->record;
  record.json = design::look_to_json(studio_, look);
  record.placed_picture = std::move(result->placed_png);
  if (auto kept = store_->update_look(record); !kept)
    notes_.push_back(core::to_string(kept.problems()));
  ++edition_;
  console_->apply(studio_, look.placed, fade_s, world_.clock.now());
  draw(id, look.wanted, look.placed);
}

void Brain::draw(std::int64_t id, studio::Rig wanted, studio::Rig placed) {
  planner_.draw({standing(), std::move(wanted), std::move(placed)}, [this, here = here_,
                                                                     id](const Drawn& drawn) {
    if (!*here) return;
    if (live_ && live_->record.id == id) {
      live_->record.picture = drawn.wanted_png;
      live_->record.placed_picture = drawn.placed_png;
      ++edition_;
    }
    if (auto kept = store_->update_pictures(id, drawn.wanted_png, drawn.placed_png); !kept)
      notes_.push_back(core::to_string(kept.problems()));
    changed();
  });
}

}  // namespace chiaro::daemon
