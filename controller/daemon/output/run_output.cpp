// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/run_output.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <ostream>
#include <thread>
#include <utility>
#include <vector>

#include "controller/daemon/file_lock.h"
#include "controller/daemon/output/control.h"
#include "controller/daemon/output/hand.h"
#include "controller/daemon/output/housekeeper.h"
#include "controller/daemon/output/identity.h"
#include "controller/daemon/output/last_levels.h"
#include "controller/daemon/output/real_time.h"
#include "controller/daemon/output/service.h"
#include "controller/daemon/output/surface_plan.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

using ports::Exit;

struct Arguments {
  std::string studio, state, on_stop = "release";
  bool dry_run = false, no_real_time = false;
};

void say(ports::World& world, const core::Problems& problems) {
  for (const auto& problem : problems)
    world.err << "chiaro-output: " << core::to_string(problem) << "\n";
  world.err.flush();
}

Exit refuse(ports::World& world, const core::Problems& problems, Exit exit) {
  say(world, problems);
  return exit;
}

/// The loop itself, and the whole of it.
void send_until_stopped(Hand& hand, ports::World& world, const std::atomic<bool>& release) {
  hand.start(world.clock.now());
  while (!world.stop && !release) {
    hand.frame(world.clock);
    world.clock.sleep_until(hand.next_deadline());
  }
  hand.finish();
}

void keep_house(Housekeeper& housekeeper, const Hand& hand, ports::World& world,
                const std::atomic<bool>& ended) {
  take_ordinary_time();
  Service service;
  bool told = false;
  while (!ended) {
    try {
      housekeeper.tick();
    } catch (const std::exception& fault) {  // the output goes on all the same
      if (!std::exchange(told, true))
        world.err << "chiaro-output: internal fault beside the output: " << fault.what()
                  << "\nThis is a bug in Chiaro: please report it." << std::endl;
    }
    service.alive(hand.frames());
    world.clock.sleep_until(world.clock.now() + Housekeeper::kTick);
  }
}

void announce(ports::World& world, const studio::Studio& studio, bool dry_run) {
  const auto count = [](std::size_t n, const std::string& word) {
    return std::to_string(n) + " " + word + (n == 1 ? "" : "s");
  };
  world.err << "chiaro-output: sending '" << studio.name
            << "': " << count(studio.fixtures.size(), "fixture") << ", "
            << count(studio.outputs.size(), "universe")
            << (dry_run ? " (dry run: nothing leaves this machine)" : "") << std::endl;
}

/// Runs one show until somebody stops it. The housekeeper and the control socket end first, so
/// that nobody is left who could reach the loop's state.
Exit perform(std::unique_ptr<Show> first, const Arguments& arguments, const Show::Options& options,
             ports::World& world) {
  const studio::Studio studio = first->studio();
  Hand hand(std::move(first));
  Housekeeper housekeeper(hand, arguments.studio, options, world);
  Desk desk(hand, *options.around, surface_plans, !arguments.no_real_time);
  housekeeper.serve(desk);
  std::atomic<bool> release{false}, ended{false};
  auto control = Control::open(world.runtime_folder / "output.sock",
                               Answers(hand, housekeeper, release, world.state_folder),
                               !arguments.no_real_time);
  if (!control) return refuse(world, control.problems(), Exit::out_of_reach);
  announce(world, studio, options.dry_run);
  housekeeper.tick();  // the brain's box, if there is one, before the first frame
  std::thread keeper([&] { keep_house(housekeeper, hand, world, ended); });
  if (!arguments.no_real_time) {
    core::Problems warnings;
    hand.show().set_real_time(take_real_time(warnings));
    say(world, warnings);
  }
  send_until_stopped(hand, world, release);
  ended = true;
  housekeeper.end();
  control->reset();
  keeper.join();
  housekeeper.finish();
  if (release || arguments.on_stop == "release") hand.show().release(world.clock.now());
  world.err << "chiaro-output: stopped"
            << (release || arguments.on_stop == "release" ? "" : "; the lamps hold their levels")
            << std::endl;
  return Exit::done;
}

Exit prepare_and_perform(const Arguments& arguments, ports::World& world) {
  const auto loaded = studio::load_studio(arguments.studio, studio::Folders{world.config_folder});
  if (!loaded) return refuse(world, loaded.problems(), Exit::input_has_problems);
  if (const auto made = make_runtime_folder(world.runtime_folder); !made)
    return refuse(world, made.problems(), Exit::out_of_reach);
  const auto lock = FileLock::take(world.runtime_folder / "output.lock", "chiaro-output");
  if (!lock) return refuse(world, lock.problems(), Exit::out_of_reach);

  core::Problems warnings = loaded->warnings;
  drivers::Surroundings around{world.network, world.devices, world.clock};
  Show::Options options;
  options.around = &around;
  options.dry_run = arguments.dry_run;
  options.real_time = !arguments.no_real_time;
  options.cid = kept_cid(world.state_folder, warnings);
  const auto held =
      read_last_levels(world.state_folder / "last-levels.json", loaded->studio, warnings);
  auto show =
      Show::make(loaded->studio, options, world, held ? &*held : nullptr, nullptr, warnings);
  say(world, warnings);
  if (!show) return refuse(world, show.problems(), Exit::out_of_reach);
  return perform(std::move(*show), arguments, options, world);
}

}  // namespace

Exit run_output(std::span<const std::string> words, ports::World& world) {
  Arguments arguments;
  CLI::App app{
      "Sends a studio's levels to its lamps, without a break, whether or not the brain "
      "(chiarod) runs.",
      "chiaro-output"};
  app.add_option("STUDIO", arguments.studio, "the studio file")->required();
  app.add_flag("--dry-run", arguments.dry_run, "do everything, but open nothing physical");
  app.add_option("--state", arguments.state,
                 "folder for what must survive a restart (default: $CHIARO_STATE, else "
                 "~/.local/state/chiaro)");
  app.add_option("--on-stop", arguments.on_stop,
                 "when stopped: 'release' tells receivers that this source ends, 'hold' lets the "
                 "lamps wait for its return")
      ->check(CLI::IsMember({"release", "hold"}))
      ->capture_default_str();
  app.add_flag("--no-real-time", arguments.no_real_time,
               "do not ask for real-time scheduling and locked memory");
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // CLI11 wants it so
  try {
    app.parse(reversed);
    ports::World mine{world.clock,
                      world.network,
                      world.devices,
                      world.in,
                      world.out,
                      world.err,
                      world.err_is_terminal,
                      world.config_folder,
                      world.state_folder,
                      world.runtime_folder,
                      world.stop,
                      world.reload};
    if (!arguments.state.empty()) mine.state_folder = arguments.state;
    return prepare_and_perform(arguments, mine);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, world.out, world.err) == 0 ? Exit::done : Exit::usage;
  } catch (const std::exception& fault) {
    world.err << "chiaro-output: internal fault: " << fault.what()
              << "\nThis is a bug in Chiaro: please report it with the lines above.\n";
    return Exit::internal_fault;
  }
}

}  // namespace chiaro::daemon
