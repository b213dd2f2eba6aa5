// SPDX-License-Identifier: Apache-2.0
// MVR scenes, in and out. Lengths are millimetres, Z is up, a lamp shines along its -Z.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <sstream>

#include "controller/core/hash.h"
#include "controller/importers/gdtf.h"
#include "controller/importers/show.h"
#include "controller/importers/show_names.h"
#include "controller/importers/xml.h"
#include "controller/importers/zip.h"
#include "controller/studio/words.h"

namespace chiaro::importers {
namespace {

constexpr int kDeepest = 64;
constexpr std::size_t kMostLamps = 2000, kMostGdtf = 64u << 20;

/// "{u}{v}{w}{o}" of three numbers each: axes, then the origin in millimetres.
struct Matrix {
  core::Vec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1}, origin;
  core::Vec3 apply(core::Vec3 p) const { return p.x * u + p.y * v + p.z * w + origin; }
  core::Vec3 turn(core::Vec3 d) const { return d.x * u + d.y * v + d.z * w; }
};

Matrix matrix_in(const std::string& words) {
  std::vector<double> n;
  std::size_t from = 0;
  while (from < words.size() && n.size() < 12) {
    const std::size_t at = words.find_first_of("+-.0123456789", from);
    if (at == std::string::npos) break;
    const std::size_t end = std::min(words.find_first_of(",{} ", at), words.size());
    n.push_back(number_in(std::string_view(words).substr(at, end - at), -1e9, 1e9, 0));
    from = end;
  }
  if (n.size() != 12) return {};
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, {n[9], n[10], n[11]}};
}

Matrix below(const Matrix& parent, const Matrix& own) {
  return {parent.turn(own.u), parent.turn(own.v), parent.turn(own.w), parent.apply(own.origin)};
}

class Reader {
 public:
  Reader(const std::string& bytes, const std::string& file, Show& show)
      : bytes_(bytes), file_(file), show_(show) {}

  void walk(pugi::xml_node node, const Matrix& parent, int depth) {
    if (depth > kDeepest) return;
    for (const pugi::xml_node child : node.children()) {
      const std::string kind = child.name();
      const Matrix here = child.child("Matrix") && kind != "Layer"
                              ? below(parent, matrix_in(child.child_value("Matrix")))
                              : parent;
      if (kind == "Fixture")
        fixture(child, here);
      else if (kind == "SceneObject" || kind == "Truss" || kind == "Support" ||
               kind == "VideoScreen" || kind == "Projector")
        ++others_[kind];
      if (kind == "Layer" || kind == "ChildList" || kind == "GroupObject" || kind == "Fixture" ||
          kind == "SceneObject" || kind == "Truss" || kind == "Support" || kind == "Layers")
        walk(child, here, depth + 1);
    }
  }

  void list_others() {
    for (const auto& [kind, count] : others_)
      show_.left_out.push_back(
          fmt::format("{} of kind {}: describe what matters as background in "
                      "the studio file",
                      count == 1 ? "an object" : std::to_string(count) + " objects", kind));
  }

 private:
  void fixture(pugi::xml_node node, const Matrix& at) {
    const std::string name = node.attribute("name").as_string();
    const std::string spec = node.child_value("GDTFSpec"), mode = node.child_value("GDTFMode");
    if (show_.lamps.size() >= kMostLamps) return;
    const studio::Profile* profile = profile_of_spec(spec);
    if (profile == nullptr) {
      show_.left_out.push_back(fmt::format("fixture '{}': {}", name, why_[spec]));
      return;
    }
    const auto found = std::find_if(profile->modes.begin(), profile->modes.end(),
                                    [&](const studio::Mode& m) { return m.name == mode; });
    if (found == profile->modes.end()) {
      show_.left_out.push_back(
          fmt::format("fixture '{}': its mode '{}' sets no light, or is not known", name, mode));
      return;
    }
    const auto address = address_of(node);
    if (!address) {
      show_.left_out.push_back(fmt::format("fixture '{}': it has no address", name));
      return;
    }
    ShowLamp lamp{names_.fresh(name), profile->name,   found->name,       profile->pan.width() > 0,
                  address->first,     address->second, 0.001 * at.origin, {}};
    const core::Vec3 beam = -1 * at.w;
    if (core::length(beam) > 1e-9) lamp.direction = core::unit(beam);
    show_.lamps.push_back(std::move(lamp));
  }

