// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/sim.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "controller/core/picture_file.h"
#include "controller/studio/load.h"
#include "drivers/common/http_client.h"
#include "simulator/virtual_studio/camera_server.h"
#include "simulator/virtual_studio/node.h"
#include "simulator/virtual_studio/options.h"
#include "simulator/virtual_studio/stagehand.h"

namespace chiaro::simulator {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr ports::Duration kTick = 10ms;        ///< of the lamps
constexpr ports::Duration kLookAgain = 200ms;  ///< of the stagehand
constexpr int kJpegQuality = 92;

/// The studio at run time. Three threads: the node's loop (the caller's), the cameras', the
/// stagehand's; `mutex_` guards the stage and the node's report between them.
class VirtualStudio {
 public:
  VirtualStudio(const SimOptions& options, const studio::Studio& studio, Node node,
                std::shared_ptr<const render::Tracer> tracer, ports::World& world)
      : options_(options),
        studio_(studio),
        world_(world),
        node_(std::move(node)),
        stage_(studio, tracer->geometry().aim, options.departures, options.seed),
        tracer_(std::move(tracer)) {}

  ports::Exit run();

 private:
  core::Result<core::Done> open_server();
  void follow_the_wire();
  void run_cameras();
  void serve(const CameraServer::Wish& wish, VirtualCamera& camera);
  void run_stagehand();
  bool put_where_they_were(const std::string& state_json);
  bool carry_out(const Task& task);
  std::string status();
  bool stopping() const { return world_.stop || ending_; }

