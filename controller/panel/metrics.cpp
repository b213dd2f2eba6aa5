// SPDX-License-Identifier: Apache-2.0
// Prometheus' text format: one HELP and TYPE per family, then its samples.
#include <fmt/format.h>
#include <iterator>

#include "controller/panel/api.h"

namespace chiaro::panel {
namespace {

class Text {
 public:
  void family(const char* name, const char* type, const char* help) {
    fmt::format_to(std::back_inserter(text_), "# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
  }
  void sample(const std::string& name, double value) {
    fmt::format_to(std::back_inserter(text_), "{} {:.15g}\n", name, value);
  }
  void one(const char* name, const char* type, const char* help, double value) {
    family(name, type, help);
    sample(name, value);
  }
  std::string text_;
};

void add_outputs(Text& text, const State& state) {
  const auto each = [&](const char* name, const char* type, const char* help, auto value) {
    text.family(name, type, help);
    for (const OutputView& output : state.outputs)
      text.sample(fmt::format("{}{{universe=\"{}\"}}", name, output.universe), value(output));
  };
  using Out = const OutputView&;
  each("chiaro_output_frames_total", "counter", "DMX frames sent",
       [](Out o) { return static_cast<double>(o.frames); });
  each("chiaro_output_late_frames_total", "counter", "frames sent after their deadline",
       [](Out o) { return static_cast<double>(o.late); });
  each("chiaro_output_failed_frames_total", "counter", "frames that could not be sent",
       [](Out o) { return static_cast<double>(o.failed); });
  text.family("chiaro_output_jitter_seconds", "summary", "deviation from the frame's deadline");
  for (const OutputView& output : state.outputs)
    for (const auto& [quantile, us] :
         {std::pair{"0.5", output.jitter_us_p50}, std::pair{"0.99", output.jitter_us_p99}})
      text.sample(fmt::format("chiaro_output_jitter_seconds{{universe=\"{}\",quantile=\"{}\"}}",
                              output.universe, quantile),
                  us * 1e-6);
}

void add_cameras(Text& text, const State& state) {
  text.family("chiaro_camera_frames_total", "counter", "camera pictures received");
  for (const CameraView& camera : state.cameras)
    text.sample(fmt::format("chiaro_camera_frames_total{{camera=\"{}\"}}", camera.name),
                static_cast<double>(camera.frames));
  text.family("chiaro_camera_reconnects_total", "counter", "times a camera came back");
  for (const CameraView& camera : state.cameras)
    text.sample(fmt::format("chiaro_camera_reconnects_total{{camera=\"{}\"}}", camera.name),
                static_cast<double>(camera.reconnects));
}

}  // namespace

std::string metrics_of(const State& state, const Counters& counters) {
  Text text;
  add_outputs(text, state);
  add_cameras(text, state);
  text.family("chiaro_designs_total", "counter", "design jobs by how they ended");
  text.sample("chiaro_designs_total{end=\"done\"}", static_cast<double>(counters.designs_done));
  text.sample("chiaro_designs_total{end=\"failed\"}", static_cast<double>(counters.designs_failed));
  text.sample("chiaro_designs_total{end=\"cancelled\"}",
              static_cast<double>(counters.designs_cancelled));
  text.one("chiaro_design_seconds_total", "counter", "time spent in finished design jobs",
           counters.design_seconds);
  text.one("chiaro_design_trials_total", "counter", "trials of finished design jobs",
           static_cast<double>(counters.trials));
  text.one("chiaro_http_requests_total", "counter", "requests answered",
           static_cast<double>(counters.requests));
  text.one("chiaro_event_listeners", "gauge", "open event streams",
           static_cast<double>(counters.event_listeners));
  text.one("chiaro_hand_connected", "gauge", "1 while the output process reports",
           state.hand_connected ? 1 : 0);
  text.one("chiaro_blackout", "gauge", "1 while blacked out", state.blackout ? 1 : 0);
  return text.text_;
}

}  // namespace chiaro::panel
