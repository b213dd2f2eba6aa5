// SPDX-License-Identifier: Apache-2.0
#include "simulator/moods/recipe.h"

#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::simulator {
namespace {

using namespace studio::reading;
using studio::Optic;

constexpr core::Range kTurn{-core::kPi, core::kPi};
constexpr core::Range kRise{-core::kPi / 2, core::kPi / 2};
constexpr core::Range kWhites{1500, 20000};

std::optional<Optic> read_rectangle(const Tree& tree, Report& report) {
  const auto size = numbers(&tree, 2, {0.01, 20}, "[width, height] in metres", report);
  if (!size) return std::nullopt;
  Optic optic;
  optic.kind = Optic::Kind::rectangle;
  optic.width = (*size)[0];
  optic.height = (*size)[1];
  return optic;
}

std::optional<Optic> read_spot(const Tree& tree, Report& report) {
  Section section(tree, "a spot", report);
  const auto beam = quantity(section.need("beam", "30 deg"), Measure::angle, {0.01, 3}, report);
  const auto field = quantity(section.need("field", "46 deg"), Measure::angle, {0.01, 3}, report);
  section.refuse_unknown();
  if (!beam || !field) return std::nullopt;
  if (*field < *beam) {
    report.error(tree, "a spot's field is at least as wide as its beam", "swap the two");
    return std::nullopt;
  }
  Optic optic;
  optic.kind = Optic::Kind::spot;
  optic.beam = *beam;
  optic.field = *field;
  return optic;
}

std::optional<Optic> read_shape(const Tree* tree, Report& report) {
  if (tree == nullptr) return std::nullopt;
  const auto found =
      variant(tree, "a lamp's shape", {"panel", "softbox", "disk", "spot", "bare", "sun"}, report);
  if (!found) return std::nullopt;
  Optic optic;
  if (found->index == 5) optic.kind = Optic::Kind::directional;
  if (found->index >= 4) return optic;
  if (found->body == nullptr) {
    report.error(*tree, "this shape needs its size", "{softbox: [0.6, 0.9]}, {disk: 0.3 m}");
    return std::nullopt;
  }
  if (found->index < 2) return read_rectangle(*found->body, report);
  if (found->index == 3) return read_spot(*found->body, report);
  const auto radius = quantity(found->body, Measure::length, {0.01, 10}, report);
  if (!radius) return std::nullopt;
  optic.kind = Optic::Kind::disk;
  optic.radius = *radius;
  return optic;
}

void read_place(Section& section, RecipeLamp& lamp, Report& report) {
  if (section.has("at")) {
    FreePlace place;
    into(place.at, point(section.find("at"), report));
    into(place.aim_at, point(section.need("aim_at", "[0, 2, 1.4]"), report));
    lamp.place = place;
    return;
  }
  AboutTheSitter place;
  into(place.azimuth, quantity(section.need("azimuth", "-45 deg"), Measure::angle, kTurn, report));
  into(place.elevation,
       quantity(section.need("elevation", "35 deg"), Measure::angle, kRise, report));
  into(place.distance,
       quantity(section.need("distance", "1.8 m"), Measure::length, {0.3, 100}, report));
  lamp.place = place;
}

void read_strength(Section& section, RecipeLamp& lamp, Report& report) {
  lamp.lux = quantity(section.find("lux"), Measure::illuminance, {0.01, 1e6}, report);
  lamp.stops_below_key = quantity(section.find("below_key"), Measure::stops, {-10, 20}, report);
  if (section.has("lux") == section.has("below_key"))
    report.error(section.tree(), "a lamp's strength is either 'lux' or 'below_key'",
                 "lux: 900 lx, or below_key: 2 stops");
}

void read_colour(Section& section, RecipeLamp& lamp, Report& report) {
  if (const auto cct = quantity(section.find("cct"), Measure::temperature, kWhites, report))
    lamp.cct = {*cct};
  into(lamp.tint, number(section.find("tint"), {-50, 50}, report));
  lamp.colour = albedo(section.find("colour"), report);
  if (lamp.colour && core::luminance(*lamp.colour) <= 0)
    report.error(section.tree(), "a lamp cannot be black", "colour: [1, 0.6, 0.3]");
}

RecipeLamp read_lamp(const Tree& tree, const Tree::Key& name, Report& report) {
  using studio::Role;
  Section section(tree, "a lamp", report);
  RecipeLamp lamp;
  lamp.name = name.text;
  lamp.where = report.place(name);
  into(lamp.role, choice<Role>(section.need("role", "key"),
                               {{"key", Role::key},
                                {"fill", Role::fill},
                                {"back", Role::back},
                                {"hair", Role::hair},
                                {"kicker", Role::kicker},
                                {"background", Role::background},
                                {"practical", Role::practical}},
                               report));
  read_place(section, lamp, report);
  into(lamp.optic, read_shape(section.need("shape", "{softbox: [0.6, 0.9]}"), report));
  read_strength(section, lamp, report);
  read_colour(section, lamp, report);
  section.refuse_unknown();
  return lamp;
}

void read_lamps(Section& top, Recipe& recipe, Report& report) {
  const Tree* tree = top.need("lights", "key: {role: key, azimuth: -45 deg, …}");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::mapping || tree->items.empty()) {
    report.error(*tree, "'lights' names at least one lamp", "key: {role: key, …}");
    return;
  }
  bool key = false;
  for (std::size_t i = 0; i < tree->items.size(); ++i) {
    recipe.lamps.push_back(read_lamp(tree->items[i], tree->keys[i], report));
    key |= recipe.lamps.back().role == studio::Role::key && recipe.lamps.back().lux.has_value();
  }
  for (const RecipeLamp& lamp : recipe.lamps)
    if (lamp.stops_below_key && !key)
      report.add({lamp.where, "'below_key' needs a key light whose strength is in lux",
                  "add a lamp with role: key and lux, or give this one lux"});
}

