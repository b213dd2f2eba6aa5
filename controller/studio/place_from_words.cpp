// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <optional>

#include "controller/studio/reading/quantity.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/words.h"

namespace chiaro::studio {
namespace {

constexpr const char* kExample = "say it like this: 47 left, 38 up, 1.6 m";

/// Runs of digits, and runs of letters in lower case; everything else only divides.
std::vector<std::string> tokens(const std::string& words) {
  std::vector<std::string> all;
  int kind = 0, last = 0;  // 1 number, 2 letters
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    kind = std::isdigit(byte) || c == '.' || c == '-' || c == '+' ? 1 : std::isalpha(byte) ? 2 : 0;
    if (kind != 0) {
      if (kind != last) all.emplace_back();
      all.back() += static_cast<char>(std::tolower(byte));
    }
    last = kind;
  }
  return all;
}

/// A place while it is heard, word by word.
struct Heard {
  std::optional<double> azimuth, elevation, distance;  // degrees, metres
  std::optional<double> number;
  std::string complaint;

  bool take(std::optional<double>& into, double sign) {
    if (!number) return false;
    into = sign * *number;
    number.reset();
    return true;
  }
  void hear(const std::string& word) {
    if (const auto value = reading::parse_number(word)) {
      if (number) complaint = "what is " + reading::digits(*number) + "?";
      number = value;
    } else if (word == "left" || word == "right") {
      if (!take(azimuth, word == "left" ? -1 : 1)) complaint = "how many degrees " + word + "?";
    } else if (word == "up" || word == "down") {
      if (!take(elevation, word == "down" ? -1 : 1)) complaint = "how many degrees " + word + "?";
    } else if (word == "level") {
      elevation = 0;
    } else if (word == "front" || word == "behind") {
      if (!azimuth) azimuth = word == "front" ? 0 : 180;
    } else if (const double metres = in_metres(word); metres > 0) {
      if (!take(distance, metres)) complaint = "how many " + word + "?";
    } else if (word != "camera" && word != "deg" && word != "degrees" && word != "straight" &&
               word != "in" && word != "of" && word != "away" && word != "and") {
      complaint = "what does " + reading::in_quotes(word) + " mean?";
    }
  }
  static double in_metres(const std::string& word) {
    if (word == "m" || word == "metre" || word == "metres" || word == "meters") return 1;
    if (word == "cm") return 0.01;
    return word == "ft" || word == "feet" ? 0.3048 : 0;
  }
};

core::Problem unclear(const std::string& why) { return {{}, why, kExample, false}; }

}  // namespace

core::Result<core::Spherical> place_from_words(const std::string& words) {
  Heard heard;
  for (const std::string& token : tokens(words)) {
    heard.hear(token);
    if (!heard.complaint.empty()) return unclear(heard.complaint);
  }
  if (heard.number) return unclear("what is " + reading::digits(*heard.number) + "?");
  if (!heard.azimuth) return unclear("how far left or right of the camera is it?");
  if (!heard.elevation) return unclear("how far up or down is it?");
  if (!heard.distance) return unclear("how many metres from the sitter is it?");
  if (*heard.azimuth < -180 || *heard.azimuth > 180)
    return unclear("left and right go to 180 degrees");
  if (*heard.elevation < -90 || *heard.elevation > 90)
    return unclear("up and down go to 90 degrees");
  if (!(*heard.distance > 0) || *heard.distance > 100)
    return unclear("the distance must be between 0 and 100 m");
  return core::Spherical{core::radians(*heard.azimuth), core::radians(*heard.elevation),
                         *heard.distance};
}

}  // namespace chiaro::studio
