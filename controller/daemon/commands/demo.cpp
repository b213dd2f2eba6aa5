// SPDX-License-Identifier: Apache-2.0
// `chiaro demo`: the whole of Chiaro on a studio made of software, with nothing plugged in. This
// program starts and watches the three others; all it knows of them it asks through the API.
#include <CLI/CLI.hpp>
#include <memory>
#include <netinet/in.h>
#include <ostream>
#include <sys/socket.h>
#include <unistd.h>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/demo/one_look.h"
#include "controller/daemon/demo/supervisor.h"
#include "controller/daemon/demo/working_copy.h"
#include "controller/studio/load.h"
#include "drivers/common/http_client.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using ports::Exit;

constexpr double kReadyPatience_s = 120;
constexpr double kFade_s = 1;

struct Arguments {
  bool once = false;
  std::string mood;
  std::uint16_t port = 8090;
  std::string studio, picture = "demo.png", errors = "on", renderer = "fast";
  double stand_time_s = 1;
};

/// Whether a server could listen on that port of this machine.
bool is_free(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool free =
      ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::listen(socket, 1) == 0;
  ::close(socket);
  return free;
}

core::Result<core::Done> check_free(std::uint16_t port, const std::string& whose,
                                    const std::string& remedy) {
  if (is_free(port)) return core::Done{};
  return core::Problem{
      {}, "port " + std::to_string(port) + ", " + whose + ", is in use by another program", remedy};
}

/// Fresh for every `--once`, so that the same look comes out; kept otherwise. Prepared meshes are
/// kept always: they are the same for all.
void prepare_state(const std::filesystem::path& state, bool afresh) {
  std::error_code ignored;
  std::filesystem::create_directories(state, ignored);
  if (!afresh) return;
  for (const auto& entry : std::filesystem::directory_iterator(state, ignored))
    if (entry.path().filename() != "meshes") std::filesystem::remove_all(entry.path(), ignored);
}

class Demo {
 public:
  Demo(const Arguments& arguments, ports::World& world, bool json)
      : arguments_(arguments),
        world_(world),
        json_(json),
        state_(world.state_folder / (arguments.once ? "demo-once" : "demo")),
        runtime_(world.runtime_folder / (arguments.once ? "demo-once" : "demo")),
        supervisor_(state_ / "logs") {}

  Exit run();

 private:
  core::Result<core::Done> start();
  core::Result<std::filesystem::path> studio_file() const;
  core::Result<core::Done> start_programs(const std::string& studio_file);
  core::Result<core::Done> make_one_look();
  core::Result<core::Done> run_until_stopped();
  core::Result<core::Done> wait();
  DemoLink link();
  Exit refuse(const core::Problems& problems) const;

  const Arguments& arguments_;
  ports::World& world_;
  const bool json_;
  const std::filesystem::path state_, runtime_;
  Supervisor supervisor_;
  std::uint16_t camera_port_ = 8091;
  std::string camera_;
  std::size_t lamps_ = 0;
  bool bad_input_ = false;
};

Exit Demo::refuse(const core::Problems& problems) const {
  if (world_.stop) return Exit::done;  // somebody pressed Ctrl-C: no fault of anybody
  for (const auto& problem : problems)
    world_.err << "chiaro demo: " << problem.what << "\n"
               << (problem.remedy.empty() ? "" : "What to do: " + problem.remedy + "\n");
  return bad_input_ ? Exit::input_has_problems : Exit::out_of_reach;
}

core::Result<core::Done> Demo::wait() {
  world_.clock.sleep_until(world_.clock.now() + 50ms);
  if (world_.stop) return core::Problem{{}, "stopped", ""};
  return supervisor_.tend(world_.clock.now());
}

DemoLink Demo::link() {
  return {"http://127.0.0.1:" + std::to_string(arguments_.port), [this] { return wait(); },
          [this] {
            return std::chrono::duration<double>(world_.clock.now().time_since_epoch()).count();
          }};
}

/// A file that somebody named is theirs to change; the shipped one is not the demo's.
core::Result<std::filesystem::path> Demo::studio_file() const {
  if (!arguments_.studio.empty()) return std::filesystem::path(arguments_.studio);
  return working_copy(world_.config_folder / "studios/portrait.yaml", state_ / "studio");
}

core::Result<core::Done> Demo::start() {
  prepare_state(state_, arguments_.once);
  const auto found = studio_file();
  if (!found) return found.problems();
  const auto& file = *found;
  const auto loaded = studio::load_studio(file, {world_.config_folder});
  if (!loaded) {
    bad_input_ = true;
    return loaded.problems();
  }
  // The studio file says where its camera is: there the virtual one must answer.
  camera_ = loaded->studio.main_camera().source;
  const auto url = drivers::parse_http_url(camera_);
  if (!url) {
    bad_input_ = true;
    return core::Problem{{file.string()},
                         "the demo needs a main camera with a source such as "
                         "{http: \"http://127.0.0.1:8091/camera/main\"}",
                         "add it to the studio file"};
  }
  camera_port_ = url->port;
  lamps_ = loaded->studio.fixtures.size();
  if (auto free = check_free(arguments_.port, "for the panel",
                             "end that program, or choose another port: --port " +
                                 std::to_string(arguments_.port + 10));
      !free)
    return free;
  if (auto free = check_free(camera_port_, "for the virtual camera",
                             "is another demo running? End it, then try again");
      !free)
    return free;
  return start_programs(std::filesystem::absolute(file).string());
}

