// SPDX-License-Identifier: Apache-2.0
// The doctor in a machine made of files.
#include "controller/daemon/doctor/doctor.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "drivers/common/system_devices.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon::doctor {
namespace {

namespace fs = std::filesystem;

class Doctor : public testing::Test {
 protected:
  Doctor() {
    put("proc/self/limits",
        "Limit                     Soft Limit           Hard Limit           Units\n"
        "Max locked memory         unlimited            unlimited            bytes\n"
        "Max realtime priority     95                   95                   \n");
    put("proc/net/udp", "  sl  local_address rem_address   st\n");
    put("proc/net/tcp", "  sl  local_address rem_address   st\n");
  }
  void put(const std::string& file, const std::string& text, unsigned mode = 0644) {
    const auto path = folder_.path() / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
  }
  void plug_ftdi(const std::string& path, const std::string& serial, const std::string& tty) {
    const std::string device = "sys/bus/usb/devices/" + path;
    put(device + "/idVendor", "0403\n");
    put(device + "/idProduct", "6001\n");
    put(device + "/serial", serial + "\n");
    fs::create_directories(folder_.path() / device / (path + ":1.0") / tty);
    put("dev/" + tty, "", 0660);
  }
  std::vector<Finding> look(const studio::Studio* studio = nullptr) {
    drivers::SystemDevices devices(folder_.path());
    return examine(folder_.path(), person_, devices, studio);
  }
  static const Finding* find(const std::vector<Finding>& all, const std::string& words) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Finding& one) {
      return one.what.find(words) != std::string::npos;
    });
    return found == all.end() ? nullptr : &*found;
  }
  support::TemporaryFolder folder_;
  Person person_{1000, {1000}};
};

TEST_F(Doctor, FindsNothingWrongWithAMachineThatIsInOrder) {
  const auto all = look();
  for (const auto& finding : all) EXPECT_EQ(finding.state, Finding::State::good) << finding.what;
  EXPECT_NE(to_text(all).find("Nothing stands in the way"), std::string::npos);
}

TEST_F(Doctor, NamesAnAdapterAndTheCommandThatLetsYouUseIt) {
  plug_ftdi("1-1.4", "EN123", "ttyUSB0");
  auto all = look();
  const auto* found = find(all, "serial EN123");
  ASSERT_NE(found, nullptr);
  EXPECT_NE(found->what.find("at USB 1-1.4"), std::string::npos);
  const auto* wrong = find(all, "may not use /dev/ttyUSB0");
  ASSERT_NE(wrong, nullptr);
  EXPECT_EQ(wrong->state, Finding::State::bad);
  EXPECT_NE(wrong->command.find("usermod -aG dialout"), std::string::npos);
  person_.groups.push_back(0);  // the group of the files of this test
  all = look();
  EXPECT_EQ(find(all, "may not use"), nullptr);
}

TEST_F(Doctor, ListsTheSurfacesOfAStudioAndWhatOfThemIsMissing) {
  studio::Studio studio;
  studio::Surface wall;
  wall.name = "wall";
  wall.driver = "gpio";
  wall.map.maker = "Generic";
  wall.map.device = "box";
  wall.map.controls.resize(2);
  wall.map.controls[0].chip = wall.map.controls[1].chip = "gpiochip0";
  wall.map.controls[0].deeds.resize(1);
  studio::Surface pedal;
  pedal.name = "pedal";
  pedal.driver = "hid";
  pedal.device.vendor = 0x0fd9;
  pedal.map.controls.resize(1);
  studio.surfaces = {wall, pedal};
  auto all = look(&studio);
  const auto* missing = find(all, "'wall': there is no GPIO chip gpiochip0");
  ASSERT_NE(missing, nullptr) << to_text(all);
  EXPECT_EQ(missing->area, "surface");
  EXPECT_NE(missing->command.find("gpiodetect"), std::string::npos);
  ASSERT_NE(find(all, "'pedal': "), nullptr);
  EXPECT_EQ(find(all, "'pedal': ")->state, Finding::State::bad);
  EXPECT_NE(find(all, "'pedal' has no control that does anything"), nullptr);
  put("dev/gpiochip0", "", 0666);
  all = look(&studio);
  EXPECT_NE(find(all, "'wall': Generic box, 2 controls, on gpiochip0"), nullptr) << to_text(all);
}

