#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/context.h"
#include "core/base/json.h"
#include "core/base/result.h"
#include "core/document/parameters.h"

namespace arris {

struct Document;
struct Ground;
struct TreatmentOutcome;
struct Performed;
enum class Round;

/// An operation is data: a name and parameters, one JSON object
/// `{"operation": "find_sharp_lines", "angle": 24.0, ...}`. Angles in degrees, lengths in the
/// mesh's unit.
struct Operation {
  std::string name;
  nlohmann::json parameters = nlohmann::json::object();

  /// From one JSON object. Errors: not an object, no known "operation".
  static Result<Operation> from_json(const nlohmann::json& json);
  static Result<Operation> parse(std::string_view text);
  nlohmann::json to_json() const;
  /// One line of JSON, keys sorted.
  std::string text() const { return to_json().dump(); }
  bool operator==(const Operation&) const = default;
};

/// A row of the one table on which undo, journal, replay, command line and window stand.
struct OperationKind {
  std::string_view name;   ///< "find_sharp_lines"
  std::string_view title;  ///< "Find sharp lines", as menus and the history say it.
  std::string_view help;   ///< A sentence or two: what it does.
  /// Version of the method; part of the stored operation, so that a replay knows what it replays.
  int version = 1;
  std::vector<Parameter> parameters = {};
  /// The new snapshot. A pure function of its arguments (for `open`: and of the file, whose hash is
  /// among the resolved parameters). Null: a treatment does it.
  Result<Document> (*apply)(const Document&, const nlohmann::json& parameters,
                            const Context&) = nullptr;
  /// What it does in words, for the history: "Find sharp lines, 24.0°", "Delete 24 lines"; for
  /// parameters that are not resolved as far as they go. Null: its title says it.
  std::string (*words)(const nlohmann::json& parameters) = nullptr;

  // Where the table of parameters does not say all:
  /// Whether it can be done in this document at all.
  Result<void> (*ready)(const Document&) = nullptr;
  /// Parameters as they may also be given, as those of the table.
  Result<nlohmann::json> (*understood)(const Document&, nlohmann::json given) = nullptr;
  /// Derived parameters, and faults that several parameters make together. Asked once each of them
  /// is good by itself.
  void (*complete)(ParameterReader&) = nullptr;
  /// Parameters stored by an older version as this version says the same; null: there is none.
  nlohmann::json (*upgrade)(int version, nlohmann::json parameters) = nullptr;

  /// A treatment by hand is kept as a correction: how it changes lines and partitions, at first and
  /// when they were found again, and whether it is done again after lines, or after partitions.
  Result<TreatmentOutcome> (*treat)(Ground&, const nlohmann::json& parameters, Round) = nullptr;
  bool (*belongs)(const nlohmann::json& parameters, Round) = nullptr;

  /// A step of the chain: what came of it in a document in which it was run: "137 lines, 1.2 m".
  std::string (*outcome)(const Document&) = nullptr;

  bool is_treatment() const { return treat != nullptr; }
  const Parameter* find(std::string_view parameter) const;
  /// Checks the parameters and fills in every default, from the part where they depend on it.
  Result<nlohmann::json> resolve(const Document& document, const nlohmann::json& given) const;
};

/// The operation that opens a mesh file. JSON is UTF-8 and file names are any bytes: a name that is
/// not UTF-8 is given as "file_bytes", hexadecimal, beside a "file" that one can read. `weld` as in
/// ScanOptions.
Operation open_file(const std::string& path, bool weld = true);

/// All operations.
std::span<const OperationKind> operation_table();
const OperationKind* find_operation(std::string_view name);

/// The complete operation: version, every default filled in. Errors: unknown name, version or
/// parameter, a value of the wrong type or out of range, nothing to work on.
Result<Operation> resolve(const Document& document, const Operation& operation);

/// Resolves, then applies. The document itself is untouched.
Result<Document> apply(const Document& document, const Operation& operation,
                       const Context& context = {});

/// Resolves and applies; what History and the window commit. An `open` without a hash gets that of
/// the file it read.
Result<Performed> perform(const Document& document, const Operation& operation,
                          const Context& context = {});

/// One line for the history: "Find sharp lines, 24.0°"; its title alone where the parameters are
/// none that it takes.
std::string describe(const Operation& operation);

}  // namespace arris
