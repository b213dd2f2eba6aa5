// SPDX-License-Identifier: Apache-2.0
// `chiaro record FILE`: every frame that the hand sends, or that arrives over sACN or Art-Net, in a
// file that `chiaro replay` sends again.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/hand_link.h"
#include "controller/daemon/hand_verb.h"
#include "controller/daemon/output/tape_file.h"
#include "controller/daemon/problems.h"
#include "drivers/registry.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

struct Asked {
  std::string file, from = "hand", universes = "1", interface;
  double seconds = 0;
  bool stop = false, status = false;
};

std::string in_words(const Json& answer) {
  const std::string file = answer.value("file", "");
  if (file.empty()) return "Nothing is being recorded.";
  std::string words = file + (answer.value("recording", false) ? ": recording, " : ": ");
  words += std::to_string(answer.value("ticks", 0)) + " frames so far, " +
           std::to_string(answer.value("seconds", 0.0)).substr(0, 6) + " s, " +
           std::to_string(answer.value("bytes", 0)) + " bytes";
  if (const auto lost = answer.value("lost", 0); lost > 0)
    words += "; " + std::to_string(lost) + " frames were lost to a slow disk";
  return words;
}

/// "1-4,7": ascending, each once; empty when it cannot be read.
std::vector<std::uint16_t> universes_in(const std::string& text) {
  std::vector<std::uint16_t> universes;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    unsigned first = 0, last = 0;
    auto read = std::from_chars(at, end, first);
    if (read.ec != std::errc{}) return {};
    last = first;
    if (read.ptr < end && *read.ptr == '-') {
      read = std::from_chars(read.ptr + 1, end, last);
      if (read.ec != std::errc{}) return {};
    }
    if (first < 1 || last < first || last > 63999 || last - first > 4096) return {};
    for (unsigned u = first; u <= last; ++u) universes.push_back(static_cast<std::uint16_t>(u));
    at = read.ptr;
    if (at < end && *at++ != ',') return {};
  }
  std::sort(universes.begin(), universes.end());
  universes.erase(std::unique(universes.begin(), universes.end()), universes.end());
  return universes;
}

/// Until somebody stops it, or the time is over.
template <class Work>
void meanwhile(double seconds, ports::World& world, ports::Duration pace, Work work) {
  const ports::TimePoint begun = world.clock.now();
  const auto passed = [&] {
    return std::chrono::duration<double>(world.clock.now() - begun).count();
  };
  while (!world.stop && (seconds <= 0 || passed() < seconds) && work())
    world.clock.sleep_until(world.clock.now() + pace);
}

ports::Exit record_hand(const Asked& asked, ports::World& world, bool json) {
  const std::string file = std::filesystem::absolute(asked.file).string();
  const auto started = hand_request(world.runtime_folder, "record start " + file);
  if (!started) return ask_hand(world, json, "record start " + file, in_words);  // says why not
  world.err << "Recording; Ctrl-C ends it." << std::endl;
  meanwhile(asked.seconds, world, std::chrono::milliseconds(100), [] { return true; });
  return ask_hand(world, json, "record stop", in_words);
}

/// As a lamp would hear it: the senders of each universe merged, at the rate of a lamp's refresh.
class Listener {
 public:
  Listener(std::unique_ptr<ports::DmxInput> input, std::unique_ptr<TapeWriter> tape)
      : input_(std::move(input)), tape_(std::move(tape)), last_(input_->universes()) {}

  core::Result<core::Done> listen(ports::TimePoint now, bool write_out) {
    constexpr ports::Duration kRefresh = std::chrono::milliseconds(23);
    input_->listen(now);
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (input_->sources(i).empty()) continue;
      const ports::DmxFrame& frame = input_->frame(i, now);
      const bool heard_before = last_[i].frame.universe != 0;
      if (heard_before && frame.levels == last_[i].frame.levels && now - last_[i].at < kRefresh)
        continue;
      last_[i] = {frame, now};
      tape_->add(now, frame);
    }
    if (!write_out) return core::Done{};
    return tape_->flush();
  }
  const TapeWriter& tape() const { return *tape_; }

 private:
  struct Last {
    ports::DmxFrame frame{0, {}};
    ports::TimePoint at;
  };
  std::unique_ptr<ports::DmxInput> input_;
  std::unique_ptr<TapeWriter> tape_;
  std::vector<Last> last_;
};

