// SPDX-License-Identifier: Apache-2.0
// Portraits of people who are not our sitter, in light that we know: other heads (those of Debian
// packages where they were fetched, else the shipped bust made wider, longer, narrower), other
// skin, other walls, other framing, some mirrored. Drawn by the path tracer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/core/random.h"
#include "controller/daemon/study/scenes.h"

namespace chiaro::daemon::study {

/// One head to be lit.
struct Head {
  std::string name;
  std::filesystem::path mesh;    ///< empty: the shipped bust, changed
  std::optional<double> height;  ///< metres, of the whole figure
  double turn = 0;               ///< radians, so that its face looks at the camera
  core::Vec3 stretch{1, 1, 1};   ///< across, front to back, up; of the changed bust
  double taper = 0;              ///< of the bust: the jaw is narrower by this share
};
/// Those of tests/support/fetch_assets.sh found below `assets` (may be empty or missing); none
/// there gives four relatives of the shipped bust.
std::vector<Head> heads_in(const std::filesystem::path& assets);

/// What is drawn, all of it by chance but the head.
struct Sitting {
  Head head;
  studio::Rig rig;  ///< of the studio's own lamps, key first
  double skin = 1;  ///< factor on every colour of the subject, 0.25 to 2
  core::Rgb wall;
  double shift_x = 0, shift_y = 0, scale = 1;  ///< of the frame: +-0.2 of its side, 0.7 to 1.4
  bool mirrored = false;
};
/// `studio` has fixtures called key, fill, back and wall, as the shipped one.
Sitting sitting(const studio::Studio& studio, Head head, core::Random& random);

struct Portrait {
  core::Picture picture;  ///< as its camera delivered it: clipped, 8 bits, linear again
  studio::Rig truth;      ///< where light comes from in the picture, mirrored with it
};
core::Result<Portrait> drawn(const studio::Studio& studio, const Sitting& sitting, const Shot& shot,
                             ports::World& world);

/// The shipped studio.
core::Result<studio::Studio> portrait_studio(ports::World& world);
/// The rig with left and right exchanged, as seen from the camera.
studio::Rig mirrored(studio::Rig rig);

}  // namespace chiaro::daemon::study