TEST_F(Doctor, TellsTwoAdaptersWithOneSerialNumberApart) {
  plug_ftdi("1-1", "A", "ttyUSB0");
  plug_ftdi("1-2", "A", "ttyUSB1");
  EXPECT_NE(find(look(), "path \"1-1\" and \"1-2\""), nullptr);
}

TEST_F(Doctor, MissesRealTimeRights) {
  put("proc/self/limits",
      "Max locked memory         65536                65536                bytes\n"
      "Max realtime priority     0                    0                    \n");
  const auto all = look();
  ASSERT_NE(find(all, "may not ask for a real-time turn"), nullptr);
  EXPECT_NE(find(all, "may not ask")->command.find("limits.d"), std::string::npos);
  EXPECT_NE(find(all, "64 KiB of memory"), nullptr);
}

TEST_F(Doctor, NamesTheProgramThatHoldsAPort) {
  put("proc/net/udp",
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
      "inode\n"
      "  10: 00000000:1936 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 "
      "4711 2\n");
  put("proc/net/tcp",
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
      "inode\n"
      "   0: 0100007F:1F9A 00000000:0000 0A 00000000:00000000 00:00000000 00000000     0        0 "
      "4712 1\n");
  put("proc/312/comm", "olad\n");
  put("proc/313/comm", "httpd\n");
  for (const auto& [pid, inode] : {std::pair{"312", "4711"}, std::pair{"313", "4712"}}) {
    const auto folder = folder_.path() / "proc" / pid / "fd";
    fs::create_directories(folder);
    fs::create_symlink(std::string("socket:[") + inode + "]", folder / "7");
  }
  const auto all = look();
  const auto* artnet = find(all, "6454");
  ASSERT_NE(artnet, nullptr);
  EXPECT_NE(artnet->what.find("olad (process 312)"), std::string::npos);
  EXPECT_EQ(artnet->command, "sudo systemctl stop olad");
  const auto* panel = find(all, "8090");
  ASSERT_NE(panel, nullptr);
  EXPECT_EQ(panel->state, Finding::State::bad);
  EXPECT_NE(panel->what.find("httpd"), std::string::npos);
}

TEST_F(Doctor, WarnsOfProgramsThatGrabAdapters) {
  put("proc/99/comm", "ModemManager\n");
  EXPECT_EQ(find(look(), "ModemManager"), nullptr) << "nobody minds without an adapter";
  plug_ftdi("1-1", "A", "ttyUSB0");
  const auto all = look();
  ASSERT_NE(find(all, "ModemManager"), nullptr);
  EXPECT_EQ(find(all, "ModemManager")->command, "sudo systemctl stop ModemManager");
}

TEST_F(Doctor, LooksForWhatAStudioNames) {
  plug_ftdi("1-1", "DMX1", "ttyUSB0");
  put("sys/class/net/eth0/operstate", "down\n");
  studio::Studio studio;
  studio::SacnOutput sacn;
  sacn.interface = "eth0";
  studio.outputs.push_back({1, sacn, {}});
  sacn.interface = "eth9";
  studio.outputs.push_back({2, sacn, {}});
  studio::UsbProOutput pro;
  pro.device.serial = "DMX1";
  studio.outputs.push_back({3, pro, {}});
  pro.device.serial = "DMX2";
  studio.outputs.push_back({4, pro, {}});
  const auto all = look(&studio);
  EXPECT_EQ(find(all, "eth0 is down")->state, Finding::State::bad);
  EXPECT_NE(find(all, "no network interface 'eth9'"), nullptr);
  EXPECT_EQ(find(all, "serial DMX1 at USB 1-1 is plugged in")->state, Finding::State::good);
  EXPECT_NE(find(all, "serial DMX2 is not plugged in"), nullptr);
}

TEST_F(Doctor, PrintsOneJsonObject) {
  put("proc/self/limits", "Max realtime priority     0  0\n");
  const auto json = nlohmann::json::parse(to_json(look()));
  EXPECT_FALSE(json["ok"].get<bool>());
  EXPECT_FALSE(json["findings"].empty());
  for (const auto& finding : json["findings"])
    EXPECT_EQ(finding["state"] == "bad", !finding["command"].get<std::string>().empty());
}

}  // namespace
}  // namespace chiaro::daemon::doctor
