// SPDX-License-Identifier: Apache-2.0
// All that an operator can see of the studio at one moment, as one value, and its JSON: the answer
// of GET /api/v1/state and the body of every `state` event. The brain makes it, the page, the
// stagehand and scripts read it.
//
//   {
//     "version": 17,                       grows with every change
//     "studio": {"name": "portrait three-point", "file": "/…/portrait.yaml", "fingerprint": "9f…",
//                "ready": true,            false while the preview is still being prepared
//                "stage": ""},             what is being prepared, in words; "" when ready
//     "hand": {"connected": true, "refused": false, "real_time": false},   the output process
//     "caution": "normal",                 normal | hold | fade_to_safe | blackout
//     "blackout": false,                   as the output process has it
//     "motion": {"stopped": false, "armed": false, "axes_waiting": 0},   what moves by motor
//     "masters": {"grand": 1, "key": 1, "fill": 1, "back": 1, "background": 1},
//     "look": null | {"id": 3, "name": "Rembrandt", "mood": "rembrandt",      the live look
//                "verdict": "reached", "verdict_when_placed": "near", "remedy": "",
//                "ratio": "4:1 (2 stops)", "light": "820 lx (76 fc)",     all lamps at the face
//                "nudges": {"brighter": 0.25}, "advice": ["…"], "can_nudge": true, "kept": false,
//                by a name "edition": 2,             grows when its pictures do "fade": 0.4, 0..1,
//                1 = the fade is over "picture": "/api/v1/looks/3/picture",   predicted, lamps
//                where they are wanted "placed_picture": "/api/v1/looks/3/placed_picture",   …
//                where they stand now "reference": "/api/v1/moods/rembrandt/picture",   or "" when
//                there was none "trials": 4000, "seconds": 0.8},
//     "design": null | {"job": 5, "mood": "rembrandt", "title": "Rembrandt",  the newest job
//                "status": "running",      queued | running | done | failed | cancelled
//                "stage": "search", "trial": 1200, "trials": 4000, "best": 0.031, "seconds": 0.3,
//                "look": 3,                once done
//                "error": null | {"what", "where", "remedy"}},
//     "fixtures": [{"name": "key", "role": "key", "mount": "stand",
//                "words": "47° camera left, 38° up, 1.6 m",           where it stands
//                "level": "62 %, 0.7 stops below full", "colour": "4300 K",
//                "light": "640 lx (59 fc)", "lux": 640,    this lamp alone, at the face
//                "output_cd": 12000, "measured": false,     true: a meter's word, not the maker's
//                "patch": null | {"universe": 1, "address": 1, "slots": 4},
//                "wanted": {"intensity": 0.62, "cct_k": 4300, "azimuth_deg": -47,
//                           "elevation_deg": 38, "distance_m": 1.6},   by the live look
//                "placed": {"azimuth_deg": -45, "elevation_deg": 35, "distance_m": 1.8},
//                "sent":   {"intensity": 0.62, "cct_k": 4300},         on the wire now
//                "manual": {},             what a person's faders hold
//                "limits": {"intensity": [0, 1], "cct_k": [3200, 5600], "azimuth_deg": [-80, 80]},
//                "locked": false, "controlled": true,
//                "by_hand": ["azimuth_deg", "elevation_deg", "distance_m"],
//                "instruction": null | {"words": "move key to 47° camera left, 38° up, 1.6 m; set
//                key to 1/4 power",
//                           "to": {"azimuth_deg": -47, "elevation_deg": 38, "distance_m": 1.6}}}],
//     "instructions": [{"fixture": "key", "words": "…", "to": {…}}],    the same, gathered
//     "outputs": [{"universe": 1, "health": "good", "rate_hz": 40, "frames": 4012, "late": 0,
//                "failed": 0, "missed": 0,
//                "jitter_us_p50": 40, "jitter_us_p99": 310, "jitter_us_p999": 800}],
//     "tried": {"universe": 1, "slots": {"21": 128}},   slots raised to learn a lamp; else {}
//     "cameras": [{"name": "main", "health": "good", "frames": 120, "reconnects": 0,
//                "picture": "/api/v1/cameras/main/picture",
//                "stream": "/api/v1/cameras/main/stream"}],  health: good | waiting | lost | none
//     "problems": [{"what", "where", "remedy", "warning": false}],
//     "can_undo": true
//   }
//
// Whoever carries out an instruction (a person, or the simulator's stagehand) answers it with
// POST /api/v1/fixtures/{fixture}/placed and the values of "to" (or what was really reached; an
// empty object means "exactly as wanted"). The instruction then disappears and levels follow. What
// is in the slots of a universe now: GET /api/v1/outputs/{universe}/slots.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/result.h"
#include "controller/core/units.h"

