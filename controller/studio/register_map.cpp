// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/register_map.h"

#include <algorithm>

#include "controller/core/hash.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio {

using namespace reading;

namespace {

/// One line of the map, which may stand for many like channels.
void read_channels(const Tree& tree, RegisterMap& map, Report& report) {
  Section section(tree, "a channel", report);
  RegisterChannel channel;
  std::int64_t repeat = 1, step = 1, bits = 8;
  const Tree* at = section.need("register", "0");
  into(channel.address, whole(at, 0, 65535, report));
  into(channel.name, text(section.find("name"), report));
  into(repeat, whole(section.find("repeat"), 1, 512, report));
  into(step, whole(section.find("step"), 1, 65535, report));
  into(bits, choice<int>(section.find("bits"), {{"8", 8}, {"16", 16}}, report));
  into(channel.words, whole(section.find("words"), 1, 2, report));
  into(channel.low_word_first,
       choice<bool>(section.find("order"), {{"high_first", false}, {"low_first", true}}, report));
  into(channel.dali,
       choice<bool>(section.find("law"), {{"linear", false}, {"dali", true}}, report));
  const core::Range most{0, channel.words == 2 ? 4294967295.0 : 65535.0};
  // Backwards (most to least) is allowed: sinking outputs count so.
  if (const Tree* means = section.find("means"))
    if (const auto pair = numbers(means, 2, most, "[value at 0, value at full]", report)) {
      channel.from = (*pair)[0];
      channel.to = (*pair)[1];
    }
  section.refuse_unknown();
  channel.slots = static_cast<int>(bits / 8);
  for (std::int64_t i = 0; i < repeat; ++i) {
    RegisterChannel one = channel;
    if (repeat > 1) one.name += (one.name.empty() ? "" : " ") + std::to_string(i + 1);
    one.address += static_cast<int>(i * step * channel.words);
    one.slot = map.slots;
    map.slots += one.slots;
    map.channels.push_back(std::move(one));
  }
  if (at != nullptr && !map.channels.empty() && map.channels.back().address > 65535)
    report.error(*at,
                 "the last of them would be register " +
                     std::to_string(map.channels.back().address) + ", there are 65535",
                 "use a lower register or fewer of them");
}

/// {register: 20, write: 1}: a command to the motor. -1 when absent.
void read_order(const Tree* tree, int& address, int& value, Report& report) {
  if (tree == nullptr) return;
  Section section(*tree, "an order to a motor", report);
  into(address, whole(section.need("register", "20"), 0, 65535, report));
  into(value, whole(section.find("write"), 0, 65535, report));
  section.refuse_unknown();
}

void read_status(const Tree* tree, RegisterAxis& axis, Report& report) {
  if (tree == nullptr) return;
  Section section(*tree, "a motor's flags", report);
  into(axis.status, whole(section.need("register", "12"), 0, 65535, report));
  into(axis.status_is_input, yes_or_no(section.find("input"), report));
  into(axis.moving_bit, whole(section.find("moving"), 0, 15, report));
  into(axis.homed_bit, whole(section.find("homed"), 0, 15, report));
  into(axis.fault_bit, whole(section.find("fault"), 0, 15, report));
  section.refuse_unknown();
}

void read_target(const Tree* tree, RegisterAxis& axis, Report& report) {
  if (tree == nullptr) return;
  Section section(*tree, "where a motor is sent", report);
  into(axis.target, whole(section.need("register", "0"), 0, 65535, report));
  into(axis.words, whole(section.find("words"), 1, 2, report));
  into(axis.low_word_first,
       choice<bool>(section.find("order"), {{"high_first", false}, {"low_first", true}}, report));
  const core::Range most =
      axis.words == 2 ? core::Range{-2147483648.0, 4294967295.0} : core::Range{-32768, 65535};
  if (const auto ends = numbers(section.need("means", "[0, 16000]"), 2, most,
                                "[value at one end, value at the other]", report)) {
    axis.from = (*ends)[0];
    axis.to = (*ends)[1];
    if (axis.from == axis.to)
      report.error(*tree, "both ends of the axis are the same value", "means: [0, 16000]");
  }
  section.refuse_unknown();
}

/// A motor: two slots of the device's universe, a position from end to end.
void read_axis(const Tree& tree, RegisterMap& map, Report& report) {
  Section section(tree, "an axis", report);
  RegisterAxis axis;
  into(axis.name, text(section.find("name"), report));
  read_target(section.need("target", "{register: 0, means: [0, 16000]}"), axis, report);
  if (const Tree* actual = section.find("actual")) {
    Section where(*actual, "where a motor is", report);
    into(axis.actual, whole(where.need("register", "10"), 0, 65535, report));
    into(axis.actual_is_input, yes_or_no(where.find("input"), report));
    where.refuse_unknown();
  }
  read_status(section.find("status"), axis, report);
  read_order(section.find("home"), axis.home, axis.home_value, report);
  read_order(section.find("stop"), axis.stop, axis.stop_value, report);
  section.refuse_unknown();
  axis.slot = map.slots;
  map.slots += 2;
  map.axes.push_back(std::move(axis));
}

void read_axes(const Tree* axes, RegisterMap& map, Report& report) {
  if (axes == nullptr) return;
  if (axes->kind != Tree::Kind::sequence)
    return report.error(*axes, "'axes' needs a list", "- {target: {register: 0, means: [0, 100]}}");
  for (const Tree& one : axes->items) read_axis(one, map, report);
  for (const RegisterAxis& a : map.axes)
    for (const RegisterChannel& c : map.channels)
      if (a.target < c.address + c.words && c.address < a.target + a.words)
        report.error(*axes, "register " + std::to_string(a.target) + " is used twice",
                     "each axis and channel needs registers of its own");
  if (map.slots > 512)
    report.error(*axes, "the device would need " + std::to_string(map.slots) + " slots",
                 "a universe has 512");
}

void check_overlaps(RegisterMap& map, const Tree& tree, Report& report) {
  auto& channels = map.channels;
  std::stable_sort(channels.begin(), channels.end(),
                   [](auto& a, auto& b) { return a.address < b.address; });
  for (std::size_t i = 1; i < channels.size(); ++i)
    if (channels[i].address < channels[i - 1].address + channels[i - 1].words)
      report.error(tree, "register " + std::to_string(channels[i].address) + " is used twice",
                   "each channel needs registers of its own");
  if (map.slots > 512)
    report.error(tree, "the device would need " + std::to_string(map.slots) + " slots",
                 "a universe has 512: map fewer channels");
}

RegisterMap read_map(const Tree& tree, const std::string& name, Report& report) {
  Section section(tree, "a register map", report);
  RegisterMap map;
  map.name = name;
  const Tree* own_name = section.need("map", name);
  if (const auto stated = text(own_name, report); stated && *stated != name)
    report.error(*own_name,
                 "this map calls itself " + in_quotes(*stated) + ", its file is " + in_quotes(name),
                 "a map's name is its path below the modbus folder");
  into(map.maker, text(section.need("maker", "Generic"), report));
  into(map.device, text(section.need("device", "what stands on its case"), report));
  (void)text(section.find("source"), report);
  into(map.timeout_s, quantity(section.find("timeout"), Measure::duration, {0.01, 5}, report));
  into(map.gap_s, quantity(section.find("gap"), Measure::duration, {0, 5}, report));
  into(map.single_writes,
       choice<bool>(section.find("write"), {{"many", false}, {"single", true}}, report));
  const Tree* axes = section.find("axes");
  const Tree* channels = axes != nullptr
                             ? section.find("channels")
                             : section.need("channels", "[{register: 0, means: [0, 10000]}]");
  if (channels != nullptr && channels->kind != Tree::Kind::sequence)
    report.error(*channels, "'channels' needs a list", "- {register: 0, means: [0, 10000]}");
  else if (channels != nullptr)
    for (const Tree& one : channels->items) read_channels(one, map, report);
  if (channels != nullptr) check_overlaps(map, *channels, report);
  read_axes(axes, map, report);
  section.refuse_unknown();
  return map;
}

/// Names come from users and become paths: nothing may lead out of the folder.
bool is_map_name(const std::string& name) {
  return !name.empty() && name.size() < 200 && name.front() != '/' &&
         name.find("..") == std::string::npos &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_/+.") == std::string::npos;
}

}  // namespace

