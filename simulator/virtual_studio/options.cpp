// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <ostream>
#include <vector>

#include "drivers/common/http_client.h"

namespace chiaro::simulator {

std::optional<SimOptions> parse_sim_options(std::span<const std::string> arguments,
                                            ports::World& world, ports::Exit& exit) {
  SimOptions options;
  std::string errors = "on", noise = "on", stagehand = "auto", renderer = "fast";
  CLI::App app{"A virtual studio: lamps that listen to sACN, and a camera that sees their light.",
               "chiaro-sim"};
  app.add_option("STUDIO", options.studio, "the studio file")->required();
  app.add_option("--port", options.port, "of the camera's HTTP server")->capture_default_str();
  app.add_option("--renderer", renderer,
                 "fast: light from the lamps and, coarsely, from walls and floor; direct: from the "
                 "lamps alone; path: traced like a real room, slowly")
      ->check(CLI::IsMember({"fast", "direct", "path"}))
      ->capture_default_str();
  app.add_option("--samples", options.camera.samples, "paths per pixel of --renderer path")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_option("--rate", options.rate_hz, "most camera frames a second")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  app.add_option("--errors", errors,
                 "how lamps depart from their data sheets: on, off, or some of "
                 "output,colour,aim,placement,curve,lag,steps")
      ->capture_default_str();
  app.add_option("--noise", noise, "the camera's sensor noise")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--stagehand", stagehand, "auto: carries out the daemon's instructions for stands")
      ->check(CLI::IsMember({"auto", "never"}))
      ->capture_default_str();
  app.add_option("--stand-time", options.stand_time_s, "seconds that the stagehand needs per stand")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--daemon", options.daemon, "whose instructions the stagehand reads")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the lamps' departures and the noise")
      ->capture_default_str();
  exit = ports::Exit::usage;
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    if (app.exit(error, world.out, world.err) == 0) exit = ports::Exit::done;
    return std::nullopt;
  }
  const auto departures = departures_named(errors);
  const auto daemon = drivers::parse_http_url(options.daemon);
  if (!departures || !daemon) {
    world.err << core::to_string(!departures ? departures.problems() : daemon.problems()) << "\n";
    return std::nullopt;
  }
  options.departures = *departures;
  options.sensor.on = noise == "on";
  options.stagehand = stagehand == "auto";
  options.camera.renderer = renderer == "path"     ? Renderer::path
                            : renderer == "direct" ? Renderer::fast
                                                   : Renderer::bounced;
  options.camera.seed = options.seed;
  options.camera.stop = &world.stop;
  return options;
}

}  // namespace chiaro::simulator
