// SPDX-License-Identifier: Apache-2.0
// Shows of other programs: QLC+ workspaces (.qxw) and MVR scenes (.mvr). Lamps, their patch, places
// and static scenes come over; everything else is listed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/importers/library_fixture.h"
#include "controller/studio/studio.h"

namespace chiaro::importers {

struct ShowLamp {
  std::string name;
  std::string profile, mode;  ///< ours
  bool has_head = false;
  int universe = 1, address = 1;            ///< from 1
  std::optional<core::Vec3> at, direction;  ///< metres, Z up; the beam's
};

/// Raw levels by universe and slot, both from 1.
struct ShowScene {
  struct Level {
    int universe = 1, slot = 1, value = 0;
  };
  std::string name;
  std::vector<Level> levels;
};

struct Show {
  std::vector<ShowLamp> lamps;
  std::vector<studio::Profile> profiles;  ///< that the lamps need and we do not ship
  std::vector<ShowScene> scenes;
  std::vector<std::string> left_out;  ///< one sentence each
};

/// The definition of a maker's model, as QLC+ has it, or nothing.
using Definitions =
    std::function<std::optional<Imported>(const std::string& maker, const std::string& model)>;
/// From the folder of QLC+'s library.
Definitions definitions_in(const std::filesystem::path& library);

core::Result<Show> read_qxw(const std::string& text, const std::string& file,
                            const Definitions& definitions);
/// Lamps whose GDTF file is in the archive.
core::Result<Show> read_mvr(const std::string& bytes, const std::string& file);

/// A studio file with these lamps. Where the show has no places the lamps hang in a half circle
/// before the subject, and a comment says so.
std::string studio_yaml(const Show& show, const std::string& origin);

/// The studio as an MVR scene: lamps, places, patch. Bytes of the archive; the same studio gives
/// the same bytes. `left_out` gains one sentence for each thing that MVR has no word for.
core::Result<std::string> mvr_of(const studio::Studio& studio, const core::AimFrame& aim,
                                 std::vector<std::string>& left_out);

}  // namespace chiaro::importers
