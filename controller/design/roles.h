// SPDX-License-Identifier: Apache-2.0
// Lamps keep their trade: the optimiser only sees light, a photographer calls the main lamp the
// key.
#pragma once

#include "controller/design/search.h"

namespace chiaro::design {

/// Where the fill came out brighter at the face than the key, tries the two in each other's places
/// and keeps that when it costs hardly more.
Found with_roles_kept(const Setting& setting, Found found, const Options& options, Watch& watch);

/// Lamps that the picture does not need go dark, least first, and the others make up for it.
studio::Rig without_idle_lamps(const Setting& setting, studio::Rig rig);

/// Lamps that end dark need not be carried anywhere: back to where they stand now, where the others
/// leave room.
studio::Rig with_dark_lamps_unmoved(const Setting& setting, studio::Rig rig,
                                    const studio::Rig& placed);

}  // namespace chiaro::design
