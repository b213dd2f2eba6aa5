// SPDX-License-Identifier: Apache-2.0
// XML from strangers: bounded, without entities of its own, errors with their line.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "controller/core/result.h"

namespace chiaro::importers {

/// No library file is larger.
inline constexpr std::size_t kMostXmlBytes = 16u << 20;

/// The parsed document, or why not. A document that declares entities is refused unread: expanding
/// them is how a small file becomes a large one.
core::Result<core::Done> read_xml(const std::string& text, const std::string& file,
                                  pugi::xml_document& document);

/// The attribute as a finite number within bounds, else `otherwise`.
double number_in(pugi::xml_attribute attribute, double least, double most, double otherwise);
double number_in(std::string_view words, double least, double most, double otherwise);
/// The same for a whole number.
int whole_in(std::string_view words, int least, int most, int otherwise);
/// All in lower case, ASCII alone.
std::string lower(std::string_view words);

}  // namespace chiaro::importers
