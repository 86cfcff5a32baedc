// SQLite with errors as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

struct sqlite3;
struct sqlite3_stmt;

namespace clearway {

// A prepared statement. One thread at a time; must not outlive its database.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, sqlite3_stmt* statement);

  // Parameters count from 1; bytes are copied.
  void BindInteger(int parameter, std::int64_t value);
  void BindReal(int parameter, double value);
  void BindText(int parameter, std::string_view value);
  void BindBlob(int parameter, std::string_view value);

  // True if there is a row.
  absl::StatusOr<bool> Step();
  // Makes the statement ready for new parameters.
  void Reset();

  // Columns of the row count from 0. Text and blobs are valid until the next Step or Reset.
  std::int64_t Integer(int column) const;
  double Real(int column) const;
  std::string_view Bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// An open database. One thread at a time.
class SqliteDatabase {
 public:
  enum class Mode { kReadOnly, kCreate };
  // A file that is opened for reading is taken for hostile: https://www.sqlite.org/security.html.
  static absl::StatusOr<SqliteDatabase> Open(const std::filesystem::path& path, Mode mode);

  absl::Status Execute(const std::string& sql);
  absl::StatusOr<SqliteStatement> Prepare(const std::string& sql);
  // The one integer that a query without parameters answers with.
  absl::StatusOr<std::int64_t> QueryInteger(const std::string& sql);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  explicit SqliteDatabase(sqlite3* database) : database_(database) {}
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace clearway
