// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fake_brain.h"

#include "controller/core/picture_file.h"

namespace chiaro::support {
namespace {

using core::Dof;

panel::FixtureView lamp(const std::string& name, const std::string& role, bool stand) {
  panel::FixtureView view;
  view.name = name;
  view.role = role;
  view.mount = stand ? "stand" : "fixed";
  view.words = "45° camera left, 35° up, 1.8 m";
  view.level = "50 %, 1.0 stop below full";
  view.colour = "4300 K";
  view.sent.set(Dof::intensity, 0.5);
  view.sent.set(Dof::cct, 4300);
  view.limits = {{Dof::intensity, {0, 0.9}}, {Dof::cct, {3200, 5600}}};
  if (!stand) return view;
  view.by_hand = {Dof::azimuth, Dof::elevation, Dof::distance};
  view.limits.push_back({Dof::azimuth, {core::radians(-80), core::radians(80)}});
  view.placed.set(Dof::azimuth, core::radians(-45));
  view.placed.set(Dof::elevation, core::radians(35));
  view.placed.set(Dof::distance, 1.8);
  return view;
}

}  // namespace

FakeBrain::FakeBrain() {
  state_.version = 17;
  state_.studio = "portrait";
  state_.file = "/studios/portrait.yaml";
  state_.fingerprint = "00000000000000ff";
  state_.ready = state_.hand_connected = true;
  state_.fixtures = {lamp("key", "key", true), lamp("fill", "fill", false),
                     lamp("lamp", "practical", false)};
  state_.fixtures[2].controlled = false;
  state_.outputs = {{1, "good", 40, 4012, 0, 0, 40, 310}};
  state_.cameras = {{"main", "good", 120, 0}};
  state_.moods = {{"rembrandt", "Rembrandt", "A triangle of light", {"classic"}, true, false},
                  {"split", "Split", "Half and half", {}, true, false},
                  {"window", "By the window", "Your own picture", {}, true, true}};
}

std::vector<panel::LookEntry> FakeBrain::looks() const {
  return {{3, "Rembrandt", "rembrandt", "reached", "2026-01-01T00:00:00Z", true}};
}

std::variant<panel::PictureFile, panel::Refusal> FakeBrain::picture(const panel::PictureOf& which) {
  if (which.kind == panel::PictureOf::Kind::mood && which.name == "rembrandt")
    return panel::PictureFile{"image/png", small_png()};
  return panel::Refusal{404, "no such picture", which.name, "ask for another"};
}

void FakeBrain::perform(const panel::Gesture& gesture, panel::Answer answer) {
  gestures.push_back(gesture);
  if (answers)
    answer(outcome);
  else
    waiting.push_back(std::move(answer));
}

std::string small_png() {
  const auto bytes = core::encode_png(core::EncodedPicture({4, 3}, {200, 100, 50}));
  return {bytes.begin(), bytes.end()};
}

std::string base64(const std::string& bytes) {
  static constexpr char kAlphabet[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned held = 0, bits = 0;
  for (const char c : bytes) {
    held = (held << 8u) | static_cast<unsigned char>(c);
    for (bits += 8; bits >= 6; bits -= 6) out.push_back(kAlphabet[(held >> (bits - 6)) & 63u]);
  }
  if (bits > 0) out.push_back(kAlphabet[(held << (6 - bits)) & 63u]);
  while (out.size() % 4 != 0) out.push_back('=');
  return out;
}

}  // namespace chiaro::support
