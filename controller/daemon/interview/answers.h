// SPDX-License-Identifier: Apache-2.0
// What `chiaro new` learns from a person, and the studio file that says it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/daemon/interview/learnt.h"
#include "controller/studio/load.h"

namespace chiaro::daemon::interview {

/// A stand is moved by a person, an arc and a track by a motor; what hangs stays. In the order of
/// panel::kHeldBy, their names.
enum class Held { stand, hung, arc, track };

/// What moves a lamp that a motor moves. Its slots follow the lamp's own in the same patch.
struct Motor {
  int slot = 2;       ///< the first, counted from the lamp's first, which is 1
  int bytes = 2;      ///< 1 or 2
  bool over = false;  ///< an arc over the sitter; else round the sitter at the lamp's height
  double travel = core::radians(60);  ///< of an arc: each way from where the lamp is
  core::Spherical far_end;            ///< of a track that begins at the lamp's place
  double along = 0.5;                 ///< 0..1: where on its track the lamp hangs now
};

struct Lamp {
  std::string name, role, profile, mode;
  int universe = 1, address = 1, slots = 1;
  core::Spherical place;  ///< on a track: one end of it
  Held held = Held::stand;
  Motor motor{};  ///< of arc and track only
};

struct Answers {
  std::string studio;
  std::string mesh;             ///< empty = a person, for whom the bust stands in
  double eye_height = 1.25;     ///< of the person
  double height = 1, base = 0;  ///< of the mesh: how tall, and how high its base stands
  double ceiling = 3;
  std::optional<double> wall;  ///< metres behind the sitter
  double camera_distance = 2.6, camera_height = 1.25, camera_fov_deg = 22;
  std::string camera_source;  ///< as in Camera::source; empty = none
  double grey_card_lux = 800, white_balance_k = 5600;
  std::string interface;  ///< empty = no wire yet
  std::vector<Lamp> lamps;
  std::vector<LearntLamp> learnt;  ///< profiles to be written beside the studio file

  double aim_height() const { return mesh.empty() ? eye_height : base + 0.75 * height; }
  /// From where azimuth, elevation and distance are measured, as well as can be known without
  /// looking at the mesh.
  core::AimFrame aim() const;
};

class Dialogue;
class Wire;
/// Asks everything. Nothing when the input ended before the last question. `base` is the folder of
/// the file to be: relative paths are meant from there. `wire`: for lamps that are learned.
std::optional<Answers> interview(Dialogue& dialogue, const std::filesystem::path& base,
                                 const studio::Folders& folders, Wire& wire);

std::string studio_yaml(const Answers& answers);
/// One lamp's entry below `fixtures:`, indented by two; `wall`: metres behind the sitter.
std::string lamp_yaml(const Lamp& lamp, const core::AimFrame& aim, std::optional<double> wall);

}  // namespace chiaro::daemon::interview
