// SPDX-License-Identifier: Apache-2.0
// outputs: universe N: {sacn: {…}} or mock - where each universe leaves the machine.
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

SacnOutput read_sacn(const Tree& tree, Report& report) {
  Section section(tree, "an sACN output", report);
  SacnOutput sacn;
  into(sacn.interface, text(section.need("interface", "eth0"), report));
  into(sacn.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  into(sacn.priority, whole(section.find("priority"), 0, 200, report));
  const Tree* unicast = section.find("unicast");
  into(sacn.unicast, text(unicast, report));
  if (!sacn.unicast.empty() && !is_ipv4(sacn.unicast))
    report.error(*unicast, in_quotes(sacn.unicast) + " is no IPv4 address",
                 "for example 192.168.0.20");
  section.refuse_unknown();
  return sacn;
}

OutputDriver read_driver(const Tree& tree, Report& report) {
  const auto kind = variant(&tree, "an output driver", {"sacn", "mock"}, report);
  if (!kind) return MockOutput{};
  if (kind->index == 0) {
    if (kind->body != nullptr) return read_sacn(*kind->body, report);
    report.error(tree, "sACN needs its network interface", "{sacn: {interface: eth0}}");
    return MockOutput{};
  }
  MockOutput mock;
  if (kind->body == nullptr) return mock;
  Section section(*kind->body, "a mock output", report);
  into(mock.rate_hz, quantity(section.find("rate"), Measure::frequency, kRate, report));
  section.refuse_unknown();
  return mock;
}

}  // namespace

void read_outputs(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("outputs");
  if (tree == nullptr) return;
  Section section(*tree, "outputs", context.report);
  std::set<std::uint16_t> seen;
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    const auto universe = universe_number(tree->keys[i], context.report);
    OutputDriver driver = read_driver(tree->items[i], context.report);
    if (!universe) continue;
    if (!seen.insert(*universe).second)
      context.report.error(tree->keys[i],
                           "universe " + std::to_string(*universe) + " has two outputs",
                           "keep one of them");
    studio.outputs.push_back({*universe, std::move(driver), context.report.place(tree->keys[i])});
  }
}

}  // namespace chiaro::studio::sections
