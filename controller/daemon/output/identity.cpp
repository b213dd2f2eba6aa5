// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/identity.h"

#include <fstream>
#include <optional>
#include <random>

#include "controller/daemon/output/whole_file.h"

namespace chiaro::daemon {
namespace {

constexpr bool dash_before(std::size_t byte) {
  return byte == 4 || byte == 6 || byte == 8 || byte == 10;
}

std::optional<unsigned> digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
  return std::nullopt;
}

std::optional<Cid> cid_in(const std::string& text) {
  Cid cid{};
  std::size_t at = 0;
  for (std::size_t i = 0; i < cid.size(); ++i) {
    if (dash_before(i) && (at >= text.size() || text[at++] != '-')) return std::nullopt;
    if (at + 2 > text.size()) return std::nullopt;
    const auto high = digit(text[at]), low = digit(text[at + 1]);
    if (!high || !low) return std::nullopt;
    cid[i] = static_cast<std::uint8_t>(*high << 4u | *low);
    at += 2;
  }
  if (at != text.size()) return std::nullopt;
  return cid;
}

Cid new_cid() {
  std::random_device device;
  Cid cid{};
  for (auto& byte : cid) byte = static_cast<std::uint8_t>(device() & 0xffu);
  cid[6] = static_cast<std::uint8_t>((cid[6] & 0x0fu) | 0x40u);  // RFC 4122: version 4,
  cid[8] = static_cast<std::uint8_t>((cid[8] & 0x3fu) | 0x80u);  // variant 1
  return cid;
}

}  // namespace

std::string to_text(const Cid& cid) {
  std::string text;
  for (std::size_t i = 0; i < cid.size(); ++i) {
    if (dash_before(i)) text += '-';
    text += "0123456789abcdef"[cid[i] >> 4u];
    text += "0123456789abcdef"[cid[i] & 15u];
  }
  return text;
}

Cid kept_cid(const std::filesystem::path& state_folder, core::Problems& warnings) {
  const auto file = state_folder / "cid";
  std::ifstream in(file);
  std::string text;
  in >> text;
  if (const auto kept = cid_in(text)) return *kept;
  const Cid cid = new_cid();
  if (const auto written = write_whole(file, to_text(cid) + "\n"); !written)
    for (core::Problem problem : written.problems()) {
      problem.warning = true;
      problem.what += ", so receivers will see a new sACN source at every start";
      warnings.push_back(problem);
    }
  return cid;
}

}  // namespace chiaro::daemon
