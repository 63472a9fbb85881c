// SPDX-License-Identifier: BSD-3-Clause
#include "memory_database.hpp"

#include <sqlite3.h>

#include <utility>

namespace hypermap {
namespace {

Unexpected refusal(int code, sqlite3* database) {
  if (code == SQLITE_NOMEM || database == nullptr) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the GeoPackage");
  }
  const bool is_too_large = code == SQLITE_TOOBIG || code == SQLITE_FULL;
  return fail(is_too_large ? ErrorCode::kLimit : ErrorCode::kInvalidArgument,
              std::string("SQLite: ") + printable(sqlite3_errmsg(database)));
}

/// Binds a value to a place, counted from 1. Text and bytes must outlive the run.
struct Binder {
  sqlite3_stmt* statement;
  int place;

  int operator()(std::monostate /*unknown*/) const { return sqlite3_bind_null(statement, place); }
  int operator()(std::int64_t number) const { return sqlite3_bind_int64(statement, place, number); }
  int operator()(double number) const { return sqlite3_bind_double(statement, place, number); }
  int operator()(const std::string& text) const {
    return sqlite3_bind_text64(
        statement, place, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
  }
  int operator()(const SqlBlob& blob) const {
    return sqlite3_bind_blob64(
        statement, place, blob.bytes.data(), blob.bytes.size(), SQLITE_STATIC);
  }
};

struct FreeSqliteBytes {
  void operator()(unsigned char* bytes) const noexcept { sqlite3_free(bytes); }
};

}  // namespace

std::string sql_name(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

void SqlInsert::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

Result<void> SqlInsert::run(std::span<const SqlValue> values) {
  sqlite3_stmt* statement = statement_.get();
  int place = 0;
  for (const SqlValue& value : values) {
    const int bound = std::visit(Binder{statement, ++place}, value);
    if (bound != SQLITE_OK) return refusal(bound, sqlite3_db_handle(statement));
  }
  const int done = sqlite3_step(statement);
  if (done != SQLITE_DONE) return refusal(done, sqlite3_db_handle(statement));
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  return {};
}

void MemoryDatabase::Close::operator()(sqlite3* database) const noexcept {
  sqlite3_close(database);
}

Result<MemoryDatabase> MemoryDatabase::create() {
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  std::unique_ptr<sqlite3, Close> database(opened);
  if (code != SQLITE_OK) return refusal(code, opened);
  return MemoryDatabase(std::move(database));
}

Result<void> MemoryDatabase::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return refusal(code, database_.get());
  return {};
}

Result<SqlInsert> MemoryDatabase::prepare(const std::string& sql) {
  sqlite3_stmt* prepared = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &prepared, nullptr);
  if (code != SQLITE_OK) return refusal(code, database_.get());
  return SqlInsert(std::unique_ptr<sqlite3_stmt, SqlInsert::Finalize>(prepared));
}

Result<std::string> MemoryDatabase::bytes() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, FreeSqliteBytes> bytes(
      sqlite3_serialize(database_.get(), "main", &size, 0));
  if (!bytes) return refusal(SQLITE_NOMEM, database_.get());
  return std::string(bytes.get(), bytes.get() + size);
}

}  // namespace hypermap
