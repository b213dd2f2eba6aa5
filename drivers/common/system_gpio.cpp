// SPDX-License-Identifier: Apache-2.0
// GPIO lines by libgpiod: version 1 (Debian 12) and version 2 share no function, so each has its
// half here and nobody else knows.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_GPIO
#include <gpiod.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_GPIO
namespace {

constexpr const char* kConsumer = "chiaro";

#if CHIARO_WITH_GPIO == 1
class Line final : public ports::GpioLine {
 public:
  ~Line() override {
    if (chip_ != nullptr) gpiod_chip_close(chip_);  // releases the line too
  }
  bool open(const ports::GpioSettings& settings) {
    chip_ = gpiod_chip_open_lookup(settings.chip.c_str());
    if (chip_ == nullptr) return false;
    line_ = gpiod_chip_get_line(chip_, settings.line);
    if (line_ == nullptr) return false;
    int flags = 0;
    if (settings.active_low) flags |= GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW;
    if (settings.pull_up) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    return (settings.output ? gpiod_line_request_output_flags(line_, kConsumer, flags, 0)
                            : gpiod_line_request_input_flags(line_, kConsumer, flags)) == 0;
  }
  std::optional<bool> get() override {
    const int value = gpiod_line_get_value(line_);
    return value < 0 ? std::nullopt : std::optional<bool>(value != 0);
  }
  bool set(bool on) override { return gpiod_line_set_value(line_, on ? 1 : 0) == 0; }

 private:
  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;
};
#else
class Line final : public ports::GpioLine {
 public:
  ~Line() override {
    if (request_ != nullptr) gpiod_line_request_release(request_);
  }
  bool open(const ports::GpioSettings& settings) {
    offset_ = settings.line;
    const std::string path =
        settings.chip.rfind("/dev/", 0) == 0 ? settings.chip : "/dev/" + settings.chip;
    gpiod_chip* chip = gpiod_chip_open(path.c_str());
    gpiod_line_settings* line = gpiod_line_settings_new();
    gpiod_line_config* lines = gpiod_line_config_new();
    gpiod_request_config* request = gpiod_request_config_new();
    if (chip != nullptr && line != nullptr && lines != nullptr && request != nullptr) {
      gpiod_line_settings_set_direction(
          line, settings.output ? GPIOD_LINE_DIRECTION_OUTPUT : GPIOD_LINE_DIRECTION_INPUT);
      gpiod_line_settings_set_active_low(line, settings.active_low);
      if (settings.pull_up) gpiod_line_settings_set_bias(line, GPIOD_LINE_BIAS_PULL_UP);
      gpiod_request_config_set_consumer(request, kConsumer);
      if (gpiod_line_config_add_line_settings(lines, &offset_, 1, line) == 0)
        request_ = gpiod_chip_request_lines(chip, request, lines);
    }
    gpiod_request_config_free(request);
    gpiod_line_config_free(lines);
    gpiod_line_settings_free(line);
    if (chip != nullptr) gpiod_chip_close(chip);
    return request_ != nullptr;
  }
  std::optional<bool> get() override {
    const auto value = gpiod_line_request_get_value(request_, offset_);
    return value == GPIOD_LINE_VALUE_ERROR ? std::nullopt
                                           : std::optional<bool>(value == GPIOD_LINE_VALUE_ACTIVE);
  }
  bool set(bool on) override {
    return gpiod_line_request_set_value(
               request_, offset_, on ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE) == 0;
  }

 private:
  gpiod_line_request* request_ = nullptr;
  unsigned offset_ = 0;
};
#endif

}  // namespace

core::Result<std::unique_ptr<ports::GpioLine>> SystemDevices::open_gpio(
    const ports::GpioSettings& settings) {
  auto line = std::make_unique<Line>();
  if (!line->open(settings))
    return core::Problem{
        {},
        "cannot use line " + std::to_string(settings.line) + " of " + settings.chip,
        "`gpioinfo` shows the lines and who holds them"};
  return std::unique_ptr<ports::GpioLine>(std::move(line));
}
#else
core::Result<std::unique_ptr<ports::GpioLine>> SystemDevices::open_gpio(
    const ports::GpioSettings& settings) {
  return built_without("libgpiod", settings.chip, "libgpiod-dev");
}
#endif
}  // namespace chiaro::drivers
