// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

#include "controller/daemon/doctor/doctor.h"

namespace chiaro::daemon::doctor {
namespace {

namespace fs = std::filesystem;

/// What we know by its ids. The strings of shared ids decide in the driver, not here.
struct Known {
  std::uint16_t vendor, product;
  const char* what;
  const char* output;  ///< how the studio file names it
};
constexpr Known kKnown[] = {
    {0x0403, 0x6001, "FTDI adapter (DMX USB Pro, Open DMX or a serial line)", "usbpro or opendmx"},
    {0x0403, 0x6010, "FTDI adapter with two lines", "usbpro or opendmx"},
    {0x0403, 0x6011, "FTDI adapter with four lines", "usbpro or opendmx"},
    {0x16c0, 0x05dc, "V-USB device (uDMX, if its strings say so)", "udmx"},
    {0x1a86, 0x7523, "CH340 serial adapter (good for Modbus, not for DMX)", "a bus"},
    {0x10c4, 0xea60, "CP210x serial adapter", "a bus"}};

/// Whether that person may read and write the file, by its mode.
bool may_use(const fs::path& file, const Person& person) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return false;
  const auto allows = [&](unsigned bits) { return (about.st_mode & bits) == bits; };
  const bool in_group =
      std::find(person.groups.begin(), person.groups.end(), about.st_gid) != person.groups.end();
  if (person.uid == 0) return true;
  if (person.uid == about.st_uid) return allows(S_IRUSR | S_IWUSR);
  return in_group ? allows(S_IRGRP | S_IWGRP) : allows(S_IROTH | S_IWOTH);
}

std::vector<std::string> names_in(const fs::path& folder, const std::string& prefix) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code))
    if (at->path().filename().string().rfind(prefix, 0) == 0)
      names.push_back(at->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string line_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

void examine_usb(const fs::path& root, const Person& person, const ports::DeviceFound& found,
                 std::vector<Finding>& findings) {
  const auto& id = found.identity;
  const auto known = std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& one) {
    return one.vendor == id.vendor && one.product == id.product;
  });
  if (known == std::end(kKnown)) return;
  std::string name = to_string(id);
  findings.push_back(
      {Finding::State::good, "device",
       std::string(known->what) + ": " + name + "; in the studio file: " + known->output, ""});
  if (!id.node.empty() && !may_use(root / id.node.substr(1), person))
    findings.push_back({Finding::State::bad, "device", "you may not use " + id.node,
                        "sudo usermod -aG dialout $USER   # then log in again"});
  if (id.node.empty() && known->product == 0x05dc)
    findings.push_back({Finding::State::note, "device", "a uDMX needs a rule that lets you use it",
                        "echo 'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"16c0\", "
                        "ATTR{idProduct}==\"05dc\", TAG+=\"uaccess\"' | sudo tee "
                        "/etc/udev/rules.d/70-chiaro.rules && sudo udevadm control --reload && "
                        "sudo udevadm trigger"});
}

/// Programs that are known to grab serial adapters that are not theirs.
void examine_grabbers(const fs::path& root, bool any_serial, std::vector<Finding>& findings) {
  if (!any_serial) return;
  for (const auto& pid : names_in(root / "proc", "")) {
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string name = line_of(root / "proc" / pid / "comm");
    const bool takes_all_ftdi = name == "olad";
    if (name == "ModemManager" || name == "brltty" || takes_all_ftdi)
      findings.push_back({Finding::State::note, "device",
                          name + " runs (process " + pid + ") and may take serial adapters" +
                              (takes_all_ftdi ? ", Modbus ones too" : ""),
                          "sudo systemctl stop " + std::string(name == "olad" ? "olad" : name)});
  }
}

void examine_nodes(const fs::path& root, const Person& person, const std::string& prefix,
                   const std::string& area, const std::string& what, const std::string& group,
                   std::vector<Finding>& findings) {
  for (const auto& name : names_in(root / "dev", prefix)) {
    const bool may = may_use(root / "dev" / name, person);
    findings.push_back({may ? Finding::State::good : Finding::State::bad, area,
                        may ? what + " /dev/" + name : "you may not use /dev/" + name,
                        may ? "" : "sudo usermod -aG " + group + " $USER   # then log in again"});
  }
}

}  // namespace

Person whoever_runs_this() {
  Person person{::geteuid(), {::getegid()}};
  const int count = ::getgroups(0, nullptr);
  if (count <= 0) return person;
  std::vector<gid_t> groups(static_cast<std::size_t>(count));
  if (::getgroups(count, groups.data()) == count)
    person.groups.insert(person.groups.end(), groups.begin(), groups.end());
  return person;
}

void examine_devices(const fs::path& root, const Person& person, ports::Devices& devices,
                     std::vector<Finding>& findings) {
  const auto usb = devices.usb();
  const std::size_t before = findings.size();
  bool any_serial = false;
  for (const auto& found : usb) {
    examine_usb(root, person, found, findings);
    any_serial = any_serial || !found.identity.node.empty();
  }
  if (findings.size() == before)
    findings.push_back(
        {Finding::State::good, "device", "no DMX or serial adapter is plugged in", ""});
  for (std::size_t i = 0; i < usb.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (usb[i].identity.vendor == 0x0403 && !usb[i].identity.serial.empty() &&
          usb[i].identity.serial == usb[j].identity.serial)
        findings.push_back({Finding::State::note, "device",
                            "two adapters have the same serial number '" + usb[i].identity.serial +
                                "': tell them apart by path \"" + usb[j].identity.usb_path +
                                "\" and \"" + usb[i].identity.usb_path + "\"",
                            ""});
  examine_grabbers(root, any_serial, findings);
  for (const auto& found : devices.hid()) {
    const bool may = may_use(root / found.identity.node.substr(1), person);
    findings.push_back(
        {may ? Finding::State::good : Finding::State::bad, "device",
         may ? "HID device " + to_string(found.identity) : "you may not use " + found.identity.node,
         may ? ""
             : "echo 'KERNEL==\"hidraw*\", TAG+=\"uaccess\"' | sudo tee "
               "/etc/udev/rules.d/71-chiaro-hid.rules && sudo udevadm control --reload && sudo "
               "udevadm trigger"});
  }
  examine_nodes(root, person, "video", "camera", "camera", "video", findings);
  examine_nodes(root, person, "gpiochip", "device", "GPIO chip", "gpio", findings);
}

}  // namespace chiaro::daemon::doctor
