// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "controller/daemon/doctor/doctor.h"

namespace chiaro::daemon::doctor {
namespace {

namespace fs = std::filesystem;

/// The soft limit called `name` in proc/self/limits: a number, or -1 for "unlimited".
std::optional<long> limit(const fs::path& root, const std::string& name) {
  std::ifstream in(root / "proc/self/limits");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(name, 0) != 0) continue;
    std::istringstream rest(line.substr(name.size()));
    std::string soft;
    rest >> soft;
    return soft == "unlimited" ? -1 : std::strtol(soft.c_str(), nullptr, 10);
  }
  return std::nullopt;
}

struct Held {
  std::string inode;
  bool any_address = false;
};

/// Who holds local UDP or TCP ports, by port, from proc/net.
std::map<unsigned, std::string> holders(const fs::path& root, const std::string& table) {
  std::map<unsigned, std::string> inodes;
  std::ifstream in(root / "proc/net" / table);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string number, local, remote, state, skip, inode;
    words >> number >> local >> remote >> state;
    for (int i = 0; i < 5; ++i) words >> skip;
    words >> inode;
    constexpr const char* kListens = "0A";
    if (table == "tcp" && state != kListens) continue;
    const auto colon = local.find(':');
    if (colon != std::string::npos)
      inodes[static_cast<unsigned>(std::strtoul(local.c_str() + colon + 1, nullptr, 16))] = inode;
  }
  return inodes;
}

/// "olad (process 312)", or "another program" where its files cannot be seen.
std::string owner_of(const fs::path& root, const std::string& inode) {
  std::error_code code;
  for (fs::directory_iterator at(root / "proc", code), end; !code && at != end;
       at.increment(code)) {
    const std::string pid = at->path().filename().string();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code hidden;
    for (fs::directory_iterator file(at->path() / "fd", hidden), last; !hidden && file != last;
         file.increment(hidden)) {
      std::error_code gone;
      if (fs::read_symlink(file->path(), gone).string() != "socket:[" + inode + "]") continue;
      std::ifstream comm(at->path() / "comm");
      std::string name;
      std::getline(comm, name);
      return name + " (process " + pid + ")";
    }
  }
  return "another program";
}

struct Port {
  const char* table;
  unsigned number;
  const char* what;
  bool shared;  ///< several may hold it
};
constexpr Port kPorts[] = {{"udp", 5568, "sACN", true},
                           {"udp", 6454, "Art-Net", true},
                           {"tcp", 8090, "the control panel", false},
                           {"udp", 9000, "OSC surfaces", false}};

bool ours(const std::string& owner) { return owner.rfind("chiaro", 0) == 0; }

}  // namespace

void examine_real_time(const fs::path& root, std::vector<Finding>& findings) {
  const auto priority = limit(root, "Max realtime priority");
  const auto locked = limit(root, "Max locked memory");
  constexpr long kEnoughLocked = 64L << 20;
  if (priority && (*priority == -1 || *priority >= 20))
    findings.push_back(
        {Finding::State::good, "real time", "the output may ask for a real-time turn", ""});
  else
    findings.push_back(
        {Finding::State::bad, "real time",
         "the output may not ask for a real-time turn: frames come late when the "
         "machine is busy",
         "echo \"$USER - rtprio 60\" | sudo tee /etc/security/limits.d/90-chiaro.conf   "
         "# then log in again; the installed service needs nothing"});
  if (locked && *locked != -1 && *locked < kEnoughLocked)
    findings.push_back({Finding::State::note, "real time",
                        "only " + std::to_string(*locked / 1024) + " KiB of memory may be locked",
                        "echo \"$USER - memlock unlimited\" | sudo tee -a "
                        "/etc/security/limits.d/90-chiaro.conf   # then log in again"});
  std::ifstream governor(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string name;
  if (governor >> name && name == "powersave")
    findings.push_back({Finding::State::note, "real time",
                        "the processor saves power: frames may be a few ms late after a pause",
                        "sudo cpupower frequency-set -g performance"});
}

void examine_network(const fs::path& root, std::vector<Finding>& findings) {
  for (const Port& port : kPorts) {
    const auto held = holders(root, port.table);
    const auto found = held.find(port.number);
    const std::string name =
        std::string(port.table) + " port " + std::to_string(port.number) + " (" + port.what + ")";
    if (found == held.end()) {
      findings.push_back({Finding::State::good, "network", name + " is free", ""});
      continue;
    }
    const std::string owner = owner_of(root, found->second);
    if (ours(owner))
      findings.push_back({Finding::State::good, "network", name + " is " + owner, ""});
    else
      findings.push_back(
          {port.shared ? Finding::State::note : Finding::State::bad, "network",
           name + " is held by " + owner +
               (port.shared ? ": it may keep Chiaro from hearing on this machine" : ""),
           owner.rfind("olad", 0) == 0 ? "sudo systemctl stop olad"
                                       : "sudo ss -lnp sport = :" + std::to_string(port.number)});
  }
}

}  // namespace chiaro::daemon::doctor
