// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

struct sqlite3;
struct sqlite3_stmt;

namespace hypermap {

/// Bytes that are no text.
struct SqlBlob {
  std::string bytes;
};

/// std::monostate is NULL.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string, SqlBlob>;

/// A name as SQL takes it, whatever is in it but NUL.
[[nodiscard]] std::string sql_name(std::string_view name);

/// A statement that is run again and again with other values.
class SqlInsert {
 public:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };

  explicit SqlInsert(std::unique_ptr<sqlite3_stmt, Finalize> statement)
      : statement_(std::move(statement)) {}

  /// Requires: as many values as the statement has question marks. Errors: as MemoryDatabase.
  [[nodiscard]] Result<void> run(std::span<const SqlValue> values);

 private:
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A database of SQLite that is on no disk.
///
/// Errors: kOutOfMemory, kLimit for what SQLite calls too large, kInvalidArgument for what it
/// refuses otherwise, with its words.
class MemoryDatabase {
 public:
  [[nodiscard]] static Result<MemoryDatabase> create();

  /// One statement or several.
  [[nodiscard]] Result<void> execute(const std::string& sql);
  /// Requires: this outlives the statement.
  [[nodiscard]] Result<SqlInsert> prepare(const std::string& sql);
  /// The file that this would be on a disk.
  [[nodiscard]] Result<std::string> bytes() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };

  explicit MemoryDatabase(std::unique_ptr<sqlite3, Close> database)
      : database_(std::move(database)) {}

  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace hypermap
