// SPDX-License-Identifier: Apache-2.0
// Answers as a studio file that a person will want to edit: aligned, commented, one lamp a block.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "controller/core/units.h"
#include "controller/daemon/interview/answers.h"

namespace chiaro::daemon::interview {
namespace {

/// At most `decimals`, no trailing zeros, no minus zero.
std::string number(double value, int decimals = 3) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string out = text;
  if (out.find('.') != std::string::npos) {
    out.erase(out.find_last_not_of('0') + 1);
    if (out.back() == '.') out.pop_back();
  }
  return out == "-0" ? "0" : out;
}

/// In double quotes, where YAML and JSON agree.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// A name without quotes where YAML takes it as text anyway.
std::string named(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  const bool bare = std::all_of(name.begin(), name.end(), plain) && name.front() != '-' &&
                    name != "null" && name != "Null" && name != "NULL";
  return bare ? name : quoted(name);
}

std::string vector(core::Vec3 v) {
  return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

std::string degrees(double radians) { return number(core::degrees(radians), 1) + " deg"; }

std::string span(double least, double most, const char* unit) {
  return "[" + number(least, 1) + unit + ", " + number(most, 1) + unit + "]";
}

std::string subject(const Answers& a) {
  std::string text = "subject:\n";
  if (a.mesh.empty())
    return text + "  stand_in: person               # the shipped bust, for any sitter\n" +
           "  eye_height: " + number(a.eye_height) + " m\n";
  return text + "  mesh: " + quoted(a.mesh) + "\n  height: " + number(a.height) +
         " m\n  at: [0, 0, " + number(a.base) + "]\n";
}

std::string room(const Answers& a) {
  std::string text = "ceiling: " + number(a.ceiling) + " m\nbackground:\n";
  if (a.wall)
    text += "  - {plane: wall, through: [0, " + number(*a.wall) +
            ", 0], normal: [0, -1, 0], diffuse: [0.35, 0.35, 0.35]}\n";
  return text +
         "  - {plane: floor, through: [0, 0, 0], normal: [0, 0, 1], diffuse: [0.3, 0.3, 0.3]}\n";
}

std::string camera(const Answers& a) {
  std::string text =
      "cameras:\n  main:\n    at: " + vector({0, -a.camera_distance, a.camera_height}) +
      "\n    look_at: " + vector({0, 0, a.aim_height() - 0.05}) +
      "\n    vertical_fov: " + number(a.camera_fov_deg) + " deg\n";
  if (a.camera_source.rfind("http://", 0) == 0)
    text += "    source: {http: " + quoted(a.camera_source) + "}\n";
  else if (!a.camera_source.empty())
    text += "    source: {v4l2: " + quoted(a.camera_source) + "}\n";
  return text;
}

/// Room to move about where the stand is now: all of the front for a lamp in front.
std::string stand(const Lamp& lamp) {
  const double azimuth = core::degrees(lamp.place.azimuth);
  const double elevation = core::degrees(lamp.place.elevation);
  const bool front = std::abs(azimuth) <= 80;
  const double left = front ? -80 : std::max(-180.0, azimuth - 30);
  const double right = front ? 80 : std::min(180.0, azimuth + 30);
  return "    mount:\n      stand:\n        at: {azimuth: " + degrees(lamp.place.azimuth) +
         ", elevation: " + degrees(lamp.place.elevation) +
         ", distance: " + number(lamp.place.distance) +
         " m}\n        azimuth: " + span(std::floor(left), std::ceil(right), " deg") +
         "\n        elevation: " +
         span(std::min(-30.0, std::floor(elevation)), std::max(65.0, std::ceil(elevation)),
              " deg") +
         "\n        distance: " +
         span(std::min(std::max(0.8, lamp.place.distance - 0.6),
                       std::floor(10 * lamp.place.distance) / 10),
              lamp.place.distance + 0.6, " m") +
         "\n";
}

std::string hung(const Lamp& lamp, const core::AimFrame& aim, std::optional<double> wall) {
  const core::Vec3 at = core::position(aim, lamp.place);
  // A background lamp lights the wall, everything else the sitter.
  const core::Vec3 aim_at = lamp.role == "background" && wall
                                ? core::Vec3{aim.origin.x, *wall, aim.origin.z}
                                : aim.origin;
  return "    mount: {fixed: {at: " + vector(at) + ", aim_at: " + vector(aim_at) + "}}\n";
}

std::string axis(const Motor& motor) {
  return "axis: {channel: " + std::to_string(motor.slot) +
         ", bits: " + std::to_string(8 * motor.bytes) + "}";
}

/// Through where the lamp is now: round the sitter at its height, or upright over the sitter.
std::string arc(const Lamp& lamp, const core::AimFrame& aim) {
  const core::Vec3 from_aim = core::position(aim, lamp.place) - aim.origin;
  const double front = core::dot(from_aim, aim.towards_camera),
               side = core::dot(from_aim, aim.camera_right);
  const bool over = lamp.motor.over;
  const core::Vec3 centre =
      aim.origin + (over ? side * aim.camera_right : core::Vec3{0, 0, from_aim.z});
  const double across = over ? from_aim.z : side, at = std::atan2(across, front);
  return "    mount:\n      arc:\n        centre: " + vector(centre) +
         "\n        radius: " + number(std::hypot(across, front)) + " m\n        angle: " +
         span(std::floor(core::degrees(at - lamp.motor.travel)),
              std::ceil(core::degrees(at + lamp.motor.travel)), " deg") +
         "\n        at: " + degrees(at) + "\n        plane: " + (over ? "vertical" : "horizontal") +
         "\n        " + axis(lamp.motor) + "\n";
}

std::string track(const Lamp& lamp, const core::AimFrame& aim) {
  return "    mount:\n      track:\n        from: " + vector(core::position(aim, lamp.place)) +
         "\n        to: " + vector(core::position(aim, lamp.motor.far_end)) +
         "\n        at: " + number(100 * lamp.motor.along, 1) + " %\n        " + axis(lamp.motor) +
         "\n";
}

std::string mount(const Lamp& lamp, const core::AimFrame& aim, std::optional<double> wall) {
  switch (lamp.held) {
    case Held::stand:
      return stand(lamp);
    case Held::hung:
      return hung(lamp, aim, wall);
    case Held::arc:
      return arc(lamp, aim);
    case Held::track:
      return track(lamp, aim);
  }
  return "";
}

std::string outputs(const Answers& a) {
  std::set<int> universes;
  for (const Lamp& lamp : a.lamps) universes.insert(lamp.universe);
  std::string text = "outputs:\n";
  for (const int universe : universes)
    text += "  universe " + std::to_string(universe) + ": " +
            (a.interface.empty() ? "mock                # no wire yet: {sacn: {interface: eth0}}"
                                 : "{sacn: {interface: " + named(a.interface) + ", rate: 40 Hz}}") +
            "\n";
  return text;
}

}  // namespace

std::string lamp_yaml(const Lamp& lamp, const core::AimFrame& aim, std::optional<double> wall) {
  return "  " + named(lamp.name) + ":\n    role: " + lamp.role + "\n    profile: " + lamp.profile +
         "\n    mode: " + named(lamp.mode) + "\n" + mount(lamp, aim, wall) +
         "    patch: {universe: " + std::to_string(lamp.universe) +
         ", address: " + std::to_string(lamp.address) + "}\n";
}

core::AimFrame Answers::aim() const {
  return core::aim_frame({0, 0, aim_height()}, {0, -camera_distance, camera_height});
}

std::string studio_yaml(const Answers& a) {
  std::string text =
      "# Written by `chiaro new`. `chiaro check` on this file prints its patch sheet.\nstudio: " +
      quoted(a.studio) + "\n\n" + subject(a) + "\n" + room(a) + "\n" + camera(a) +
      "\n# Places are seen from the sitter: azimuth 0 deg is towards the camera, + is the\n"
      "# camera's right; elevation is + upwards.\nfixtures:\n";
  for (const Lamp& lamp : a.lamps) text += lamp_yaml(lamp, a.aim(), a.wall);
  return text + "\n" + outputs(a) +
         "\n# An 18 % card lit by this much renders as mid grey (L* 50).\nexposure: {grey_card: " +
         number(a.grey_card_lux) + " lx, white_balance: " + number(a.white_balance_k) + " K}\n";
}

}  // namespace chiaro::daemon::interview
