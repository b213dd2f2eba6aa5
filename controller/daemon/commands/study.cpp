// SPDX-License-Identifier: Apache-2.0
// `chiaro study`: the thesis's experiments and figures, made again. Each study writes its tables,
// plots and how to repeat it; `all` adds the table that sets the thesis beside what was found.
#include "controller/daemon/study/study.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/daemon/study/write.h"

namespace chiaro::daemon {
namespace {

using study::Study;

struct Wish {
  std::string name, out = "studies";
  study::Options options;
};

std::string list_of_studies() {
  std::size_t widest = 0;
  for (const Study& each : study::studies()) widest = std::max(widest, each.name.size());
  std::string text;
  for (const Study& each : study::studies())
    text += "  " + std::string(each.name) + std::string(widest + 2 - each.name.size(), ' ') +
            std::string(each.sentence) + "\n";
  return text;
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string command_of(const Study& one, const Wish& wish) {
  std::string text =
      "chiaro study " + std::string(one.name) + " --seed " + std::to_string(wish.options.seed);
  if (wish.options.quick) text += " --quick";
  if (wish.options.items > 0) text += " --items " + std::to_string(wish.options.items);
  return text + " --threads " + std::to_string(wish.options.threads);
}

struct Ran {
  study::Findings findings;
  study::Record record;
};

core::Result<Ran> run_one(const Study& one, const Wish& wish, ports::World& world) {
  study::Record record{std::string(one.name), command_of(one, wish), wish.options, 0, 0, utc_now()};
  const auto from = world.clock.now();
  auto findings = one.run(wish.options, world);
  if (!findings) return findings.problems();
  record.seconds = std::chrono::duration<double>(world.clock.now() - from).count();
  record.items = findings->items;
  const auto folder = std::filesystem::path(wish.out) / std::string(one.name);
  if (const auto written = study::write(folder, *findings, record); !written)
    return written.problems();
  world.err << one.name << ": written to " << folder.string() << "\n" << std::flush;
  return Ran{*std::move(findings), std::move(record)};
}

ports::Exit run_named(const Study& one, const Wish& wish, ports::World& world, bool json) {
  const auto ran = run_one(one, wish, world);
  if (!ran) return refuse(ran.problems(), world, json);
  if (json)
    world.out << study::to_json(one, ran->findings, ran->record) << "\n";
  else
    world.out << study::to_text(one, ran->findings, ran->record);
  return ports::Exit::done;
}

/// Every study in turn, then the table of claims.
ports::Exit run_all(const Wish& wish, ports::World& world, bool json) {
  std::vector<study::Claim> claims;
  nlohmann::json everything = nlohmann::json::array();
  for (const Study& one : study::studies()) {
    if (world.stop) break;
    world.err << one.name << " …\n" << std::flush;
    const auto ran = run_one(one, wish, world);
    if (!ran) return refuse(ran.problems(), world, json);
    claims.insert(claims.end(), ran->findings.claims.begin(), ran->findings.claims.end());
    if (json)
      everything.push_back(nlohmann::json::parse(study::to_json(one, ran->findings, ran->record)));
    else
      world.out << study::to_text(one, ran->findings, ran->record) << "\n" << std::flush;
  }
  const study::Table table = study::claims_table(claims);
  const auto written =
      study::write_text(std::filesystem::path(wish.out) / "claims.csv", study::to_csv(table));
  if (!written) return refuse(written.problems(), world, json);
  if (json)
    world.out << json_text(nlohmann::json{{"ok", true}, {"studies", everything}}) << "\n";
  else
    world.out << study::to_text(table);
  return ports::Exit::done;
}

ports::Exit run(const Wish& wish, ports::World& world, bool json) {
  if (wish.name == "all") return run_all(wish, world, json);
  for (const Study& one : study::studies())
    if (wish.name == one.name) return run_named(one, wish, world, json);
  return ports::Exit::usage;  // the parser lets no other name through
}

}  // namespace

void declare_study(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("study", "the thesis's experiments and figures, made again");
  auto wish = std::make_shared<Wish>();
  std::vector<std::string> names{"all"};
  for (const Study& one : study::studies()) names.emplace_back(one.name);
  verb->add_option("NAME", wish->name, "which study, or all")
      ->required()
      ->check(CLI::IsMember(names))
      ->type_name("");
  verb->add_option("--seed", wish->options.seed, "same seed, same findings (times apart)")
      ->capture_default_str();
  verb->add_option("--items", wish->options.items,
                   "how many rigs, pairs or pictures; the study's own number if not given")
      ->check(CLI::Range(1, 100000));
  verb->add_flag("--quick", wish->options.quick, "few items, small pictures: a look, not a record");
  verb->add_option("--threads", wish->options.threads, "at most this many")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  verb->add_option("--assets", wish->options.assets,
                   "heads and photographs of Debian packages (tests/support/fetch_assets.sh)")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--out", wish->out, "a folder; each study writes into one of its own below it")
      ->capture_default_str();
  verb->footer("Studies:\n" + list_of_studies());
  verb->callback([wish, &world, &verdict] { verdict.exit = run(*wish, world, verdict.json); });
}

}  // namespace chiaro::daemon
