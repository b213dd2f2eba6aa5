// SPDX-License-Identifier: Apache-2.0
// The daemon's HTTP API over any brain: which address means what. Pure of sockets: the server
// feeds it requests, tests do too.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "controller/panel/gestures.h"
#include "controller/panel/http.h"
#include "controller/panel/state.h"

namespace chiaro::panel {

/// How the brain answers a gesture: a refusal, or a status and a JSON body.
struct Outcome {
  std::optional<Refusal> refused;
  int status = 200;
  std::string json = "{}";
};
using Answer = std::function<void(Outcome)>;

/// Which picture: of a mood, of a look (predicted, wanted or placed), of a camera now, or the
/// reference of a job made from an uploaded picture.
struct PictureOf {
  enum class Kind { mood, look_wanted, look_placed, look_reference, camera } kind;
  std::string name;     ///< mood, camera
  std::int64_t id = 0;  ///< look
};
struct PictureFile {
  std::string type;  ///< "image/png"
  std::string bytes;
};

struct LookEntry {
  std::int64_t id = 0;
  std::string name, mood, verdict, created;
  bool live = false, kept = false;  ///< kept: a person gave it its name
};

/// Counters since the brain started, for /metrics.
struct Counters {
  std::uint64_t designs_done = 0, designs_failed = 0, designs_cancelled = 0, trials = 0;
  std::uint64_t requests = 0, event_listeners = 0;
  double design_seconds = 0;
};

/// What the panel asks of the brain. Thread-bound: the loop.
class Brain {
 public:
  virtual ~Brain() = default;
  virtual const State& state() const = 0;
  virtual const Counters& counters() const = 0;
  virtual std::vector<LookEntry> looks() const = 0;
  virtual std::variant<PictureFile, Refusal> picture(const PictureOf& which) = 0;
  /// Carries the gesture out; `answer` is called exactly once, perhaps later, on the loop.
  virtual void perform(const Gesture& gesture, Answer answer) = 0;
};

/// Answers one request (already let in by `forbidden`).
void answer(const Request& request, Brain& brain, Reply reply);

/// Prometheus text.
std::string metrics_of(const State& state, const Counters& counters);

}  // namespace chiaro::panel
