// SPDX-License-Identifier: Apache-2.0
// Every way in which a universe may leave the machine, as the studio file says it.
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "controller/studio/load.h"

namespace chiaro::studio {
namespace {

const std::filesystem::path kConfig = CHIARO_SOURCE "/config";

/// The shipped studio with another output for its universe 1, and a bus.
core::Result<Loaded> with(const std::string& driver) {
  std::ifstream in(kConfig / "studios/portrait.yaml");
  std::stringstream text;
  text << in.rdbuf();
  std::string yaml = text.str();
  const auto begin = yaml.find("universe 1:");
  const auto end = yaml.find('\n', begin);
  yaml.replace(begin, end - begin, "universe 1: " + driver);
  yaml += "\nbuses: {rack: {device: \"tcp://10.0.0.5:502\"}, line: {serial: A1, parity: even}}\n";
  return parse_studio(yaml, kConfig / "studios", Folders{kConfig});
}

template <class Kind>
Kind read(const std::string& driver) {
  const auto loaded = with(driver);
  EXPECT_TRUE(loaded) << core::to_string(loaded.problems());
  if (!loaded) return {};
  EXPECT_TRUE(std::holds_alternative<Kind>(loaded->studio.outputs.at(0).driver));
  return std::get<Kind>(loaded->studio.outputs.at(0).driver);
}

TEST(Outputs, ReadArtNet) {
  const auto artnet = read<ArtNetOutput>("{artnet: {interface: lo, port_address: 17, sync: yes}}");
  EXPECT_EQ(artnet.interface, "lo");
  EXPECT_EQ(artnet.port_address, 17);
  EXPECT_TRUE(artnet.sync);
  EXPECT_FALSE(with("artnet"));
  EXPECT_FALSE(with("{artnet: {interface: lo, port_address: 40000}}"));
  EXPECT_FALSE(with("{artnet: {interface: lo, broadcast: yes, unicast: 10.0.0.1}}"));
}

TEST(Outputs, ReadSynchronisedAndQuietSacn) {
  const auto sacn = read<SacnOutput>("{sacn: {interface: lo, sync: 7000, quiet: yes}}");
  EXPECT_EQ(sacn.sync, 7000);
  EXPECT_TRUE(sacn.quiet);
}

TEST(Outputs, ReadDonglesThatAreNamedAndRefuseThoseThatAreNot) {
  const auto pro = read<UsbProOutput>("{usbpro: {serial: EN123456, break_us: 300}}");
  EXPECT_EQ(pro.device.serial, "EN123456");
  EXPECT_EQ(pro.break_us, 300);
  const auto open = read<OpenDmxOutput>("{opendmx: {usb: \"0403:6001\", path: \"1-1.4\"}}");
  EXPECT_EQ(open.device.vendor, 0x0403);
  EXPECT_EQ(open.device.product, 0x6001);
  EXPECT_EQ(open.device.usb_path, "1-1.4");
  EXPECT_EQ(read<UdmxOutput>("udmx").slots, 512);
  EXPECT_FALSE(with("usbpro"));
  EXPECT_FALSE(with("{opendmx: {rate: 30 Hz}}"));
  EXPECT_FALSE(with("{opendmx: {usb: \"403:6001\"}}"));
  EXPECT_FALSE(with("{usbpro: {serial: A, break_us: 50}}"));
}

TEST(Outputs, ReadAModbusDeviceWithItsMap) {
  const auto modbus =
      read<ModbusOutput>("{modbus: {bus: rack, unit: 3, map: waveshare/analog-output-8ch}}");
  EXPECT_EQ(modbus.unit, 3);
  EXPECT_EQ(modbus.map.channels.size(), 8u);
  EXPECT_FALSE(with("{modbus: {bus: rick, unit: 3, map: waveshare/analog-output-8ch}}"));
  EXPECT_FALSE(with("{modbus: {bus: rack, unit: 3, map: waveshare/nothing}}"));
  EXPECT_FALSE(with("{modbus: {bus: rack, unit: 300, map: waveshare/analog-output-8ch}}"));
}

TEST(Outputs, AreSaidInWords) {
  EXPECT_EQ(output_in_words(read<OlaOutput>("{ola: {universe: 3}}")), "OLA universe 3 at 40 Hz");
  EXPECT_EQ(output_in_words(read<ArtNetOutput>("{artnet: {interface: lo}}")),
            "Art-Net on lo at 40 Hz, to the nodes that ask");
}

}  // namespace
}  // namespace chiaro::studio
