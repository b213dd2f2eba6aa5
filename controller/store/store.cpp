// SPDX-License-Identifier: Apache-2.0
#include "controller/store/store.h"

#include "controller/store/statement.h"

namespace chiaro::store {
namespace {

/// Raised whenever a table changes; `kTables` then brings older files up to it.
constexpr int kVersion = 1;
constexpr const char* kTables = R"(
CREATE TABLE IF NOT EXISTS looks (
  id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT NOT NULL, mood TEXT NOT NULL,
  verdict TEXT NOT NULL, created TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  kept INTEGER NOT NULL DEFAULT 0, request TEXT NOT NULL, json TEXT NOT NULL,
  picture BLOB NOT NULL, placed_picture BLOB NOT NULL, reference BLOB NOT NULL);
CREATE TABLE IF NOT EXISTS moods (name TEXT PRIMARY KEY, title TEXT NOT NULL, picture BLOB NOT NULL);
CREATE TABLE IF NOT EXISTS settings (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS journal (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  time TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')), what TEXT NOT NULL);
PRAGMA user_version = 1;
)";
/// The journal is for people: older lines go.
constexpr std::int64_t kMostJournal = 10000;

bool execute(sqlite3* database, const char* sql) {
  return sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

core::Problem trouble(sqlite3* database, const std::string& file) {
  const std::string reason = database ? sqlite3_errmsg(database) : "no memory";
  return {{file, 0, 0},
          "the store cannot be used: " + reason,
          "check the permissions of its folder and the space on its disk"};
}

std::string file_of(sqlite3* database) {
  const char* name = sqlite3_db_filename(database, "main");
  return name == nullptr ? "" : name;
}

}  // namespace

struct Store::Database {
  sqlite3* handle = nullptr;
  ~Database() { sqlite3_close(handle); }

  core::Result<core::Done> done(bool ok) const {
    if (ok) return core::Done{};
    return trouble(handle, file_of(handle));
  }
};

core::Result<std::unique_ptr<Store>> Store::open(const std::filesystem::path& file) {
  std::error_code code;
  std::filesystem::create_directories(file.parent_path(), code);
  auto database = std::make_unique<Database>();
  if (sqlite3_open(file.c_str(), &database->handle) != SQLITE_OK)
    return trouble(database->handle, file);
  sqlite3* const handle = database->handle;
  sqlite3_busy_timeout(handle, 2000);
  const bool readable = execute(handle, "PRAGMA schema_version");
  if (!readable && sqlite3_errcode(handle) == SQLITE_NOTADB)
    return core::Problem{{file, 0, 0},
                         "this is not a store, or it is damaged",
                         "move it away: Chiaro makes a new one, looks in it are lost"};
  // FULL: a look that was answered for is on the disk, even if the mains fail.
  if (!readable || !execute(handle, "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;"))
    return trouble(handle, file);
  Statement version(handle, "PRAGMA user_version");
  if (version.row() && version.whole(0) > kVersion)
    return core::Problem{{file, 0, 0},
                         "this store was made by a newer Chiaro",
                         "install that version again, or move the file away"};
  if (!execute(handle, kTables)) return trouble(handle, file);
  return std::unique_ptr<Store>(new Store(std::move(database)));
}

Store::Store(std::unique_ptr<Database> database) : database_(std::move(database)) {}
Store::~Store() = default;

core::Result<std::int64_t> Store::save_look(const LookRecord& look) {
  Statement insert(database_->handle,
                   "INSERT INTO looks (name, mood, verdict, kept, request, json, picture, "
                   "placed_picture, reference) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.text(look.name).text(look.mood).text(look.verdict).number(look.kept ? 1 : 0);
  insert.text(look.request).text(look.json).blob(look.picture).blob(look.placed_picture);
  if (!insert.blob(look.reference).run())
    return trouble(database_->handle, file_of(database_->handle));
  return static_cast<std::int64_t>(sqlite3_last_insert_rowid(database_->handle));
}

core::Result<core::Done> Store::update_look(const LookRecord& look) {
  Statement update(database_->handle,
                   "UPDATE looks SET verdict = ?, json = ?, placed_picture = ? WHERE id = ?");
  update.text(look.verdict).text(look.json).blob(look.placed_picture).number(look.id);
  return database_->done(update.run());
}

core::Result<core::Done> Store::update_pictures(std::int64_t id, const Bytes& picture,
                                                const Bytes& placed_picture) {
  Statement update(database_->handle,
                   "UPDATE looks SET picture = ?, placed_picture = ? WHERE id = ?");
  return database_->done(update.blob(picture).blob(placed_picture).number(id).run());
}

core::Result<core::Done> Store::keep_look(std::int64_t id, const std::string& name) {
  Statement update(database_->handle, "UPDATE looks SET name = ?, kept = 1 WHERE id = ?");
  return database_->done(update.text(name).number(id).run());
}

std::optional<LookRecord> Store::look(std::int64_t id) const {
  Statement select(database_->handle,
                   "SELECT name, mood, verdict, created, kept, request, json, picture, "
                   "placed_picture, reference FROM looks WHERE id = ?");
  if (!select.number(id).row()) return std::nullopt;
  LookRecord look;
  look.id = id;
  look.name = select.bytes(0);
  look.mood = select.bytes(1);
  look.verdict = select.bytes(2);
  look.created = select.bytes(3);
  look.kept = select.whole(4) != 0;
  look.request = select.bytes(5);
  look.json = select.bytes(6);
  look.picture = select.bytes(7);
  look.placed_picture = select.bytes(8);
  look.reference = select.bytes(9);
  return look;
}

std::vector<LookRecord> Store::looks() const {
  std::vector<LookRecord> list;
  Statement select(database_->handle,
                   "SELECT id, name, mood, verdict, created, kept FROM looks ORDER BY id DESC");
  while (select.row()) {
    LookRecord look;
    look.id = select.whole(0);
    look.name = select.bytes(1);
    look.mood = select.bytes(2);
    look.verdict = select.bytes(3);
    look.created = select.bytes(4);
    look.kept = select.whole(5) != 0;
    list.push_back(std::move(look));
  }
  return list;
}

bool Store::remove_look(std::int64_t id) {
  Statement remove(database_->handle, "DELETE FROM looks WHERE id = ?");
  return remove.number(id).run() && remove.changes() > 0;
}

void Store::prune_looks(std::size_t most, std::int64_t live) {
  Statement remove(database_->handle,
                   "DELETE FROM looks WHERE kept = 0 AND id <> ? AND id NOT IN "
                   "(SELECT id FROM looks WHERE kept = 0 ORDER BY id DESC LIMIT ?)");
  remove.number(live).number(static_cast<std::int64_t>(most)).run();
}

core::Result<core::Done> Store::save_mood(const MoodRecord& mood) {
  Statement insert(database_->handle,
                   "INSERT OR REPLACE INTO moods (name, title, picture) VALUES (?, ?, ?)");
  return database_->done(insert.text(mood.name).text(mood.title).blob(mood.picture).run());
}

std::optional<MoodRecord> Store::mood(const std::string& name) const {
  Statement select(database_->handle, "SELECT title, picture FROM moods WHERE name = ?");
  if (!select.text(name).row()) return std::nullopt;
  return MoodRecord{name, select.bytes(0), select.bytes(1)};
}

std::vector<MoodRecord> Store::moods() const {
  std::vector<MoodRecord> list;
  Statement select(database_->handle, "SELECT name, title FROM moods ORDER BY name");
  while (select.row()) list.push_back({select.bytes(0), select.bytes(1), ""});
  return list;
}

bool Store::remove_mood(const std::string& name) {
  Statement remove(database_->handle, "DELETE FROM moods WHERE name = ?");
  return remove.text(name).run() && remove.changes() > 0;
}

core::Result<core::Done> Store::set(const std::string& key, const std::string& value) {
  Statement insert(database_->handle, "INSERT OR REPLACE INTO settings (key, value) VALUES (?, ?)");
  return database_->done(insert.text(key).text(value).run());
}

std::optional<std::string> Store::get(const std::string& key) const {
  Statement select(database_->handle, "SELECT value FROM settings WHERE key = ?");
  if (!select.text(key).row()) return std::nullopt;
  return select.bytes(0);
}

void Store::note(const std::string& what) {
  Statement(database_->handle, "INSERT INTO journal (what) VALUES (?)").text(what).run();
  Statement(database_->handle, "DELETE FROM journal WHERE id <= (SELECT MAX(id) FROM journal) - ?")
      .number(kMostJournal)
      .run();
}

std::vector<JournalEntry> Store::journal(std::size_t most) const {
  std::vector<JournalEntry> list;
  Statement select(database_->handle, "SELECT time, what FROM journal ORDER BY id DESC LIMIT ?");
  select.number(static_cast<std::int64_t>(most));
  while (select.row()) list.push_back({select.bytes(0), select.bytes(1)});
  return list;
}

}  // namespace chiaro::store