  const SimOptions& options_;
  const studio::Studio& studio_;
  ports::World& world_;
  std::mutex mutex_;
  Node node_;
  VirtualStage stage_;
  std::shared_ptr<const render::Tracer> tracer_;
  std::uint64_t frames_ = 0, stands_moved_ = 0;
  std::atomic<bool> ending_{false};
  std::mutex wish_mutex_;
  std::condition_variable wish_;
  bool wished_ = false;
  std::unique_ptr<CameraServer> server_;
};

core::Result<core::Done> VirtualStudio::open_server() {
  CameraServer::Options options;
  options.port = options_.port;
  for (const auto& camera : studio_.cameras) options.cameras.push_back(camera.name);
  options.status = [this] { return status(); };
  options.on_wish = [this] {
    const std::lock_guard lock(wish_mutex_);
    wished_ = true;
    wish_.notify_one();
  };
  auto opened = CameraServer::open(std::move(options));
  if (!opened) return opened.problems();
  server_ = std::move(*opened);
  return core::Done{};
}

ports::Exit VirtualStudio::run() {
  if (const auto opened = open_server(); !opened) {
    world_.err << core::to_string(opened.problems()) << "\n";
    return ports::Exit::out_of_reach;
  }
  world_.err << "chiaro-sim: " << studio_.fixtures.size() << " lamps of '" << studio_.name
             << "'; its camera is http://127.0.0.1:" << server_->port() << "/camera/"
             << studio_.cameras.front().name << "\n"
             << std::flush;
  std::thread cameras([this] { run_cameras(); });
  std::thread stagehand([this] {
    if (options_.stagehand) run_stagehand();
  });
  follow_the_wire();
  ending_ = true;
  stagehand.join();
  cameras.join();
  server_.reset();
  return ports::Exit::done;
}

void VirtualStudio::follow_the_wire() {
  auto last = world_.clock.now();
  while (!stopping()) {
    const auto now = world_.clock.now();
    {
      const std::lock_guard lock(mutex_);
      node_.listen(now);
      if (node_.heard()) stage_.ask({node_.levels(now)});
      stage_.advance(std::chrono::duration<double>(now - last).count());
    }
    last = now;
    world_.clock.sleep_until(now + kTick);
  }
}

void VirtualStudio::run_cameras() {
  std::vector<VirtualCamera> cameras;
  cameras.reserve(studio_.cameras.size());
  for (const auto& camera : studio_.cameras)
    cameras.emplace_back(studio_, camera, tracer_, options_.camera);
  // Paced by the machine's clock: a camera looks when it is asked, whatever time the lamps live in.
  auto next = std::chrono::steady_clock::now();
  const auto period = std::chrono::duration<double>(1 / options_.rate_hz);
  while (!stopping()) {
    {
      std::unique_lock lock(wish_mutex_);
      wish_.wait_for(lock, 100ms, [this] { return wished_; });
      if (!wished_) continue;
      wished_ = false;
    }
    std::this_thread::sleep_until(next);
    next = std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(period);
    for (const auto& wish : server_->wishes()) serve(wish, cameras[wish.camera]);
  }
}

void VirtualStudio::serve(const CameraServer::Wish& wish, VirtualCamera& camera) {
  std::vector<LitLamp> lamps;
  std::uint64_t frame = 0;
  {
    const std::lock_guard lock(mutex_);
    lamps = stage_.lit();
    frame = ++frames_;
  }
  const auto picture = exposed(camera.picture(lamps), options_.sensor, options_.seed, frame);
  const auto jpeg = core::encode_jpeg(picture, kJpegQuality);
  server_->show(wish, std::string(jpeg.begin(), jpeg.end()));
}

void VirtualStudio::run_stagehand() {
  Stagehand hand(std::chrono::duration_cast<ports::Duration>(
      std::chrono::duration<double>(options_.stand_time_s)));
  bool met = false;
  while (!stopping()) {
    drivers::HttpRequest request;
    request.url = options_.daemon + "/api/v1/state";
    // A daemon that is not there yet, or busy, is asked again: stagehands wait.
    const auto reply = drivers::http_request(request, 2s, &ending_);
    if (reply && reply->status == 200) {
      if (!met) met = put_where_they_were(reply->body);
      const auto tasks = tasks_in(reply->body);
      const auto done = tasks ? hand.work(*tasks, world_.clock.now()) : std::nullopt;
      if (done) carry_out(*done);
    }
    for (auto slept = 0ms; slept < kLookAgain && !stopping(); slept += 20ms)
      std::this_thread::sleep_for(20ms);
  }
}

bool VirtualStudio::put_where_they_were(const std::string& state_json) {
  const auto places = places_in(state_json);
  if (!places) return false;
  const std::lock_guard lock(mutex_);
  for (const auto& place : *places)
    if (const auto fixture = studio_.fixture_index(place.fixture)) stage_.put(*fixture, place.to);
  return true;
}

bool VirtualStudio::carry_out(const Task& task) {
  const auto fixture = studio_.fixture_index(task.fixture);
  if (!fixture) return false;
  {
    const std::lock_guard lock(mutex_);
    stage_.put(*fixture, task.to);
    ++stands_moved_;
  }
  drivers::HttpRequest request;
  request.method = "POST";
  request.url = options_.daemon + "/api/v1/fixtures/" + task.fixture + "/placed";
  request.body = placed_json(task.to);
  const auto reply = drivers::http_request(request, 5s, &ending_);
  const bool taken = reply && reply->status < 300;
  world_.err << "chiaro-sim: moved the stand of " << task.fixture
             << (taken ? "" : ", but the daemon did not take the news") << "\n"
             << std::flush;
  return taken;
}

std::string VirtualStudio::status() {
  const std::lock_guard lock(mutex_);
  Json json;
  json["studio"] = studio_.name;
  json["renderer"] = options_.camera.renderer == Renderer::path   ? "path"
                     : options_.camera.renderer == Renderer::fast ? "direct"
                                                                  : "fast";
  json["seed"] = options_.seed;
  json["packets"] = node_.packets();
  json["out_of_sequence"] = node_.out_of_sequence();
  json["frames"] = frames_;
  json["stands_moved"] = stands_moved_;
  for (const auto& one : node_.report())
    json["universes"].push_back({{"universe", one.universe}, {"sources", one.sources}});
  const auto rig = stage_.actual();
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i) {
    Json state;
    for (const auto& dof : core::dofs())
      if (rig.states[i].has(dof.dof))
        state[std::string(dof.file_name)] = core::file_value(dof.dof, rig.states[i].get(dof.dof));
    json["lamps"].push_back({{"name", studio_.fixtures[i].name}, {"is", state}});
  }
  return json.dump();
}

}  // namespace

ports::Exit run_sim(std::span<const std::string> arguments, ports::World& world) {
  ports::Exit exit = ports::Exit::done;
  const auto options = parse_sim_options(arguments, world, exit);
  if (!options) return exit;
  const auto refuse = [&](const core::Problems& problems, ports::Exit why) {
    world.err << core::to_string(problems) << "\n";
    return why;
  };
  const auto loaded = studio::load_studio(options->studio, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), ports::Exit::input_has_problems);
  const auto geometry = twin::build_geometry(loaded->studio, world.state_folder / "meshes");
  if (!geometry) return refuse(geometry.problems(), ports::Exit::input_has_problems);
  auto node = Node::open(loaded->studio, world.network);
  if (!node) return refuse(node.problems(), ports::Exit::out_of_reach);
  VirtualStudio studio(*options, loaded->studio, std::move(*node),
                       std::make_shared<render::Tracer>(*geometry), world);
  return studio.run();
}

}  // namespace chiaro::simulator
