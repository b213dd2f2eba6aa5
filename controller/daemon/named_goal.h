// SPDX-License-Identifier: Apache-2.0
// Goals that people name on the command line: a mood, or any picture.
#pragma once

#include <string>

#include "controller/design/design.h"
#include "controller/ports/world.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {

/// An unknown name answers with the nearest and all; broken moods are told on world.err.
core::Result<design::Goal> mood_goal(const std::string& wanted, const studio::Folders& folders,
                                     design::Objective objective, ports::World& world);
core::Result<design::Goal> picture_goal(const std::string& file, design::Objective objective);
core::Result<std::string> text_of(const std::string& file);

}  // namespace chiaro::daemon
