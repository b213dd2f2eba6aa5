// SPDX-License-Identifier: Apache-2.0
// outputs: universe N: {sacn: {…}}, {artnet: {…}}, a dongle or mock - where each universe leaves
// the machine.
#include <algorithm>
#include <set>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

/// DMX512-A: 44 frames of 512 slots a second; E1.31 asks for no more either.
constexpr core::Range kRate{1, 44};

std::optional<std::uint16_t> universe_number(const Tree::Key& key, Report& report) {
  constexpr std::string_view kPrefix = "universe ";
  std::optional<double> number;
  if (key.text.rfind(kPrefix, 0) == 0) number = parse_number(key.text.substr(kPrefix.size()));
  if (number && *number >= 1 && *number <= 63999 &&
      *number == static_cast<double>(static_cast<int>(*number)))
    return static_cast<std::uint16_t>(*number);
  report.error(
      key, in_quotes(key.text) + " is no output, expected 'universe' and its number, 1 to 63999",
      "for example universe 1: {sacn: {interface: eth0}}");
  return std::nullopt;
}

bool is_ipv4(const std::string& address) {
  int parts = 0;
  std::size_t begin = 0;
  while (begin <= address.size() && parts < 5) {
    const std::size_t end = std::min(address.find('.', begin), address.size());
    const std::string part = address.substr(begin, end - begin);
    const bool digits_only = !part.empty() && part.size() <= 3 &&
                             part.find_first_not_of("0123456789") == std::string::npos;
    if (!digits_only || std::stoi(part) > 255) return false;
    ++parts;
    begin = end + 1;
  }
  return parts == 4;
}

/// A network address of the outputs' own key, checked.
std::string read_unicast(Section& section, Report& report) {
  std::string address;
  const Tree* tree = section.find("unicast");
  into(address, text(tree, report));
  if (!address.empty() && !is_ipv4(address))
    report.error(*tree, in_quotes(address) + " is no IPv4 address", "for example 192.168.0.20");
  return address;
}

std::optional<std::uint16_t> hexadecimal(const std::string& word) {
  if (word.size() != 4 || word.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
    return std::nullopt;
  return static_cast<std::uint16_t>(std::stoul(word, nullptr, 16));
}

}  // namespace

DeviceName read_device(Section& section, Report& report) {
  DeviceName device;
  const Tree* node = section.find("device");
  const Tree* usb = section.find("usb");
  const Tree* serial = section.find("serial");
  const Tree* path = section.find("path");
  into(device.node, text(node, report));
  into(device.serial, text(serial, report));
  into(device.usb_path, text(path, report));
  if (!device.node.empty() && device.node.rfind("/dev/", 0) != 0)
    report.error(*node, in_quotes(device.node) + " is not a device", "for example /dev/ttyUSB0");
  if (const auto ids = text(usb, report)) {
    const auto vendor = hexadecimal(ids->substr(0, ids->find(':')));
    const auto product = ids->size() == 9 ? hexadecimal(ids->substr(5)) : std::nullopt;
    if (ids->size() == 9 && (*ids)[4] == ':' && vendor && product) {
      device.vendor = *vendor;
      device.product = *product;
    } else {
      report.error(*usb, in_quotes(*ids) + " are no USB ids",
                   "for example \"0403:6001\"; `lsusb` shows them");
    }
  }
  if (node == nullptr && serial == nullptr && path == nullptr && usb == nullptr)
    report.error(
        section.tree(), "which device is not said",
        "add serial: \"EN123456\", path: \"1-1.4\" or device: /dev/ttyUSB0; `chiaro doctor` "
        "lists what is plugged in");
  return device;
}

