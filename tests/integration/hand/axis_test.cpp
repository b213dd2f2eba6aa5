// SPDX-License-Identifier: Apache-2.0
// A motor on a Modbus line through the real program: nothing moves it but a person's leave, and its
// stop goes past the levels.
#include <nlohmann/json.hpp>

#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using Write = support::FakeModbus::Write;

/// config/modbus/generic/positioner.yaml: 0-1 target, 10-11 actual, 20 home, 21 stop.
class AMotorOnABus : public RunningHand {
 protected:
  AMotorOnABus() {
    std::string text = support::studio_text(
        "  key: {role: key, profile: generic/dimmer, mode: 1ch, mount: {track: {from: [-2, 1, 3], "
        "to: [2, 1, 3], at: 50 %, axis: {universe: 9, address: 1}}}, limits: {end_to_end: 2 s}, "
        "patch: {universe: 1, address: 1}}\n",
        "buses:\n  rail: {device: \"tcp://10.0.0.5:502\"}\n");
    const std::string outputs = "outputs:\n";
    text.replace(
        text.find(outputs), outputs.size(),
        outputs + "  universe 9: {modbus: {bus: rail, unit: 3, map: generic/positioner}}\n");
    write_studio(text);
  }
  void begin() {
    start();
    far_ = world_->devices.plug_modbus("10.0.0.5");
    far_->units[3].holding[10] = 0;
    far_->units[3].holding[11] = 50000;  // it stands in the middle
    ASSERT_TRUE(until([&] { return axis().value("heard", false) && axis()["place"] == 0.5; }));
  }
  /// Time goes on, and the bus's thread with it, until it is so; false after a long while.
  template <class Condition>
  bool until(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < end) {
      if (condition()) return true;
      run(50ms);
      follow();
      std::this_thread::yield();
    }
    return false;
  }
  /// The drive runs to where it is told.
  void follow() {
    const std::scoped_lock lock(far_->mutex);
    for (const Write& write : far_->writes)
      if (write.address == 0) {
        far_->units[3].holding[10] = write.values[0];
        far_->units[3].holding[11] = write.values[1];
      }
  }
  int said(std::uint16_t address) {
    const std::scoped_lock lock(far_->mutex);
    return static_cast<int>(std::count_if(far_->writes.begin(), far_->writes.end(),
                                          [&](const Write& w) { return w.address == address; }));
  }
  Json ask(const std::string& line) {
    const auto answer = meanwhile([&] { return hand_request(runtime(), line, 60s); });
    return answer ? Json::parse(*answer) : Json{{"refused", core::to_string(answer.problems())}};
  }
  Json axis() {
    const Json status = ask("status");
    return status.contains("axes") && !status["axes"].empty() ? status["axes"][0] : Json::object();
  }
  void want(double place) {
    if (!brain_) brain_ = brain();
    rig::Wanted wanted;
    auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
    look.fixtures.resize(1);
    look.fixtures[0].set(core::Dof::intensity, 0.5);
    look.fixtures[0].set(core::Dof::track, place);
    look.fade_id = ++fades_;
    brain_->post(wanted, clock_->now());
  }
  std::shared_ptr<support::FakeModbus> far_;
  std::unique_ptr<HandLink> brain_;
  std::uint64_t fades_ = 0;
};

TEST_F(AMotorOnABus, MovesOnlyWhileArmedAndStopsByItsOwnOrder) {
  begin();
  EXPECT_EQ(axis()["fixture"], "key");
  want(0.9);
  run(3s);
  EXPECT_EQ(said(0), 0) << "not armed";
  EXPECT_EQ(ask("motion arm")["armed"], true);
  want(0.9);
  ASSERT_TRUE(until([&] { return said(0) > 2; }));
  ASSERT_TRUE(until([&] {
    want(0.9);
    return axis()["place"].get<double>() > 0.899;
  }));
  EXPECT_EQ(said(21), 0);
  EXPECT_EQ(ask("motion stop")["stopped"], true);
  ASSERT_TRUE(until([&] { return said(21) == 1; }));
  const int before = said(0);
  want(0.1);
  run(2s);
  EXPECT_EQ(ask("motion release")["stopped"], false);
  run(2s);
  EXPECT_EQ(said(0), before) << "releasing a stop moves nothing";
}

TEST_F(AMotorOnABus, IsHomedOnlyByAPersonAndOnlyArmed) {
  begin();
  EXPECT_NE(ask("motion home key").dump().find("not armed"), std::string::npos);
  EXPECT_NE(ask("motion home kay").dump().find("did you mean 'key'"), std::string::npos);
  EXPECT_EQ(ask("motion arm")["armed"], true);
  EXPECT_EQ(ask("motion home key")["home"], "key");
  ASSERT_TRUE(until([&] { return said(20) == 1; }));
  run(2s);
  EXPECT_EQ(said(20), 1);
  EXPECT_EQ(said(0), 0) << "it is not sent anywhere afterwards";
}

}  // namespace
}  // namespace chiaro::daemon
