// SPDX-License-Identifier: Apache-2.0
// One SQL statement from preparing to finalising. Included by the store's sources only.
#pragma once

#include <cstdint>
#include <sqlite3.h>
#include <string>

namespace chiaro::store {

class Statement {
 public:
  Statement(sqlite3* database, const char* sql) : database_(database) {
    ok_ = sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) == SQLITE_OK;
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& text(const std::string& value) {
    sqlite3_bind_text(statement_, ++bound_, value.data(), static_cast<int>(value.size()),
                      SQLITE_TRANSIENT);
    return *this;
  }
  Statement& blob(const std::string& value) {
    sqlite3_bind_blob(statement_, ++bound_, value.data(), static_cast<int>(value.size()),
                      SQLITE_TRANSIENT);
    return *this;
  }
  Statement& number(std::int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  /// True while there is a row.
  bool row() { return ok_ && sqlite3_step(statement_) == SQLITE_ROW; }
  /// Runs a statement that gives no rows.
  bool run() { return ok_ && sqlite3_step(statement_) == SQLITE_DONE; }
  std::string bytes(int column) {
    const void* data = sqlite3_column_blob(statement_, column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), size);
  }
  std::int64_t whole(int column) { return sqlite3_column_int64(statement_, column); }
  int changes() const { return sqlite3_changes(database_); }

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
  bool ok_ = false;
};

}  // namespace chiaro::store