  /// "1.005", or counted through all universes: 517.
  static std::optional<std::pair<int, int>> address_of(pugi::xml_node node) {
    for (const pugi::xml_node each : node.child("Addresses").children("Address")) {
      const std::string words = each.child_value();
      const std::size_t dot = words.find('.');
      if (dot != std::string::npos) {
        const int universe = whole_in(std::string_view(words).substr(0, dot), 1, 63999, 0);
        const int address = whole_in(std::string_view(words).substr(dot + 1), 1, 512, 0);
        if (universe > 0 && address > 0) return std::pair(universe, address);
      } else if (const int all = whole_in(words, 1, 63999 * 512, 0); all > 0) {
        return std::pair((all - 1) / 512 + 1, (all - 1) % 512 + 1);
      }
    }
    return std::nullopt;
  }

  const studio::Profile* profile_of_spec(const std::string& spec) {
    if (const auto known = profiles_.find(spec); known != profiles_.end())
      return known->second ? &*known->second : nullptr;
    auto& profile = profiles_[spec];
    const std::string member =
        spec.size() > 5 && spec.compare(spec.size() - 5, 5, ".gdtf") == 0 ? spec : spec + ".gdtf";
    const auto gdtf = zip_member(bytes_, member, kMostGdtf, file_);
    const auto fixture = gdtf ? read_gdtf(*gdtf, file_ + ":" + member)
                              : core::Result<LibraryFixture>(gdtf.problems());
    auto made = fixture ? profile_of(*fixture, file_ + ":" + member)
                        : core::Result<Imported>(fixture.problems());
    if (made) {
      profile = made->profile;
      show_.profiles.push_back(*profile);
      return &*profile;
    }
    why_[spec] = made.problems().front().what;
    return nullptr;
  }

  const std::string& bytes_;
  const std::string& file_;
  Show& show_;
  ShowNames names_;
  std::map<std::string, std::optional<studio::Profile>> profiles_;
  std::map<std::string, std::string> why_;
  std::map<std::string, int> others_;
};

/// Stable, and in the form of a UUID, though nobody drew it.
std::string uuid_of(const std::string& words) {
  const std::uint64_t a = core::Fingerprint().add(words).value();
  const std::uint64_t b = core::Fingerprint().add("again " + words).value();
  return fmt::format("{:08X}-{:04X}-8{:03X}-A{:03X}-{:012X}", a >> 32u, a >> 16u & 0xffffu,
                     a & 0xfffu, b >> 48u & 0xfffu, b & 0xffffffffffffu);
}

std::optional<std::pair<core::Vec3, core::Vec3>> pose_of(const studio::Fixture& fixture,
                                                         const core::AimFrame& aim) {
  if (const auto* fixed = std::get_if<studio::FixedMount>(&fixture.mount))
    return std::pair(fixed->at, fixed->aim_at);
  if (const auto* head = std::get_if<studio::PanTiltMount>(&fixture.mount))
    return std::pair(head->at, head->aim_at);
  if (const auto* stand = std::get_if<studio::StandMount>(&fixture.mount))
    return std::pair(core::position(aim, stand->at), aim.origin);
  if (const auto* free = std::get_if<studio::VirtualMount>(&fixture.mount))
    return std::pair(core::position(aim, free->at), aim.origin);
  if (const auto* track = std::get_if<studio::TrackMount>(&fixture.mount))
    return std::pair(track->from + track->at * (track->to - track->from), aim.origin);
  return std::nullopt;
}

