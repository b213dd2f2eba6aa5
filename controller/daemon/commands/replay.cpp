// SPDX-License-Identifier: Apache-2.0
// `chiaro replay FILE [STUDIO]`: what a recording holds; with a studio, sent again through its
// outputs, frame by frame as it was.
#include "controller/daemon/output/replay.h"

#include <CLI/CLI.hpp>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "controller/daemon/command.h"
#include "controller/daemon/file_lock.h"
#include "controller/daemon/output/identity.h"
#include "controller/daemon/output/port_plan.h"
#include "controller/daemon/problems.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

struct Asked {
  std::string file, studio;
  bool dry_run = false, loop = false;
};

std::string date_of(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  std::array<char, 32> text{};
  if (::gmtime_r(&time, &parts) == nullptr) return "an unknown time";
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts);
  return text.data();
}

/// What it holds, without sending anything.
ports::Exit look_into(TapeReader& tape, ports::World& world, bool json) {
  std::set<std::uint16_t> universes;
  std::uint64_t ticks = 0, frames = 0;
  ports::Duration length{};
  while (tape.next()) {
    ++ticks;
    frames += tape.sent().size();
    length = tape.at();
    for (const auto* frame : tape.sent()) universes.insert(frame->universe);
  }
  const double seconds = std::chrono::duration<double>(length).count();
  world.err << core::to_string(tape.broke_off());
  if (json)
    world.out << Json{{"studio", tape.head().studio},
                      {"started", tape.head().started},
                      {"seconds", seconds},
                      {"ticks", ticks},
                      {"frames", frames},
                      {"universes", universes},
                      {"whole", tape.broke_off().empty()}}
                     .dump()
              << "\n";
  else
    world.out << "'" << tape.head().studio << "', " << date_of(tape.head().started) << ": "
              << seconds << " s, " << ticks << " ticks, " << frames << " frames of "
              << universes.size() << (universes.size() == 1 ? " universe\n" : " universes\n");
  return tape.broke_off().empty() ? ports::Exit::done : ports::Exit::input_has_problems;
}

core::Result<std::vector<std::unique_ptr<PortSlot>>> ports_of(const studio::Studio& studio,
                                                              const Asked& asked,
                                                              drivers::Surroundings& around,
                                                              ports::World& world) {
  core::Problems warnings;
  const Cid cid = kept_cid(world.state_folder, warnings);
  std::vector<std::unique_ptr<PortSlot>> slots;
  for (const auto& output : studio.outputs) {
    const PortPlan plan = plan_of(studio, output, cid);
    slots.push_back(std::make_unique<PortSlot>(plan.driver, plan.settings,
                                               open_port(plan, asked.dry_run, around, warnings),
                                               plan.rate_hz, world.clock, false));
    slots.back()->start(world.clock.now());
  }
  if (!warnings.empty()) return warnings;
  return slots;
}

ports::Exit play(const Asked& asked, ports::World& world, bool json) {
  const auto loaded = studio::load_studio(asked.studio, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  if (const auto made = make_runtime_folder(world.runtime_folder); !made)
    return refuse(made.problems(), world, json);
  // One program at a time speaks to the lamps.
  const auto lock = FileLock::take(world.runtime_folder / "output.lock", "chiaro-output");
  drivers::Surroundings around{world.network, world.devices, world.clock};
  auto slots = lock ? ports_of(loaded->studio, asked, around, world) : lock.problems();
  if (!slots) {
    refuse(slots.problems(), world, json);
    return ports::Exit::out_of_reach;
  }
  Replayed all;
  core::Problems broke_off;
  do {
    auto tape = TapeReader::open(asked.file);
    if (!tape) return refuse(tape.problems(), world, json);
    const Replayed once = replay(**tape, *slots, world.clock, world.clock.now(), world.stop);
    all.ticks += once.ticks;
    all.frames += once.frames;
    all.nowhere = once.nowhere;
    broke_off = (*tape)->broke_off();
    if (once.ticks == 0) break;
  } while (asked.loop && !world.stop);
  for (auto& slot : *slots) slot->release(world.clock.now());
  world.err << core::to_string(broke_off);
  for (const auto& [universe, frames] : all.nowhere)
    world.err << asked.studio << ": universe " << universe
              << " is on the recording and has no output here\n";
  if (json)
    world.out
        << Json{{"ticks", all.ticks}, {"frames", all.frames}, {"whole", broke_off.empty()}}.dump()
        << "\n";
  else
    world.err << all.frames << " frames in " << all.ticks << " ticks were sent"
              << (asked.dry_run ? " nowhere: a dry run.\n" : ".\n");
  return broke_off.empty() ? ports::Exit::done : ports::Exit::input_has_problems;
}

}  // namespace

void declare_replay(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "replay", "what a recording holds; with a studio: sent again, frame by frame as it was");
  auto asked = std::make_shared<Asked>();
  verb->add_option("FILE", asked->file, "made by `chiaro record`")->required();
  verb->add_option("STUDIO", asked->studio,
                   "whose outputs send it; chiaro-output must not run meanwhile");
  verb->add_flag("--dry-run", asked->dry_run, "do everything, but open nothing physical");
  verb->add_flag("--loop", asked->loop, "again and again, until Ctrl-C");
  verb->callback([&world, &verdict, asked] {
    auto tape = TapeReader::open(asked->file);
    if (!tape)
      verdict.exit = refuse(tape.problems(), world, verdict.json);
    else if (asked->studio.empty())
      verdict.exit = look_into(**tape, world, verdict.json);
    else
      verdict.exit = play(*asked, world, verdict.json);
  });
}

}  // namespace chiaro::daemon