core::Result<core::Done> Demo::start_programs(const std::string& studio_file) {
  std::error_code code;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", code).parent_path();
  const std::map<std::string, std::string> environment{
      {"CHIARO_CONFIG", world_.config_folder.string()},
      {"CHIARO_STATE", state_.string()},
      {"CHIARO_RUNTIME", runtime_.string()}};
  const auto port = std::to_string(arguments_.port);
  // One after the other: who comes later finds the earlier one's folders made.
  const Program programs[] = {
      {"chiaro-sim",
       folder / "chiaro-sim",
       {studio_file, "--port", std::to_string(camera_port_), "--daemon", "http://127.0.0.1:" + port,
        "--stand-time", std::to_string(arguments_.stand_time_s), "--errors", arguments_.errors,
        "--renderer", arguments_.renderer},
       environment},
      {"chiaro-output", folder / "chiaro-output", {studio_file}, environment},
      {"chiarod", folder / "chiarod", {studio_file, "--port", port}, environment}};
  for (const auto& program : programs)
    if (auto started = supervisor_.start(program, world_.clock.now()); !started) return started;
  return wait_until_ready(link(), kReadyPatience_s);
}

core::Result<core::Done> Demo::make_one_look() {
  const auto mood = arguments_.mood.empty() ? "rembrandt" : arguments_.mood;
  const auto made = make_look(link(), mood, kFade_s, {world_.err, world_.err_is_terminal});
  if (!made) return made.problems();
  const auto picture = std::filesystem::absolute(arguments_.picture);
  if (const auto written = core::write_png(picture, side_by_side(*made)); !written)
    return written.problems();
  if (json_)
    world_.out << in_json(*made, picture);
  else
    world_.out << in_words(*made, picture);
  world_.out << std::flush;
  return core::Done{};
}

core::Result<core::Done> Demo::run_until_stopped() {
  if (!arguments_.mood.empty()) {
    const auto made =
        make_look(link(), arguments_.mood, kFade_s, {world_.err, world_.err_is_terminal});
    if (!made) return made.problems();
  } else if (auto lit = light_to_begin_with(link()); !lit) {
    return lit;
  }
  world_.out << "\nChiaro's demo is running: " << lamps_
             << " virtual lamps and a camera, nothing plugged in.\n\n"
             << "    control panel    http://127.0.0.1:" << arguments_.port << "/\n"
             << "    virtual camera   " << camera_ << "/stream\n"
             << "    logs             " << (state_ / "logs").string() << "\n\n"
             << "Press Ctrl-C to end it.\n"
             << std::flush;
  while (!world_.stop)
    if (auto state = wait(); !state && !world_.stop) return state;
  world_.err << "\nEnding the demo.\n";
  return core::Done{};
}

Exit Demo::run() {
  world_.err << "Starting a virtual studio, the output process and the daemon …\n" << std::flush;
  auto outcome = start();
  if (outcome) outcome = arguments_.once ? make_one_look() : run_until_stopped();
  const Exit exit = outcome ? Exit::done : refuse(outcome.problems());
  supervisor_.end();
  return exit;
}

}  // namespace

void declare_demo(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "demo", "the whole of Chiaro on a virtual studio, with nothing plugged in");
  auto arguments = std::make_shared<Arguments>();
  verb->add_flag("--once", arguments->once, "make one look, save its picture, and end");
  verb->add_option("--mood", arguments->mood, "the mood to begin with (--once: rembrandt)");
  verb->add_option("--port", arguments->port, "of the control panel")->capture_default_str();
  verb->add_option("--studio", arguments->studio,
                   "a studio file instead of a copy of the shipped one");
  verb->add_option("--picture", arguments->picture, "where --once saves its picture")
      ->capture_default_str();
  verb->add_option("--errors", arguments->errors,
                   "how lamps depart from their data sheets: on, off")
      ->capture_default_str();
  verb->add_option("--renderer", arguments->renderer, "of the virtual camera: fast or path")
      ->capture_default_str();
  verb->add_option("--stand-time", arguments->stand_time_s, "seconds the stagehand needs per stand")
      ->capture_default_str();
  verb->callback([arguments, &world, &verdict] {
    verdict.exit = Demo(*arguments, world, verdict.json).run();
  });
}

}  // namespace chiaro::daemon
