// SPDX-License-Identifier: Apache-2.0
// What must survive a restart: looks with their pictures, the user's own moods, settings (which
// look is live, where stands are, what is locked) and a journal. One SQLite file in WAL mode: a
// kill at any moment loses nothing that `save` has answered.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::store {

using Bytes = std::string;

/// A look as the brain keeps it. `json` is look.json; pictures are PNG, empty when there is none.
struct LookRecord {
  std::int64_t id = 0;  ///< given by the store
  std::string name, mood, verdict;
  std::string created;  ///< ISO 8601, UTC, second; given by the store
  bool kept = false;    ///< named by a person: never pruned
  std::string request;  ///< JSON: how it was asked for, so that it can be solved again
  std::string json;
  Bytes picture, placed_picture, reference;
};

struct MoodRecord {
  std::string name, title;
  Bytes picture;
};

struct JournalEntry {
  std::string time, what;
};

/// Thread-bound: the loop.
class Store {
 public:
  /// Makes folder and file where missing. Problems: no permission, a file that is no store or is
  /// damaged (with what to do), a store made by a newer version.
  static core::Result<std::unique_ptr<Store>> open(const std::filesystem::path& file);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  core::Result<std::int64_t> save_look(const LookRecord& look);
  /// Replaces json, verdict and the placed picture of a look that was solved again.
  core::Result<core::Done> update_look(const LookRecord& look);
  core::Result<core::Done> update_pictures(std::int64_t id, const Bytes& picture,
                                           const Bytes& placed_picture);
  core::Result<core::Done> keep_look(std::int64_t id, const std::string& name);
  std::optional<LookRecord> look(std::int64_t id) const;
  /// Newest first, without JSON and pictures.
  std::vector<LookRecord> looks() const;
  bool remove_look(std::int64_t id);
  /// Removes all but the newest `most` of the looks that nobody named; `live` stays.
  void prune_looks(std::size_t most, std::int64_t live);

  core::Result<core::Done> save_mood(const MoodRecord& mood);
  std::optional<MoodRecord> mood(const std::string& name) const;
  std::vector<MoodRecord> moods() const;  ///< in name order, without pictures
  bool remove_mood(const std::string& name);

  core::Result<core::Done> set(const std::string& key, const std::string& value);
  std::optional<std::string> get(const std::string& key) const;

  void note(const std::string& what);
  std::vector<JournalEntry> journal(std::size_t most) const;  ///< newest first

 private:
  struct Database;
  explicit Store(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace chiaro::store