ports::Exit record_network(const Asked& asked, ports::World& world, bool json) {
  drivers::InputSettings settings;
  settings.universes = universes_in(asked.universes);
  settings.interface = asked.interface;
  if (settings.universes.empty())
    return refuse({{{}, "'" + asked.universes + "' are no universes", "such as 1-4,7", false}},
                  world, json);
  drivers::Surroundings around{world.network, world.devices, world.clock};
  auto input = drivers::make_input(asked.from, settings, around);
  if (!input) return refuse(input.problems(), world, json);
  if (const auto opened = (*input)->open(); !opened) {
    refuse(opened.problems(), world, json);
    return ports::Exit::out_of_reach;
  }
  auto tape = TapeWriter::create(asked.file, {asked.from + " from the network",
                                              static_cast<std::int64_t>(std::time(nullptr))});
  if (!tape) return refuse(tape.problems(), world, json);
  Listener listener(std::move(*input), std::move(*tape));
  world.err << "Recording; Ctrl-C ends it." << std::endl;
  core::Problems problems;
  int round = 0;
  meanwhile(asked.seconds, world, std::chrono::milliseconds(2), [&] {
    const auto heard = listener.listen(world.clock.now(), ++round % 25 == 0);
    if (!heard) problems = heard.problems();
    return problems.empty();
  });
  if (problems.empty())
    if (const auto end = listener.listen(world.clock.now(), true); !end) problems = end.problems();
  if (!problems.empty()) return refuse(problems, world, json);
  const Json answer{{"recording", false},
                    {"file", asked.file},
                    {"seconds", std::chrono::duration<double>(listener.tape().length()).count()},
                    {"ticks", listener.tape().ticks()},
                    {"bytes", listener.tape().bytes()},
                    {"lost", 0}};
  if (json)
    world.out << answer.dump() << "\n";
  else
    world.err << in_words(answer) << "\n";
  return ports::Exit::done;
}

}  // namespace

void declare_record(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "record", "every frame that is sent, or that arrives over sACN or Art-Net, into a file");
  auto asked = std::make_shared<Asked>();
  auto* file = verb->add_option("FILE", asked->file, "a new file; `chiaro replay` sends it again");
  verb->add_option("--seconds", asked->seconds, "how long; without: until Ctrl-C")
      ->check(CLI::PositiveNumber);
  verb->add_option("--from", asked->from,
                   "hand: what chiaro-output sends on every port; sacn, artnet: what arrives here")
      ->check(CLI::IsMember({"hand", "sacn", "artnet"}))
      ->capture_default_str();
  verb->add_option("--universes", asked->universes, "of sacn and artnet: such as 1-4,7")
      ->capture_default_str();
  verb->add_option("--interface", asked->interface, "of sacn and artnet: the network interface");
  verb->add_flag("--stop", asked->stop, "ends a recording of the hand's whose terminal has gone")
      ->excludes(file);
  verb->add_flag("--status", asked->status, "whether the hand records")->excludes(file);
  verb->callback([&world, &verdict, asked] {
    if (asked->stop || asked->status)
      verdict.exit =
          ask_hand(world, verdict.json, asked->stop ? "record stop" : "record status", in_words);
    else if (asked->file.empty())
      throw CLI::ValidationError("FILE", "which file? (or --stop, --status)");
    else if (asked->from == "hand")
      verdict.exit = record_hand(*asked, world, verdict.json);
    else
      verdict.exit = record_network(*asked, world, verdict.json);
  });
}

}  // namespace chiaro::daemon
