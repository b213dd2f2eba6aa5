// SPDX-License-Identifier: Apache-2.0
// Single lines: a blackout or stop button on the wall, a tally lamp, a relay. An input counts when
// it has stayed the same for its debounce time. Wire a stop as a contact that opens (active_low:
// no, pull_up: yes): a broken wire then stops too.
#include <map>

#include "drivers/registry.h"

namespace chiaro::drivers::gpio {
namespace {

class GpioSurface final : public ports::Surface {
 public:
  GpioSurface(const SurfaceSettings& settings, Surroundings& around)
      : settings_(settings), around_(around) {}

  core::Result<core::Done> open() override {
    lines_.clear();
    std::vector<Line> lines;
    for (const SurfaceControl& control : settings_.controls) {
      auto opened = around_.devices.open_gpio(control.gpio);
      if (!opened) return opened.problems();
      lines.push_back({&control, std::move(*opened), false, false, {}});
    }
    lines_ = std::move(lines);
    health_ = ports::PortHealth::good;
    for (const auto& [name, value] : shown_) put(name, value);  // as before it was lost
    return core::Done{};
  }

  std::vector<ports::SurfaceEvent> listen(ports::TimePoint now) override {
    std::vector<ports::SurfaceEvent> events;
    for (Line& line : lines_) {
      if (line.control->gpio.output) continue;
      const auto level = line.line->get();
      if (!level) {
        lose();
        break;
      }
      if (*level != line.raw) {
        line.raw = *level;
        line.since = now;
      }
      if (line.raw == line.settled || now - line.since < line.control->debounce) continue;
      line.settled = line.raw;
      events.push_back({line.control->name, line.settled ? 1.0 : 0.0});
    }
    return events;
  }

  void show(const std::string& control, double value, const std::string&) override {
    shown_[control] = value;
    put(control, value);
  }
  ports::PortHealth health() const override { return health_; }

 private:
  struct Line {
    const SurfaceControl* control;
    std::unique_ptr<ports::GpioLine> line;
    bool raw, settled;
    ports::TimePoint since;
  };
  void put(const std::string& name, double value) {
    for (Line& line : lines_)
      if (line.control->name == name && line.control->gpio.output && !line.line->set(value > 0)) {
        lose();
        return;
      }
  }
  void lose() {
    lines_.clear();
    health_ = ports::PortHealth::lost;
  }

  const SurfaceSettings settings_;
  Surroundings& around_;
  std::vector<Line> lines_;
  std::map<std::string, double> shown_;
  ports::PortHealth health_ = ports::PortHealth::closed;
};

}  // namespace

std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&);
std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings& settings,
                                             Surroundings& around) {
  return std::make_unique<GpioSurface>(settings, around);
}

}  // namespace chiaro::drivers::gpio