std::string matrix_words(core::Vec3 at, core::Vec3 target) {
  const core::Vec3 w = core::unit(at - target);  // the beam leaves along -Z
  const core::Vec3 level = core::cross(core::Vec3{0, 0, 1}, w);
  const core::Vec3 u = core::length(level) > 1e-9 ? core::unit(level) : core::Vec3{1, 0, 0};
  const core::Vec3 v = core::cross(w, u);
  const auto triple = [](core::Vec3 p, double scale) {
    return fmt::format("{{{:.6f},{:.6f},{:.6f}}}", scale * p.x, scale * p.y, scale * p.z);
  };
  return triple(u, 1) + triple(v, 1) + triple(w, 1) + triple(at, 1000);
}

}  // namespace

core::Result<Show> read_mvr(const std::string& bytes, const std::string& file) {
  if (const auto names = zip_names(bytes, file); !names) return names.problems();
  const auto xml = zip_member(bytes, "GeneralSceneDescription.xml", kMostXmlBytes, file);
  if (!xml) return xml.problems();
  pugi::xml_document document;
  if (const auto read = read_xml(*xml, file, document); !read) return read.problems();
  const pugi::xml_node scene = document.child("GeneralSceneDescription").child("Scene");
  if (!scene)
    return core::Problem{{file, 0, 0},
                         "this scene description is not MVR",
                         "it holds <GeneralSceneDescription><Scene>",
                         false};
  Show show;
  Reader reader(bytes, file, show);
  reader.walk(scene, {}, 0);
  reader.list_others();
  return show;
}

core::Result<std::string> mvr_of(const studio::Studio& studio, const core::AimFrame& aim,
                                 std::vector<std::string>& left_out) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("GeneralSceneDescription");
  root.append_attribute("verMajor") = 1;
  root.append_attribute("verMinor") = 5;
  root.append_attribute("provider") = "Chiaro";
  pugi::xml_node layer = root.append_child("Scene").append_child("Layers").append_child("Layer");
  layer.append_attribute("name") = studio.name.c_str();
  layer.append_attribute("uuid") = uuid_of("layer " + studio.name).c_str();
  pugi::xml_node list = layer.append_child("ChildList");
  int number = 0;
  for (const studio::Fixture& fixture : studio.fixtures) {
    const auto pose = pose_of(fixture, aim);
    const auto* dmx = std::get_if<studio::DmxPatch>(&fixture.patch);
    if (!pose || dmx == nullptr || core::distance(pose->first, pose->second) < 1e-6) {
      left_out.push_back("'" + fixture.name + "' (" + std::string(studio::name_of(fixture.mount)) +
                         ", " + studio::patch_in_words(fixture) + "): MVR has no word for it");
      continue;
    }
    pugi::xml_node node = list.append_child("Fixture");
    node.append_attribute("name") = fixture.name.c_str();
    node.append_attribute("uuid") = uuid_of("fixture " + fixture.name).c_str();
    const auto add = [&](const char* key, const std::string& value) {
      node.append_child(key).text().set(value.c_str());
    };
    add("Matrix", matrix_words(pose->first, pose->second));
    add("GDTFSpec", fixture.profile.maker + "@" + fixture.profile.model + ".gdtf");
    add("GDTFMode", fixture.profile.modes.at(fixture.mode).name);
    pugi::xml_node address = node.append_child("Addresses").append_child("Address");
    address.append_attribute("break") = 0;
    address.text().set((dmx->universe - 1) * 512 + dmx->address);
    add("FixtureID", std::to_string(++number));
    add("UnitNumber", std::to_string(number));
  }
  left_out.emplace_back(
      "the GDTF files of the lamps: the program that opens the scene has them, or "
      "asks for them by maker and model");
  std::ostringstream xml;
  document.save(xml, " ");
  return zip_of({{"GeneralSceneDescription.xml", xml.str()}});
}

}  // namespace chiaro::importers
