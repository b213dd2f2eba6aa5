// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/xml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace chiaro::importers {
namespace {

core::Problem bad(const std::string& file, int line, std::string what, std::string remedy) {
  return {{file, line, line > 0 ? 1 : 0}, std::move(what), std::move(remedy), false};
}

std::string_view trimmed(std::string_view words) {
  while (!words.empty() && std::isspace(static_cast<unsigned char>(words.front())) != 0)
    words.remove_prefix(1);
  while (!words.empty() && std::isspace(static_cast<unsigned char>(words.back())) != 0)
    words.remove_suffix(1);
  return words;
}

}  // namespace

core::Result<core::Done> read_xml(const std::string& text, const std::string& file,
                                  pugi::xml_document& document) {
  if (text.size() > kMostXmlBytes)
    return bad(file, 0,
               fmt::format("this XML is {} MB large, expected 16 MB at most", text.size() >> 20u),
               "is it the right file?");
  if (text.find("<!ENTITY") != std::string::npos)
    return bad(file, 0, "this XML declares entities, which no fixture or show file needs",
               "ask its author for a plain one");
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (parsed) return core::Done{};
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(
                                      parsed.offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  const int line = 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
  return bad(file, line, fmt::format("this is not whole XML: {}", lower(parsed.description())),
             "was the file cut short? fetch it again");
}

double number_in(std::string_view words, double least, double most, double otherwise) {
  words = trimmed(words);
  double value = 0;
  const auto [end, code] = std::from_chars(words.data(), words.data() + words.size(), value);
  if (code != std::errc{} || !std::isfinite(value) || value < least || value > most)
    return otherwise;
  return value;
}

double number_in(pugi::xml_attribute attribute, double least, double most, double otherwise) {
  return number_in(attribute.as_string(), least, most, otherwise);
}

int whole_in(std::string_view words, int least, int most, int otherwise) {
  const double value = number_in(words, least, most, std::nan(""));
  return std::isnan(value) || value != std::floor(value) ? otherwise : static_cast<int>(value);
}

std::string lower(std::string_view words) {
  std::string out(words);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

}  // namespace chiaro::importers