core::Result<RegisterMap> parse_register_map(const std::string& yaml, const std::string& name,
                                             const std::string& file) {
  const auto document = parse_tree(yaml, file);
  if (!document) return document.problems();
  Report report(file);
  report.add(document->problems);
  RegisterMap map = read_map(document->root, name, report);
  if (report.any_error()) return report.sorted();
  map.fingerprint = core::Fingerprint().add(yaml).value();
  return map;
}

std::vector<std::string> register_map_names(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  std::error_code code;
  for (fs::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->path().extension() == ".yaml")
      names.push_back(
          fs::relative(entry->path(), folder, code).replace_extension().generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

core::Result<RegisterMap> load_register_map(const std::string& name,
                                            const std::filesystem::path& own,
                                            const std::filesystem::path& shipped) {
  std::error_code code;
  for (const auto& folder : {own, shipped}) {
    const auto file = folder / (name + ".yaml");
    if (!is_map_name(name) || !std::filesystem::is_regular_file(file, code)) continue;
    const auto yaml = read_text(file);
    if (!yaml) return yaml.problems();
    return parse_register_map(*yaml, name, file.string());
  }
  return core::Problem{{},
                       "there is no register map " + in_quotes(name),
                       suggestion(name, register_map_names(shipped))};
}

}  // namespace chiaro::studio
