// SPDX-License-Identifier: Apache-2.0
// `chiaro objects`: every object of a scene lit for itself, by a spot of its own or in the picture
// alone.
#include "controller/design/objects.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/named_goal.h"
#include "controller/daemon/problems.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/words.h"

namespace chiaro::daemon {
namespace {

/// As typed.
struct Asked {
  std::string studio, goals, out, picture = "objects.png";
  bool merge = false;
  std::uint64_t trials = 0;
};

using Json = nlohmann::ordered_json;

Json point_of(core::Vec3 p) { return {p.x, p.y, p.z}; }

Json json_of(const design::LitObject& object) {
  return {{"object", object.object},
          {"lamp", object.lamp},
          {"at", point_of(object.at)},
          {"aim_at", point_of(object.aim_at)},
          {"cone_deg", core::degrees(object.cone.angle)},
          {"intensity", object.level},
          {"covered", object.covered},
          {"cone_over_others", object.cone.spilled},
          {"stray_light", object.stray},
          {"cost", object.cost},
          {"tries", object.tries},
          {"instruction", object.instruction}};
}

void say(const design::LitObject& object, std::ostream& out) {
  out << "  " << object.object << ": " << object.lamp << " at "
      << design::level_in_words(object.level) << ", cone "
      << design::number(core::degrees(object.cone.angle), 0) << "°, reaches "
      << design::number(100 * object.covered, 0) << " % of it, "
      << design::number(100 * object.stray, 0) << " % of the light strays to others\n";
}

core::Problems write_picture(const std::string& file, const core::Picture& picture) {
  return core::write_png(file, core::encoded(picture)).problems();
}

ports::Exit run_spots(const Asked& asked, const studio::Studio& studio,
                      const std::vector<design::ObjectGoal>& goals,
                      const design::GeometricOptions& geometric, ports::World& world, bool json) {
  const auto twin = design::geometric_layers(studio, geometric);
  if (!twin) return refuse(twin.problems(), world, json);
  const auto lit = design::light_objects(studio, design::tracer_of(**twin), goals);
  if (!lit) return refuse(lit.problems(), world, json);
  if (auto bad = write_picture(asked.picture, lit->look.picture); !bad.empty())
    return refuse(bad, world, json);
  if (!asked.out.empty()) {
    std::ofstream file(asked.out, std::ios::trunc);
    file << design::look_to_json(studio, lit->look);
    if (!file.flush())
      return refuse({{{asked.out}, "the look cannot be written", "is there such a folder?"}}, world,
                    json);
  }
  Json report = {{"picture", asked.picture}, {"objects", Json::array()}};
  std::ostream& people = json ? world.err : world.out;
  for (const design::LitObject& object : lit->objects) {
    report["objects"].push_back(json_of(object));
    say(object, people);
  }
  for (const std::string& line : lit->look.instructions) people << "  by hand: " << line << "\n";
  if (json) world.out << report.dump(2) << "\n";
  return ports::Exit::done;
}

ports::Exit run_merge(const Asked& asked, const studio::Studio& studio,
                      const std::vector<design::ObjectGoal>& goals,
                      const design::GeometricOptions& geometric, ports::World& world, bool json) {
  design::Options options;
  options.trials = asked.trials;
  options.threads = geometric.threads;
  options.stop = &world.stop;
  const auto merged = design::merge_objects(studio, goals, geometric, options);
  if (!merged) return refuse(merged.problems(), world, json);
  if (auto bad = write_picture(asked.picture, merged->picture); !bad.empty())
    return refuse(bad, world, json);
  Json report = {{"picture", asked.picture}, {"objects", Json::array()}};
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const design::Look& look = merged->looks[k];
    const std::string& name = studio.subjects[goals[k].subject].name;
    report["objects"].push_back({{"object", name},
                                 {"verdict", design::name_of(look.judgement.verdict)},
                                 {"residual", look.judgement.residual},
                                 {"trials", look.trials}});
    (json ? world.err : world.out)
        << "  " << name << ": " << look.goal << ", " << design::name_of(look.judgement.verdict)
        << ", " << design::number(100 * look.judgement.residual, 1) << " % off\n";
  }
  if (json) world.out << report.dump(2) << "\n";
  return ports::Exit::done;
}

ports::Exit run_objects(const Asked& asked, ports::World& world, bool json) {
  const studio::Folders folders{world.config_folder};
  const auto loaded = studio::load_studio(asked.studio, folders);
  if (!loaded) return refuse(loaded.problems(), world, json);
  world.err << core::to_string(loaded->warnings);
  const auto text = text_of(asked.goals);
  if (!text) return refuse(text.problems(), world, json);
  const auto named = [&](const std::string& mood, const std::string& exemplar,
                         design::Objective objective) {
    return mood.empty() ? picture_goal(exemplar, objective)
                        : mood_goal(mood, folders, objective, world);
  };
  const auto goals = design::objects_from_json(*text, asked.goals, loaded->studio,
                                               std::filesystem::absolute(asked.goals).parent_path(),
                                               !asked.merge, named);
  if (!goals) return refuse(goals.problems(), world, json);
  design::GeometricOptions geometric;
  geometric.mesh_cache = world.state_folder / "meshes";
  geometric.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto run = asked.merge ? run_merge : run_spots;
  return run(asked, loaded->studio, *goals, geometric, world, json);
}

}  // namespace

void declare_objects(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto asked = std::make_shared<Asked>();
  CLI::App* verb = app.add_subcommand("objects", "each object lit for itself");
  verb->add_option("STUDIO", asked->studio, "the studio file, with several subjects")->required();
  verb->add_option(
          "GOALS", asked->goals,
          "JSON: {\"objects\": {\"vase\": {\"lamp\": \"spot\", \"like\": \"ideal\"}}}; like may "
          "also be {\"mood\": NAME} or {\"exemplar\": FILE}")
      ->required()
      ->check(CLI::ExistingFile);
  verb->add_flag("--merge", asked->merge,
                 "in the picture alone: each object lit with the others hidden, then put together "
                 "by depth; lamps need not be named");
  verb->add_option("--trials", asked->trials, "with --merge: how many places to try for each");
  verb->add_option("--picture", asked->picture, "the picture (default objects.png)");
  verb->add_option("--out", asked->out, "without --merge: where to write the look (look.json)");
  verb->callback(
      [asked, &world, &verdict] { verdict.exit = run_objects(*asked, world, verdict.json); });
}

}  // namespace chiaro::daemon
