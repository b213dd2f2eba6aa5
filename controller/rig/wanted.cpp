// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/wanted.h"

namespace chiaro::rig {

std::string_view name_of(Caution caution) {
  switch (caution) {
    case Caution::normal:
      return "normal";
    case Caution::hold:
      return "hold";
    case Caution::fade_to_safe:
      return "fade to safe";
    case Caution::blackout:
      return "blackout";
  }
  return "?";
}

std::string_view name_of(Mark mark) {
  switch (mark) {
    case Mark::highlight:
      return "highlight";
    case Mark::flash:
      return "flash";
    case Mark::solo:
      return "solo";
    case Mark::park:
      return "park";
    case Mark::move_in_black:
      return "move-in-black";
  }
  return "?";
}

std::string_view name_of(Master master) {
  switch (master) {
    case Master::grand:
      return "grand";
    case Master::key:
      return "key";
    case Master::fill:
      return "fill";
    case Master::back:
      return "back";
    case Master::background:
      return "background";
  }
  return "?";
}

std::string_view name_of(Limit limit) {
  switch (limit) {
    case Limit::most:
      return "its own limit";
    case Limit::slew:
      return "its slew limit";
    case Limit::flash:
      return "the flash guard";
    case Limit::power:
      return "its circuit's power";
    case Limit::motion:
      return "motion that is not armed, or stopped";
    case Limit::person:
      return "a person in the way";
  }
  return "?";
}

}  // namespace chiaro::rig