namespace chiaro::panel {

/// What the API answers when it refuses: the body of {"error": …} and its HTTP status.
struct Refusal {
  int status = 400;
  std::string what{}, where{}, remedy{};
  core::Problems problems{};  ///< every one, where a whole file was refused
};

struct Instruction {
  std::string fixture, words;
  core::FixtureState to;  ///< only what a hand sets
};

struct PatchView {
  std::uint16_t universe = 1;
  int address = 1, slots = 1;
};

struct FixtureView {
  std::string name, role, mount;
  std::string words, level, colour, light;
  double lux = 0, output_cd = 0;
  bool measured = false;
  std::optional<PatchView> patch;
  core::FixtureState wanted, placed, sent, manual;
  std::vector<std::pair<core::Dof, core::Range>> limits;  ///< inside units
  bool locked = false, controlled = true;
  std::vector<core::Dof> by_hand;
  std::optional<Instruction> instruction;
};

struct LookView {
  std::int64_t id = 0;
  std::string name, mood, verdict, verdict_when_placed, remedy, ratio, light;
  std::vector<std::pair<std::string, double>> nudges;  ///< in stops, those that are not 0
  std::vector<std::string> advice;  ///< what lamps alone cannot do of the last nudge
  bool can_nudge = false, kept = false;
  std::uint64_t edition = 0;
  double fade = 1;
  std::string reference;  ///< address of the reference picture, "" = none
  std::uint64_t trials = 0;
  double seconds = 0;
};

enum class JobStatus { queued, running, done, failed, cancelled };
std::string_view name_of(JobStatus status);
struct JobView {
  std::uint64_t job = 0;
  std::string mood, title;
  JobStatus status = JobStatus::queued;
  std::string stage;
  std::uint64_t trial = 0, trials = 0;
  double best = 0, seconds = 0;
  std::optional<std::int64_t> look;
  std::optional<Refusal> error;
  bool lit = false;  ///< a first answer is on the lamps, stands left where they are
};

struct OutputView {
  std::uint16_t universe = 1;
  std::string health;
  double rate_hz = 0;
  std::uint64_t frames = 0, late = 0, failed = 0;
  double jitter_us_p50 = 0, jitter_us_p99 = 0, jitter_us_p999 = 0;
  std::uint64_t missed = 0;
  std::array<std::uint8_t, 512> slots{};  ///< not in the state's JSON: slots_to_json
};

struct TriedView {
  std::uint16_t universe = 1;
  std::vector<std::pair<std::uint16_t, std::uint8_t>> slots;
};

struct CameraView {
  std::string name, health;
  std::uint64_t frames = 0, reconnects = 0;
};

struct MoodView {
  std::string name, title, sentence;
  std::vector<std::string> tags;
  bool attainable = true;
  bool own = false;                     ///< added by the user: may be removed
  std::vector<std::string> words = {};  ///< what people would look for it by
  std::string turn = "";                ///< how the sitter is turned, in words
};

/// Names of the masters, in the order of rig::Master.
inline constexpr const char* kMasterNames[] = {"grand", "key", "fill", "back", "background"};

struct State {
  std::uint64_t version = 0;
  std::string studio, file, fingerprint;
  bool ready = false;
  std::string stage;
  bool hand_connected = false, hand_refused = false, real_time = false;
  std::string caution = "normal";
  bool blackout = false;
  bool motion_stopped = false, motion_armed = false;
  std::uint32_t axes_waiting = 0;  ///< axes that would move if they were allowed to
  std::array<double, 5> masters{1, 1, 1, 1, 1};
  std::optional<LookView> look;
  std::optional<JobView> design;
  std::vector<FixtureView> fixtures;
  std::vector<OutputView> outputs;
  std::vector<CameraView> cameras;
  TriedView tried;
  std::vector<MoodView> moods;  ///< not in the state's JSON: GET /api/v1/moods
  core::Problems problems;
  bool can_undo = false;

  const FixtureView* fixture(std::string_view name) const;
};

/// `counters` false leaves out what changes all the time (frames, jitter, fade, design progress),
/// so that two states can be compared for a change worth telling.
std::string state_to_json(const State& state, bool counters = true);
/// {"universe": 1, "slots": [0, 255, …512], "owners": [{"fixture": "key", "first": 1, "last": 4}]}
std::string slots_to_json(const State& state, const OutputView& output);
std::string moods_to_json(const State& state);
std::string job_to_json(const JobView& job);
std::string refusal_to_json(const Refusal& refusal);

}  // namespace chiaro::panel