namespace {

ArtNetOutput read_artnet(const Tree& tree, Report& report) {
  Section section(tree, "an Art-Net output", report);
  ArtNetOutput artnet;
  into(artnet.interface, text(section.need("interface", "eth0"), report));
  into(artnet.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(artnet.port_address, whole(section.find("port_address"), 0, 32767, report));
  artnet.unicast = read_unicast(section, report);
  into(artnet.broadcast, yes_or_no(section.find("broadcast"), report));
  into(artnet.sync, yes_or_no(section.find("sync"), report));
  into(artnet.quiet, yes_or_no(section.find("quiet"), report));
  if (artnet.broadcast && !artnet.unicast.empty())
    report.error(section.tree(), "both unicast and broadcast are asked for", "keep one of them");
  section.refuse_unknown();
  return artnet;
}

/// What a shorter break than this does: some receivers miss it (E1.11 asks 92 us of a sender).
constexpr std::int64_t kLeastBreak = 92, kLeastMark = 12;

UsbProOutput read_usbpro(const Tree& tree, Report& report) {
  Section section(tree, "a DMX USB Pro", report);
  UsbProOutput pro;
  pro.device = read_device(section, report);
  into(pro.rate_hz, quantity(section.find("rate"), Measure::frequency, {1, 40}, report));
  into(pro.port, whole(section.find("port"), 1, 2, report));
  into(pro.break_us, whole(section.find("break_us"), kLeastBreak, 1355, report));
  into(pro.mab_us, whole(section.find("mab_us"), kLeastMark, 1355, report));
  section.refuse_unknown();
  return pro;
}

OpenDmxOutput read_opendmx(const Tree& tree, Report& report) {
  Section section(tree, "an Open DMX adapter", report);
  OpenDmxOutput open;
  open.device = read_device(section, report);
  into(open.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(open.slots, whole(section.find("slots"), 24, 512, report));
  into(open.break_us, whole(section.find("break_us"), kLeastBreak, 100000, report));
  into(open.mab_us, whole(section.find("mab_us"), kLeastMark, 100000, report));
  section.refuse_unknown();
  return open;
}

UdmxOutput read_udmx(const Tree& tree, Report& report) {
  Section section(tree, "a uDMX adapter", report);
  UdmxOutput udmx;
  into(udmx.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(udmx.slots, whole(section.find("slots"), 1, 512, report));
  into(udmx.device.serial, text(section.find("serial"), report));
  into(udmx.device.usb_path, text(section.find("path"), report));
  section.refuse_unknown();
  return udmx;
}

OlaOutput read_ola(const Tree& tree, Report& report) {
  Section section(tree, "an OLA universe", report);
  OlaOutput ola;
  into(ola.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(ola.universe, whole(section.find("universe"), 1, 65535, report));
  section.refuse_unknown();
  return ola;
}

MockOutput read_mock(const Tree& tree, Report& report) {
  MockOutput mock;
  Section section(tree, "a mock output", report);
  into(mock.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  section.refuse_unknown();
  return mock;
}

SacnOutput read_sacn(const Tree& tree, Report& report) {
  Section section(tree, "an sACN output", report);
  SacnOutput sacn;
  into(sacn.interface, text(section.need("interface", "eth0"), report));
  into(sacn.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(sacn.priority, whole(section.find("priority"), 0, 200, report));
  sacn.unicast = read_unicast(section, report);
  into(sacn.sync, whole(section.find("sync"), 1, 63999, report));
  into(sacn.quiet, yes_or_no(section.find("quiet"), report));
  section.refuse_unknown();
  return sacn;
}

/// The word alone: enough for a mock, a single uDMX and a local olad.
OutputDriver bare_driver(std::size_t index, const Tree& tree, Report& report) {
  switch (index) {
    case 0:
      report.error(tree, "sACN needs its network interface", "{sacn: {interface: eth0}}");
      return MockOutput{};
    case 2:
      report.error(tree, "Art-Net needs its network interface", "{artnet: {interface: eth0}}");
      return MockOutput{};
    case 3:
    case 4:
      report.error(tree, "which device is not said",
                   "add serial: \"EN123456\", path: \"1-1.4\" or device: /dev/ttyUSB0");
      return MockOutput{};
    case 5:
      return UdmxOutput{};
    case 6:
      return OlaOutput{};
    case 7:
      report.error(tree, "which Modbus device is not said",
                   "{modbus: {bus: rack, unit: 1, map: waveshare/analog-output-8ch}}");
      return MockOutput{};
    default:
      return MockOutput{};
  }
}

OutputDriver read_driver(const Tree& tree, const Studio& studio, Context& context) {
  Report& report = context.report;
  const auto kind = variant(
      &tree, "an output driver",
      {"sacn", "mock", "artnet", "usbpro", "opendmx", "udmx", "ola", "modbus"}, context.report);
  if (!kind) return MockOutput{};
  if (kind->body == nullptr) return bare_driver(kind->index, tree, report);
  switch (kind->index) {
    case 0:
      return read_sacn(*kind->body, report);
    case 2:
      return read_artnet(*kind->body, report);
    case 3:
      return read_usbpro(*kind->body, report);
    case 4:
      return read_opendmx(*kind->body, report);
    case 5:
      return read_udmx(*kind->body, report);
    case 6:
      return read_ola(*kind->body, report);
    case 7:
      return read_modbus_output(*kind->body, studio, context);
    default:
      return read_mock(*kind->body, report);
  }
}

}  // namespace

void read_outputs(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("outputs");
  if (tree == nullptr) return;
  Section section(*tree, "outputs", context.report);
  std::set<std::uint16_t> seen;
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    const auto universe = universe_number(tree->keys[i], context.report);
    OutputDriver driver = read_driver(tree->items[i], studio, context);
    if (!universe) continue;
    if (!seen.insert(*universe).second)
      context.report.error(tree->keys[i],
                           "universe " + std::to_string(*universe) + " has two outputs",
                           "keep one of them");
    studio.outputs.push_back({*universe, std::move(driver), context.report.place(tree->keys[i])});
  }
}

}  // namespace chiaro::studio::sections