void read_surfaces(Section& top, Recipe& recipe, Report& report) {
  const Tree* tree = top.find("background");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::mapping) {
    report.error(*tree, "'background' gives planes of the studio a colour",
                 "{wall: [0.1, 0.1, 0.1]}");
    return;
  }
  for (std::size_t i = 0; i < tree->items.size(); ++i)
    if (const auto colour = albedo(&tree->items[i], report))
      recipe.surfaces[tree->keys[i].text] = *colour;
}

void read_ambient(Section& top, Recipe& recipe, Report& report) {
  const Tree* tree = top.find("ambient");
  if (tree == nullptr) return;
  Section section(*tree, "ambient", report);
  studio::Ambient ambient;
  if (const auto lux =
          quantity(section.need("lux", "20 lx"), Measure::illuminance, {0, 1e5}, report))
    ambient.illuminance = {*lux};
  if (const auto cct = quantity(section.find("cct"), Measure::temperature, kWhites, report))
    ambient.cct = {*cct};
  section.refuse_unknown();
  recipe.ambient = ambient;
}

void read_studio(Section& top, Recipe& recipe, const studio::Folders& folders, Report& report) {
  const Tree* tree = top.need("studio", "portrait");
  const auto name = text(tree, report);
  if (!name) return;
  recipe.studio = folders.studios() / (*name + ".yaml");
  if (!std::filesystem::exists(recipe.studio))
    report.error(*tree, "there is no studio " + in_quotes(*name) + " among the shipped ones",
                 "name a file of " + folders.studios().string());
}

void read_tags(Section& top, Recipe& recipe, Report& report) {
  const Tree* tree =
      top.need("tags", "{pattern: loop, tone: mid key, hardness: hard, colour: warm}");
  if (tree == nullptr) return;
  Section section(*tree, "tags", report);
  const auto& kinds = core::mood_tag_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Tree* said = section.need(kinds[k].name, kinds[k].words.front());
    if (const auto word = word_among(said, kinds[k].words, report))
      recipe.tags.at(k) = kinds[k].words[*word];
  }
  section.refuse_unknown();
}

void read_words(Section& top, Recipe& recipe, Report& report) {
  const Tree* tree = top.find("words");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::sequence) {
    report.error(*tree, "'words' is a list of words", "[dramatic, painterly, serious]");
    return;
  }
  for (const Tree& item : tree->items)
    if (const auto word = text(&item, report)) recipe.words.push_back(*word);
}

}  // namespace

core::Result<Recipe> parse_recipe(const std::string& yaml, const std::string& file_name,
                                  const studio::Folders& folders) {
  const auto document = parse_tree(yaml, file_name);
  if (!document) return document.problems();
  Report report(file_name);
  report.add(document->problems);
  Section top(document->root, "a recipe", report);
  Recipe recipe;
  into(recipe.title, text(top.need("title", "Rembrandt"), report));
  into(recipe.sentence, text(top.need("sentence", "One sentence for people."), report));
  read_tags(top, recipe, report);
  read_words(top, recipe, report);
  into(recipe.attainable, yes_or_no(top.find("attainable"), report));
  read_studio(top, recipe, folders, report);
  into(recipe.sitter_turn, quantity(top.find("sitter_turn"), Measure::angle, kTurn, report));
  if (const auto cct = quantity(top.find("white_balance"), Measure::temperature, kWhites, report))
    recipe.white_balance = core::Kelvin{*cct};
  read_surfaces(top, recipe, report);
  read_ambient(top, recipe, report);
  read_lamps(top, recipe, report);
  top.refuse_unknown();
  if (report.any_error()) return report.sorted();
  return recipe;
}

core::Result<Recipe> load_recipe(const std::filesystem::path& file,
                                 const studio::Folders& folders) {
  const auto yaml = read_text(file);
  if (!yaml) return yaml.problems();
  return parse_recipe(*yaml, file.string(), folders);
}

}  // namespace chiaro::simulator
