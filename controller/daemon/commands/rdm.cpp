// SPDX-License-Identifier: Apache-2.0
// `chiaro rdm [--serial S | --path P | --device /dev/…]`: the lamps of a DMX line by RDM, with
// their addresses; `--identify UID` lets one blink, `--quiet UID` ends that. The adapter has one
// user at a time, so the hand must not have it.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/problems.h"
#include "drivers/common/usbpro_rdm.h"

namespace chiaro::daemon {
namespace {

namespace rdm = drivers::rdm;

struct Options {
  ports::DeviceMatch device;
  std::string identify, quiet;
};

/// A prototyping number of the standard's (7ff0 to 7fff), ours alone on a line of our own.
constexpr rdm::Uid kOwn = 0x7ff043686961;

ports::Exit out_of_reach(const core::Problems& problems, ports::World& world, bool json) {
  (void)refuse(problems, world, json);
  return ports::Exit::out_of_reach;
}

nlohmann::json json_of(const rdm::Device& device) {
  return {{"uid", rdm::to_string(device.uid)},
          {"answered", device.answered},
          {"maker", device.maker},
          {"model", device.name},
          {"label", device.label},
          {"address", device.address},
          {"footprint", device.footprint},
          {"mode", device.mode},
          {"modes", device.modes}};
}

void print(const rdm::Device& device, std::ostream& out) {
  out << "  " << rdm::to_string(device.uid) << "  ";
  if (!device.answered) {
    out << "does not say what it is\n";
    return;
  }
  if (device.address > 0)
    out << "slots " << device.address << " to " << device.address + device.footprint - 1;
  else
    out << "no slots";
  out << ", mode " << static_cast<int>(device.mode) << " of " << static_cast<int>(device.modes)
      << ", " << (device.maker + " " + device.name)
      << (device.label.empty() ? "" : " '" + device.label + "'") << "\n";
}

ports::Exit list(rdm::Controller& controller, ports::World& world, bool json) {
  world.err << "chiaro rdm: looking for lamps …" << std::endl;
  const auto found = controller.discover();
  if (!found) return out_of_reach(found.problems(), world, json);
  nlohmann::json all = nlohmann::json::array();
  for (const rdm::Uid uid : *found) {
    const auto device = controller.ask(uid);
    if (!device) return out_of_reach(device.problems(), world, json);
    all.push_back(json_of(*device));
    if (!json) print(*device, world.out);
  }
  if (json)
    world.out << nlohmann::json{{"devices", all}}.dump() << "\n";
  else
    world.out << found->size() << (found->size() == 1 ? " lamp answers" : " lamps answer")
              << " by RDM\n";
  return ports::Exit::done;
}

ports::Exit show_itself(rdm::Controller& controller, const std::string& word, bool on,
                        ports::World& world, bool json) {
  const auto uid = rdm::uid_in(word);
  if (!uid)
    return refuse({core::Problem{{},
                                 "'" + word + "' is no RDM identifier",
                                 "for example 454e:00000a01; `chiaro rdm` lists them"}},
                  world, json);
  const auto done = controller.identify(*uid, on);
  if (!done) return out_of_reach(done.problems(), world, json);
  if (json)
    world.out << nlohmann::json{{"uid", rdm::to_string(*uid)}, {"identify", on}}.dump() << "\n";
  else
    world.out << rdm::to_string(*uid) << (on ? " shows itself\n" : " is as before\n");
  return ports::Exit::done;
}

ports::Exit run(const Options& options, ports::World& world, bool json) {
  drivers::Surroundings around{world.network, world.devices, world.clock};
  auto line = drivers::usbpro::open_rdm(options.device, around);
  if (!line) return out_of_reach(line.problems(), world, json);
  rdm::Controller controller(**line, kOwn);
  if (!options.identify.empty())
    return show_itself(controller, options.identify, true, world, json);
  if (!options.quiet.empty()) return show_itself(controller, options.quiet, false, world, json);
  return list(controller, world, json);
}

}  // namespace

void declare_rdm(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "rdm", "asks the lamps on a DMX USB Pro's line who they are; lets one show itself");
  auto options = std::make_shared<Options>();
  auto* which = verb->add_option_group("which adapter", "one of these");
  which->add_option("--serial", options->device.serial, "its serial number");
  which->add_option("--path", options->device.usb_path, "the USB socket it sits in: 1-1.4");
  which->add_option("--device", options->device.node, "/dev/ttyUSB0");
  which->require_option(1, 3);
  auto* on = verb->add_option("--identify", options->identify, "UID: this lamp shows itself");
  verb->add_option("--quiet", options->quiet, "UID: it stops doing so")->excludes(on);
  verb->callback(
      [options, &world, &verdict] { verdict.exit = run(*options, world, verdict.json); });
}

}  // namespace chiaro::daemon
