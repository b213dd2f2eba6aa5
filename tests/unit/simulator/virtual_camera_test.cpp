// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "simulator/virtual_studio/camera.h"
#include "simulator/virtual_studio/noise.h"
#include "simulator/virtual_studio/stage.h"
#include "tests/support/meshes.h"

namespace chiaro::simulator {
namespace {

using core::Dof;

class VirtualCameraTest : public testing::Test {
 protected:
  void SetUp() override {
    studio_ = support::ball_studio(folder_.path(), 3);
    studio_.cameras.front().size = {96, 72};
    auto geometry = twin::build_geometry(studio_, {});
    ASSERT_TRUE(geometry) << core::to_string(geometry.problems());
    geometry_ = *geometry;
    tracer_ = std::make_shared<render::Tracer>(geometry_);
  }
  VirtualStage stage(const Departures& departures) const {
    VirtualStage result(studio_, geometry_->aim, departures, 1);
    result.ask(at_levels({0.8, 0.4, 0.6}));
    result.advance(10);
    return result;
  }
  studio::Rig at_levels(const std::vector<double>& levels) const {
    auto rig = studio::placed_rig(studio_);
    for (std::size_t i = 0; i < levels.size(); ++i) rig.states[i].set(Dof::intensity, levels[i]);
    return rig;
  }
  VirtualCamera camera(const CameraOptions& options = {}) const {
    return VirtualCamera(studio_, studio_.main_camera(), tracer_, options);
  }
  core::Picture predicted(const studio::Rig& rig) const {
    const auto view = render::see(tracer_, studio_.main_camera(), studio_.main_camera().size);
    return render::picture(view, twin::lit_by(studio_, geometry_, rig));
  }

  support::Folder folder_;
  studio::Studio studio_;
  std::shared_ptr<const twin::Geometry> geometry_;
  std::shared_ptr<const render::Tracer> tracer_;
};

double worst(const core::Picture& a, const core::Picture& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.red.values.size(); ++i)
    most = std::max({most, std::abs(static_cast<double>(a.red.values[i]) - b.red.values[i]),
                     std::abs(static_cast<double>(a.green.values[i]) - b.green.values[i]),
                     std::abs(static_cast<double>(a.blue.values[i]) - b.blue.values[i])});
  return most;
}

double mean(const core::Picture& picture) {
  double sum = 0;
  for (const float y : core::luminance(picture).values) sum += y;
  return sum / static_cast<double>(picture.size().pixels());
}

TEST_F(VirtualCameraTest, WithoutDeparturesSeesWhatTheTwinPredicts) {
  auto perfect = camera();
  const auto seen = perfect.picture(stage(Departures::none()).lit());
  EXPECT_GT(mean(seen), 0.01);
  EXPECT_LT(worst(seen, predicted(at_levels({0.8, 0.4, 0.6}))), 1e-5);
}

TEST_F(VirtualCameraTest, TheSensorAddsNoMoreThanItsNoise) {
  auto perfect = camera();
  const auto truth = perfect.picture(stage(Departures::none()).lit());
  const Sensor sensor;
  const auto seen = core::linear(exposed(truth, sensor, 1, 1));
  std::size_t far = 0;
  for (std::size_t i = 0; i < truth.red.values.size(); ++i) {
    const double light = std::min(1.0f, truth.red.values[i]);
    const double step = 0.01 * light + 0.0006;  // of eight bits of sRGB
    far += std::abs(seen.red.values[i] - light) > 4 * noise_at(sensor, light) + step;
  }
  EXPECT_LT(far, truth.red.values.size() / 500);
}

TEST_F(VirtualCameraTest, DeparturesChangeThePictureALittle) {
  auto real = camera();
  const auto seen = real.picture(stage(Departures{}).lit());
  const auto promised = predicted(at_levels({0.8, 0.4, 0.6}));
  EXPECT_GT(worst(seen, promised), 1e-3);
  EXPECT_NEAR(mean(seen), mean(promised), 0.1 * mean(promised));
}

TEST_F(VirtualCameraTest, DrawsALayerAgainOnlyWhenItsStandHasMoved) {
  auto lamps = stage(Departures::none());
  auto eye = camera();
  eye.picture(lamps.lit());
  EXPECT_EQ(eye.layers_drawn(), 3u);
  lamps.ask(at_levels({0.1, 0.9, 0.2}));
  lamps.advance(10);
  eye.picture(lamps.lit());
  EXPECT_EQ(eye.layers_drawn(), 3u);
  core::FixtureState place;
  place.set(Dof::azimuth, core::radians(20));
  lamps.put(0, place);
  const auto moved = eye.picture(lamps.lit());
  EXPECT_EQ(eye.layers_drawn(), 4u);
  auto rig = at_levels({0.1, 0.9, 0.2});
  rig.states[0].overlay(place);
  EXPECT_LT(worst(moved, predicted(rig)), 1e-5);
}

TEST_F(VirtualCameraTest, ADarkLampCostsNothing) {
  VirtualStage lamps(studio_, geometry_->aim, Departures::none(), 1);
  lamps.ask(at_levels({0, 0, 0}));
  lamps.advance(10);
  auto eye = camera();
  EXPECT_EQ(mean(eye.picture(lamps.lit())), 0);
  EXPECT_EQ(eye.layers_drawn(), 0u);
}

TEST_F(VirtualCameraTest, ThePathTracerAddsBouncedLightToTheSameLayers) {
  CameraOptions options;
  options.renderer = Renderer::path;
  options.samples = 16;
  options.threads = 1;
  auto path = camera(options), fast = camera();
  const auto lamps = stage(Departures::none()).lit();
  const double bounced = mean(path.picture(lamps)), direct = mean(fast.picture(lamps));
  EXPECT_GT(bounced, direct);
  EXPECT_LT(bounced, 1.6 * direct);
  options.renderer = Renderer::bounced;
  auto quick = camera(options);
  EXPECT_NEAR(mean(quick.picture(lamps)), bounced, 0.3 * (bounced - direct));
}

TEST(Turned, MovesTheAxisAndKeepsTheFrameSquare) {
  const twin::Light straight;
  const auto light = turned(straight, core::radians(2), core::radians(-1));
  EXPECT_NEAR(core::angle_between(light.direction, straight.direction),
              std::atan(std::hypot(std::tan(core::radians(2)), std::tan(core::radians(1)))), 1e-9);
  EXPECT_NEAR(core::dot(light.direction, light.right), 0, 1e-12);
  EXPECT_NEAR(core::dot(light.direction, light.up), 0, 1e-12);
  EXPECT_NEAR(core::dot(light.right, light.up), 0, 1e-12);
  EXPECT_NEAR(core::length(light.up), 1, 1e-12);
}

}  // namespace
}  // namespace chiaro::simulator
