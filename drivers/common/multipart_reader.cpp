// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/multipart_reader.h"

#include <algorithm>
#include <utility>

#include "drivers/common/http_client.h"

namespace chiaro::drivers {
namespace {

constexpr std::size_t kMostHead = 16384;

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string boundary_in(std::string_view content_type) {
  constexpr std::string_view kKey = "boundary=";
  const auto at = lower(content_type).find(kKey);
  if (at == std::string::npos) return "";
  std::string_view word = content_type.substr(at + kKey.size());
  if (!word.empty() && word.front() == '"') {
    word.remove_prefix(1);
    word = word.substr(0, word.find('"'));
  } else {
    word = word.substr(0, word.find_first_of("; \t"));
  }
  // Some cameras count the dashes that introduce a boundary as part of its name.
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  return std::string(word);
}

}  // namespace

bool MultipartReader::is_stream(std::string_view content_type) {
  return lower(content_type).rfind("multipart/", 0) == 0 && !boundary_in(content_type).empty();
}

MultipartReader::MultipartReader(std::string_view content_type)
    : mark_("--" + boundary_in(content_type)) {}

bool MultipartReader::take(std::string_view bytes, ports::TimePoint now) {
  now_ = now;
  held_.append(bytes);
  while (step()) {
  }
  const std::size_t most = in_part_ ? kMostPart : kMostHead;
  return held_.size() <= most || (in_part_ && length_ && *length_ <= kMostPart);
}

/// The head of the next part, behind whatever stands before its boundary.
bool MultipartReader::find_head() {
  const auto mark = held_.find(mark_);
  if (mark == std::string::npos) {  // keep what may be the beginning of a boundary
    if (held_.size() > mark_.size()) held_.erase(0, held_.size() - mark_.size());
    return false;
  }
  const auto end = held_.find("\r\n\r\n", mark);
  if (end == std::string::npos) {
    held_.erase(0, mark);
    return false;
  }
  length_ = http_content_length(std::string_view(held_).substr(mark, end - mark));
  held_.erase(0, end + 4);
  in_part_ = true;
  searched_ = 0;
  begun_ = now_;
  return true;
}

bool MultipartReader::step() {
  if (!in_part_) return find_head();
  if (length_) {
    if (*length_ > kMostPart || held_.size() < *length_) return false;
    keep(*length_, *length_);
    return true;
  }
  const std::size_t from = searched_ > mark_.size() ? searched_ - mark_.size() : 0;
  const auto end = held_.find(mark_, from);
  searched_ = held_.size();
  if (end == std::string::npos) return false;
  std::size_t length = end;
  // Dashes that the boundary's name was stripped of, then the line end before a boundary: not ours.
  const bool dashes = length >= 3 && held_.compare(length - 3, 3, "\n--") == 0;
  if (dashes) length -= 2;
  if (length > 0 && held_[length - 1] == '\n') --length;
  if (length > 0 && held_[length - 1] == '\r') --length;
  keep(length, end);
  return true;
}

void MultipartReader::keep(std::size_t length, std::size_t used) {
  if (!std::exchange(stale_, false)) newest_ = Part{held_.substr(0, length), begun_};
  held_.erase(0, used);
  in_part_ = false;
  ++parts_;
}

std::optional<MultipartReader::Part> MultipartReader::newest() {
  return std::exchange(newest_, std::nullopt);
}

void MultipartReader::skip() {
  newest_.reset();
  stale_ = in_part_;
}

}  // namespace chiaro::drivers
