// SPDX-License-Identifier: Apache-2.0
#include "controller/design/goal_json.h"

#include <algorithm>
#include <fstream>

#include "controller/core/picture_file.h"
#include "controller/measure/picture_terms/picture_term.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::design {
namespace {

namespace reading = studio::reading;
using reading::Section;
using reading::Tree;
using Like = GoalByHand::Like;

constexpr core::Range kShare{0, 1}, kWeight{0, 100}, kStops{-6, 6}, kMired{-300, 300};
constexpr core::Range kLux{0, 200'000}, kLightness{0, 100}, kSpread{0, 50};
// A point may lie outside of the frame: a region is drawn across its border.
constexpr core::Range kInFrame{-1, 2}, kExtent{1e-4, 3};

class Reader {
 public:
  Reader(const std::string& file, const studio::Studio& studio,
         const std::optional<std::filesystem::path>& folder)
      : studio_(studio), folder_(folder), report_(file) {}

  core::Result<GoalByHand> read(const Tree& root, const core::Problems& known) {
    report_.add(known);
    Section top(root, "a goal", report_);
    if (top.valid()) {
      read_like(top.find("like"));
      read_objective(top.find("objective"));
      read_list(top.find("paint"), "paint", [&](const Tree& each) { read_stroke(each); });
      reading::into(goal_.hold, reading::number(top.find("hold"), kWeight, report_));
      goal_.move = reading::yes_or_no(top.find("move"), report_);
      read_list(top.find("wishes"), "wishes", [&](const Tree& each) { read_wish(each); });
      read_impressions(top.find("impressions"));
      read_bounds(top.find("bounds"));
      read_terms(top.find("terms"));
      read_cameras(top.find("cameras"));
      top.refuse_unknown();
      check_whole(root);
    }
    if (report_.any_error()) return report_.sorted();
    return std::move(goal_);
  }

 private:
  template <class F>
  void read_list(const Tree* tree, const std::string& name, const F& read) {
    if (tree == nullptr) return;
    if (tree->kind != Tree::Kind::sequence)
      return report_.error(*tree, "\"" + name + "\" should be a list",
                           "write \"" + name + "\": [{…}, {…}]");
    for (const Tree& each : tree->items) read(each);
  }

  /// A file beside the goal's; empty, and said why, when there is none or none may be named.
  std::string file_named(const Tree* tree, const std::string& what) {
    const auto name = reading::text(tree, report_);
    if (!name) return "";
    if (!folder_) {
      report_.error(*tree, "a goal sent over the network cannot name files of this machine",
                    "send the picture with the request, or draw regions as polygons");
      return "";
    }
    const std::filesystem::path path = *folder_ / *name;
    if (std::filesystem::is_regular_file(path)) return path.string();
    report_.error(*tree, "there is no " + what + " " + reading::in_quotes(*name),
                  "it was looked for at " + path.string());
    return "";
  }

  void read_like(const Tree* tree) {
    if (tree == nullptr) return;
    if (tree->kind == Tree::Kind::scalar) {
      const std::vector<std::pair<std::string, Like>> words = {{"nothing", Like::nothing},
                                                               {"placed", Like::placed},
                                                               {"live", Like::live},
                                                               {"ideal", Like::ideal}};
      reading::into(goal_.like, reading::choice(tree, words, report_));
      if (goal_.like == Like::live && folder_)
        report_.error(*tree, "\"live\" is what chiarod shows; there is none here",
                      "name a file: {\"look\": \"look.json\"}");
      return;
    }
    const auto shape =
        reading::variant(tree, "what it should be like", {"look", "mood", "exemplar"}, report_);
    if (!shape || shape->body == nullptr) return;
    constexpr Like kKinds[] = {Like::look, Like::mood, Like::exemplar};
    goal_.like = kKinds[shape->index];
    if (goal_.like == Like::mood)
      reading::into(goal_.name, reading::text(shape->body, report_));
    else
      goal_.name = file_named(shape->body, goal_.like == Like::look ? "look" : "picture");
  }

  void read_objective(const Tree* tree) {
    const std::vector<std::pair<std::string, Objective>> words = {
        {"wavelet", Objective::wavelet}, {"perceptual", Objective::perceptual}};
    if (tree != nullptr) reading::into(goal_.objective, reading::choice(tree, words, report_));
  }

  Region read_region(const Tree* tree) {
    Region region;
    if (tree == nullptr) return region;
    if (tree->kind == Tree::Kind::scalar) {
      const std::vector<std::pair<std::string, Region::Kind>> words = {
          {"everything", Region::Kind::everything},
          {"subject", Region::Kind::subject},
          {"background", Region::Kind::background},
          {"face", Region::Kind::face}};
      const auto kind = reading::choice(tree, words, report_);
      if (!kind) return region;
      region.kind = *kind;
      region.words = *kind == Region::Kind::everything ? "the picture" : "the " + tree->text;
      return region;
    }
    const std::vector<std::string> names = {"rectangle", "ellipse", "polygon", "mask", "object"};
    const auto shape = reading::variant(tree, "a region", names, report_);
    if (!shape || shape->body == nullptr) return region;
    constexpr Region::Kind kKinds[] = {Region::Kind::rectangle, Region::Kind::ellipse,
                                       Region::Kind::polygon, Region::Kind::mask,
                                       Region::Kind::object};
    region.kind = kKinds[shape->index];
    region.words = (region.kind == Region::Kind::ellipse ? "an " : "a ") + names[shape->index];
    if (region.kind == Region::Kind::polygon)
      read_corners(*shape->body, region);
    else if (region.kind == Region::Kind::mask)
      read_mask(*shape->body, region);
    else if (region.kind == Region::Kind::object)
      read_object(*shape->body, region);
    else
      read_box(*shape->body, region);
    return region;
  }

  /// A rectangle's corner or an ellipse's centre, and its whole size.
  void read_box(const Tree& tree, Region& region) {
    const bool rectangle = region.kind == Region::Kind::rectangle;
    const auto four =
        reading::numbers(&tree, 4, kInFrame,
                         rectangle ? "[left, top, width, height] as shares of the frame"
                                   : "[centre x, centre y, width, height] as shares of the frame",
                         report_);
    if (!four) return;
    region.width = (*four)[2];
    region.height = (*four)[3];
    region.x = (*four)[0] + (rectangle ? region.width / 2 : 0);
    region.y = (*four)[1] + (rectangle ? region.height / 2 : 0);
    if (!kExtent.contains(region.width) || !kExtent.contains(region.height))
      report_.error(tree, "this region has no size", "give a width and a height above 0");
  }

  void read_corners(const Tree& tree, Region& region) {
    if (tree.kind != Tree::Kind::sequence || tree.items.size() < 3)
      return report_.error(tree, "a polygon has three corners or more",
                           "write \"polygon\": [[0.4, 0.3], [0.5, 0.3], [0.45, 0.4]]");
    for (const Tree& corner : tree.items)
      if (const auto xy =
              reading::numbers(&corner, 2, kInFrame, "[x, y] as shares of the frame", report_))
        region.points.push_back({(*xy)[0], (*xy)[1]});
  }

  void read_mask(const Tree& tree, Region& region) {
    const std::string file = file_named(&tree, "picture");
    if (file.empty()) return;
    const auto picture = core::read_picture(file);
    if (!picture) return report_.add(picture.problems());
    region.mask = core::Plane(picture->size);
    for (std::size_t i = 0; i < picture->values.size(); ++i)
      region.mask.values[i] = static_cast<float>(*std::max_element(picture->values[i].begin(),
                                                                   picture->values[i].end())) /
                              255;
  }

  void read_object(const Tree& tree, Region& region) {
    std::vector<std::string> names;
    for (const auto& subject : studio_.subjects) names.push_back(subject.name);
    if (names.empty())
      return report_.error(tree, "the studio has no subjects", "draw the region instead");
    if (const auto index = reading::word_among(&tree, names, report_)) {
      region.object = static_cast<std::uint16_t>(*index + 1);
      region.words = names[*index];
    }
  }

  void read_stroke(const Tree& tree) {
    Section section(tree, "a stroke of paint", report_);
    if (!section.valid()) return;
    Stroke stroke;
    stroke.region = read_region(section.need("region", "\"region\": \"face\""));
    reading::into(stroke.stops, reading::number(section.find("stops"), kStops, report_));
    reading::into(stroke.mired, reading::number(section.find("mired"), kMired, report_));
    reading::into(stroke.strength, reading::number(section.find("strength"), kWeight, report_));
    section.refuse_unknown();
    if (stroke.stops == 0 && stroke.mired == 0)
      report_.error(
          tree, "this stroke changes nothing",
          "give \"stops\" (+ lighter, - darker), \"mired\" (+ warmer, - cooler), or both");
    goal_.strokes.push_back(std::move(stroke));
  }

  void read_wish(const Tree& tree) {
    Section section(tree, "a wish", report_);
    if (!section.valid()) return;
    Wish wish;
    using Kind = Wish::Kind;
    const std::pair<const char*, Kind> of_light[] = {{"lightness", Kind::lightness},
                                                     {"spread_at_most", Kind::spread_at_most},
                                                     {"spread_at_least", Kind::spread_at_least}};
    const std::pair<const char*, Kind> of_places[] = {
        {"no_shadow", Kind::no_shadow}, {"shadow", Kind::shadow}, {"highlight", Kind::highlight}};
    int given = 0;
    for (const auto& [name, kind] : of_light) {
      const Tree* value = section.find(name);
      if (value == nullptr) continue;
      ++given;
      wish.kind = kind;
      reading::into(
          wish.wanted,
          reading::number(value, kind == Kind::lightness ? kLightness : kSpread, report_));
      wish.region = read_region(section.need("region", "\"region\": \"face\""));
    }
    for (const auto& [name, kind] : of_places) {
      const Tree* value = section.find(name);
      if (value == nullptr) continue;
      ++given;
      wish.kind = kind;
      if (kind == Kind::highlight)
        read_highlight(*value, wish.region);
      else
        wish.region = read_region(value);
      if (const Tree* lamp = section.find("lamp")) wish.lamp = read_lamp(*lamp);
    }
    reading::into(wish.weight, reading::number(section.find("weight"), kWeight, report_));
    section.refuse_unknown();
    if (given != 1)
      report_.error(tree,
                    "a wish is one of lightness, spread_at_most, spread_at_least, no_shadow, "
                    "shadow and highlight",
                    "write {\"no_shadow\": \"face\"} or {\"lightness\": 60, \"region\": \"face\"}");
    goal_.wishes->wishes.push_back(std::move(wish));
  }

  void read_highlight(const Tree& tree, Region& region) {
    const auto xy = reading::numbers(&tree, 2, kShare, "[x, y] as shares of the frame", report_);
    if (!xy) return;
    region.kind = Region::Kind::ellipse;
    region.x = (*xy)[0];
    region.y = (*xy)[1];
    region.width = region.height = 0.03;
    region.words = reading::digits(region.x) + ", " + reading::digits(region.y);
  }

  std::string read_lamp(const Tree& tree) {
    std::vector<std::string> names;
    for (const auto& fixture : studio_.fixtures) names.push_back(fixture.name);
    const auto index = reading::word_among(&tree, names, report_);
    return index ? names[*index] : "";
  }

  void read_impressions(const Tree* tree) {
    if (tree == nullptr) return;
    Section section(*tree, "the impressions", report_);
    for (const Impression& impression : impressions())
      if (const auto weight = reading::number(section.find(impression.name), kWeight, report_))
        impression.add(*goal_.wishes, *weight);
    if (section.valid()) section.refuse_unknown();
  }

  void read_bounds(const Tree* tree) {
    if (tree == nullptr) return;
    Section section(*tree, "the bounds", report_);
    if (!section.valid()) return;
    using Kind = Bound::Kind;
    if (const Tree* lux = section.find("lux_on_face"))
      read_limits(*lux, "lux on the face", kLux, Kind::lux_at_least, Kind::lux_at_most, "");
    if (const Tree* power = section.find("power")) {
      Section limits(*power, "the power", report_);
      add_bound(limits.need("at_most", "\"at_most\": 0.3"), kShare, Kind::power_at_most, "");
      if (limits.valid()) limits.refuse_unknown();
    }
    if (const Tree* levels = section.find("levels")) {
      Section lamps(*levels, "the levels", report_);
      for (const auto& fixture : studio_.fixtures)
        if (const Tree* lamp = lamps.find(fixture.name))
          read_limits(*lamp, "the level of " + fixture.name, kShare, Kind::level_at_least,
                      Kind::level_at_most, fixture.name);
      if (lamps.valid()) lamps.refuse_unknown();
    }
    section.refuse_unknown();
  }

  void read_limits(const Tree& tree, const std::string& what, core::Range range,
                   Bound::Kind at_least, Bound::Kind at_most, const std::string& lamp) {
    Section section(tree, what, report_);
    if (!section.valid()) return;
    const auto least = add_bound(section.find("at_least"), range, at_least, lamp);
    const auto most = add_bound(section.find("at_most"), range, at_most, lamp);
    section.refuse_unknown();
    if (!section.has("at_least") && !section.has("at_most"))
      report_.error(tree, what + " is bounded by nothing", "give at_least, at_most, or both");
    if (least && most && *least > *most)
      report_.error(tree,
                    what + " cannot be at least " + reading::digits(*least) + " and at most " +
                        reading::digits(*most),
                    "exchange the two");
  }

  std::optional<double> add_bound(const Tree* tree, core::Range range, Bound::Kind kind,
                                  const std::string& lamp) {
    const auto limit = reading::number(tree, range, report_);
    if (limit) goal_.wishes->bounds.push_back({kind, *limit, lamp});
    return limit;
  }

  /// {"entropy": 0.5} or {"key_fill": {"weight": 1, "wanted": 8}}.
  void read_terms(const Tree* tree) {
    if (tree == nullptr) return;
    Section section(*tree, "the terms", report_);
    for (const auto& term : measure::terms::picture_terms()) {
      const Tree* value = section.find(term.name);
      if (value == nullptr) continue;
      TermShare share{std::string(term.name), 1, std::nullopt};
      if (value->kind == Tree::Kind::mapping) {
        Section both(*value, "the term " + share.name, report_);
        reading::into(share.weight, reading::number(both.find("weight"), kWeight, report_));
        share.wanted = reading::number(both.find("wanted"), term.wanted, report_);
        both.refuse_unknown();
      } else {
        reading::into(share.weight, reading::number(value, kWeight, report_));
      }
      goal_.wishes->terms.push_back(std::move(share));
    }
    if (section.valid()) section.refuse_unknown();
  }

  void read_cameras(const Tree* tree) {
    if (tree == nullptr) return;
    Section section(*tree, "the cameras", report_);
    for (std::size_t i = 1; i < studio_.cameras.size(); ++i)
      if (const auto weight =
              reading::number(section.find(studio_.cameras[i].name), kWeight, report_))
        goal_.wishes->cameras.push_back({studio_.cameras[i].name, *weight, nullptr});
    if (section.valid()) section.refuse_unknown();
  }

  void check_whole(const Tree& root) {
    if (goal_.strokes.empty() && goal_.wishes->empty() && !report_.any_error())
      report_.error(root, "this goal asks for nothing",
                    "add paint, wishes, impressions or bounds; config/goals has examples");
  }

  const studio::Studio& studio_;
  const std::optional<std::filesystem::path>& folder_;
  reading::Report report_;
  GoalByHand goal_;
};

}  // namespace

core::Result<GoalByHand> goal_from_json(const std::string& text, const std::string& file,
                                        const studio::Studio& studio,
                                        const std::optional<std::filesystem::path>& folder) {
  const auto document = reading::parse_tree(text, file);
  if (!document) return document.problems();
  return Reader(file, studio, folder).read(document->root, document->problems);
}

}  // namespace chiaro::design
