// SPDX-License-Identifier: Apache-2.0
// What a lamp makes of its slots, worked out from the profile's file alone: shares no code with
// controller/studio or controller/patch, so that an error in both directions of those shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace chiaro::support {

struct DecodedChannel {
  std::string controls;  ///< "intensity", "cct", … also of a repetition; "" where held or a trim
  std::vector<int> at;   ///< its slots from 0, most significant first
  double value = 0;   ///< light (through the curve) for dimmers, else the DOF's file unit
  double step = 0;    ///< what one step of the channel changes at most
  bool whole = true;  ///< one unbroken law over the whole channel, untrimmed, no repetition
};

/// The names of a profile's modes, in the file's order.
std::vector<std::string> modes_in(const std::filesystem::path& profile_file);
/// Whether the lamp has a head that pans.
bool has_head(const std::filesystem::path& profile_file);
/// `slots`: the fixture's own, from its address on.
std::vector<DecodedChannel> decode_slots(const std::filesystem::path& profile_file,
                                         const std::string& mode,
                                         std::span<const std::uint8_t> slots);

}  // namespace chiaro::support
