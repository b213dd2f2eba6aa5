// SPDX-License-Identifier: Apache-2.0
// `chiaro nudge STUDIO LOOK "a little warmer, more dramatic"`: a look changed in people's words.
#include "controller/design/nudge.h"

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/design/words.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

struct Wish {
  std::string studio, look, words, out, picture;
  std::vector<std::string> lock;
};

core::Result<design::Look> read_look(const Wish& wish, const studio::Studio& studio) {
  std::ifstream in(wish.look);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) return core::Problem{{wish.look}, "the look cannot be read", "check its name"};
  return design::look_from_json(studio, text.str(), wish.look);
}

core::Result<core::Done> write_results(const Wish& wish, const studio::Studio& studio,
                                       const design::Look& look) {
  if (!wish.out.empty()) {
    std::ofstream file(wish.out, std::ios::trunc);
    file << design::look_to_json(studio, look);
    if (!file.flush())
      return core::Problem{
          {wish.out}, "the look cannot be written", "check the folder's permissions and the disk"};
  }
  if (wish.picture.empty()) return core::Done{};
  return core::write_png(wish.picture, core::encoded(look.placed_picture));
}

void print_lamps(const studio::Studio& studio, const studio::Rig& before, const studio::Rig& after,
                 std::ostream& out) {
  using core::Dof;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const core::FixtureState &was = before.states[i], &is = after.states[i];
    if (was == is) continue;
    out << "  " << studio.fixtures[i].name << ": "
        << design::level_in_words(was.get(Dof::intensity)) << " to "
        << design::level_in_words(is.get(Dof::intensity));
    if (is.has(Dof::cct) && was.get(Dof::cct) != is.get(Dof::cct))
      out << ", " << design::number(was.get(Dof::cct), 0) << " to "
          << design::number(is.get(Dof::cct), 0) << " K";
    out << "\n";
  }
}

void print(const studio::Studio& studio, const design::Look& before, const design::Nudge& asked,
           const design::Nudged& after, std::ostream& out) {
  out << design::nudge_in_words(asked) << ": "
      << design::name_of(after.look.placed_judgement.verdict) << "\n";
  print_lamps(studio, before.placed, after.look.placed, out);
  if (!after.by_hand.empty()) out << "By hand:\n";
  for (const std::string& line : after.by_hand) out << "  " << line << "\n";
}

nlohmann::ordered_json json_of(const design::Nudge& nudge) {
  return {{"brightness", nudge.brightness},
          {"warmth", nudge.warmth},
          {"contrast", nudge.contrast},
          {"softness", nudge.softness}};
}

ports::Exit run(const Wish& wish, ports::World& world, bool json) {
  const auto nudge = design::nudge_from_words(wish.words);
  if (!nudge) return refuse(nudge.problems(), world, json);
  const auto loaded = studio::load_studio(wish.studio, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  const studio::Studio& studio = loaded->studio;
  const auto look = read_look(wish, studio);
  if (!look) return refuse(look.problems(), world, json);
  const auto twin = design::geometric_layers(studio, {.mesh_cache = world.state_folder / "meshes"});
  if (!twin) return refuse(twin.problems(), world, json);
  design::NudgeOptions options;
  options.locked = wish.lock;
  const auto after = design::nudged(studio, **twin, *look, *nudge, options);
  if (!after) return refuse(after.problems(), world, json);
  if (const auto written = write_results(wish, studio, after->look); !written)
    return refuse(written.problems(), world, json);
  if (json)
    world.out << json_text(nlohmann::ordered_json{
                     {"asked", json_of(*nudge)},
                     {"done", json_of(after->done)},
                     {"by_hand", after->by_hand},
                     {"look",
                      nlohmann::ordered_json::parse(design::look_to_json(studio, after->look))}})
              << "\n";
  else
    print(studio, *look, *nudge, *after, world.out);
  return ports::Exit::done;
}

}  // namespace

void declare_nudge(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("nudge", "a look a little warmer, brighter, more dramatic …");
  auto wish = std::make_shared<Wish>();
  verb->add_option("STUDIO", wish->studio, "the studio file")->required();
  verb->add_option("LOOK", wish->look, "look.json, as chiaro design writes it")->required();
  verb->add_option("WORDS", wish->words, "as in: \"a little warmer, more dramatic\"")->required();
  verb->add_option("--lock", wish->lock, "a fixture to leave as it is (may be repeated)");
  verb->add_option("--out", wish->out, "where to write the new look (look.json)");
  verb->add_option("--picture", wish->picture,
                   "where to write what the camera would see with the lamps as they stand (PNG)");
  verb->callback([wish, &world, &verdict] { verdict.exit = run(*wish, world, verdict.json); });
}

}  // namespace chiaro::daemon
