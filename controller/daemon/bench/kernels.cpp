// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/kernels.h"

#include <cmath>

#include "controller/core/random.h"
#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/measure/gram.h"
#include "controller/measure/measure.h"
#include "controller/optimise/least_squares.h"
#include "controller/render/view.h"

namespace chiaro::daemon::bench {
namespace {

core::Plane soft_picture(core::Size size, std::uint64_t seed) {
  core::Random random(seed);
  const double x0 = random.uniform(), y0 = random.uniform();
  core::Plane out(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double dx = double(x) / size.width - x0, dy = double(y) / size.height - y0;
      out.at(x, y) =
          static_cast<float>(std::exp(-3 * (dx * dx + dy * dy)) + 0.01 * random.uniform());
    }
  return out;
}

}  // namespace

double read_bandwidth(const ports::Clock& clock, std::size_t bytes, bool quick) {
  const std::vector<float> block(bytes / sizeof(float), 1.0f);
  volatile float sink = 0;
  const int calls = static_cast<int>(std::max<std::size_t>(1, (quick ? 1 : 4) * 8'000'000 / bytes));
  const double us =
      best_us(clock, 9, calls, [&] { sink = measure::kernels::sum(block.data(), block.size()); });
  (void)sink;
  return us > 0 ? static_cast<double>(bytes) / (us * 1e-6) : 0;
}

void kernels(const Plan& plan, ports::World& world, Report& report) {
  const int calls = plan.quick ? 5 : 50;
  const auto us = [&](auto body) { return best_us(world.clock, 9, calls, body); };
  const std::string size =
      std::to_string(plan.size.width) + " x " + std::to_string(plan.size.height);
  report.heading("Picture kernels, " + size + ", one core");
  const double bytes = 4.0 * static_cast<double>(plan.size.pixels());
  const double cached =
      read_bandwidth(world.clock, 8 * static_cast<std::size_t>(bytes), plan.quick);
  const double memory = read_bandwidth(world.clock, 128u << 20, plan.quick);
  report.add("reading 8 planes of that size", cached * 1e-9, "GB/s", {}, "the roof below");
  report.add("reading 128 MB", memory * 1e-9, "GB/s");
  const auto roofed = [&](const char* name, double time, double planes) {
    const double roof = cached > 0 ? planes * bytes / cached * 1e6 : 0;
    char note[64];
    std::snprintf(note, sizeof note, "roof %.1f us, %.0f %% of it reached", roof,
                  time > 0 ? 100 * roof / time : 0);
    report.add(name, time, "us", {}, note);
  };

  std::vector<core::Plane> layers;
  std::vector<const core::Plane*> columns;
  for (std::uint64_t k = 0; k < 8; ++k) layers.push_back(soft_picture(plan.size, k + 1));
  for (const core::Plane& layer : layers) columns.push_back(&layer);
  const std::vector<double> mixed(8, 0.1);
  core::Plane ambient(plan.size), picture(plan.size);
  roofed("relit picture of 8 layers", us([&] { render::relit(columns, mixed, ambient, picture); }),
         10);
  core::Plane values(plan.size);
  roofed("L* (cube root)", us([&] {
           measure::kernels::working_scalar(picture.values.data(), values.values.data(),
                                            picture.values.size());
         }),
         2);
  const auto flat = measure::flat_pixel_map(plan.size);
  volatile double sink = 0;
  roofed("L*, mean, spread, gradient, histogram fused",
         us([&] { sink = measure::components_of_luminance(picture, flat).mean; }), 1.25);
  roofed("Haar pyramid", us([&] { sink = measure::haar_spectrum(values).mean; }), 1.67);
  report.add("Gram form of 8 layers, wavelet",
             us([&] { sink = measure::haar_form(columns, ambient, picture).constant; }), "us");
  const auto form = measure::haar_form(columns, ambient, picture);
  const std::vector<core::Range> bounds(8, {0, 1});
  report.add("bounded least squares, 8 levels", us([&] {
               sink = optimise::bounded_least_squares(form.q_matrix, form.q_vector, bounds)[0];
             }),
             "us");
  (void)sink;
}

}  // namespace chiaro::daemon::bench
