#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "core/base/result.h"

namespace arris {

struct Document;

/// What a value of a parameter is.
enum class ParameterKind : std::uint8_t {
  real,
  whole,
  choice,
  flag,
  text,
  interval,   ///< [min, max] of the criterion; max null: no upper end.
  intervals,  ///< A list of them.
  line,       ///< An id, as partition; kept with an anchor, by which it is found again.
  lines,
  partition,
  partitions,
  vertex,  ///< Of the working mesh, as those of paths.
  path,    ///< A list of vertices.
  paths,
  region,  ///< {"vertices": [...], "radius": length}: what a brush went over.
  other,   ///< What `form` says and `accepts` tells.
};

struct ParameterChoice {
  std::string_view key;    ///< "normal_jump"
  std::string_view label;  ///< "Normal jump"
};

/// What a default is made from.
struct DefaultFrom {
  const Document& document;
  const nlohmann::json& given;     ///< What the operation was given.
  const nlohmann::json& resolved;  ///< The parameters that stand before in the table.
};

/// What stands for a parameter that is left out.
class Default {
 public:
  Default() = default;  ///< Nothing: it has to be given.
  Default(double value) : value_(value) {}
  Default(int value) : value_(value) {}
  Default(bool value) : value_(value) {}
  Default(const char* value) : value_(value) {}
  /// A list without anything in it.
  static Default empty_list() {
    Default none;
    none.value_ = nlohmann::json::array();
    return none;
  }
  /// Worked out; `from` says how: "three times the noise of the scan".
  Default(std::string_view from, nlohmann::json (*make)(const DefaultFrom&))
      : from_(from), make_(make) {}

  bool there() const { return make_ || !value_.is_null(); }
  /// How it is worked out; empty: it is the same for every part.
  std::string_view from() const { return from_; }
  /// Null where it is worked out.
  const nlohmann::json& constant() const { return value_; }
  nlohmann::json value(const DefaultFrom& from) const { return make_ ? make_(from) : value_; }

 private:
  nlohmann::json value_;
  std::string_view from_;
  nlohmann::json (*make_)(const DefaultFrom&) = nullptr;
};

/// The unit of lengths of the part.
inline constexpr std::string_view unit_of_part = "length";
/// The longest length that makes sense, in diagonals of the part.
inline constexpr double longest_length = 1000.0;
/// More faces than a mesh has.
inline constexpr std::int64_t most_faces = 0x7FFFFFFF;

/// A parameter of an operation: all that is known of it, said here and nowhere else. Step cards,
/// preview bars, options of the command line, manual page, schema and reports are made from it.
struct Parameter {
  std::string_view name;  ///< "min_length"
  ParameterKind kind = ParameterKind::other;
  std::string_view label = {};  ///< "Least length"; empty: no card shows it.
  std::string_view help = {};   ///< A sentence or two: what it does, what an extreme value means.
  std::string_view unit = {};   ///< "°", "faces", unit_of_part; empty: none.
  double least = 0.0;           ///< Of numbers; both bounds are allowed.
  double most = 0.0;            ///< Of lengths in diagonals of the part.
  std::size_t count = 1;        ///< Of lists and paths: how many there have to be.
  std::vector<ParameterChoice> choices = {};
  Default otherwise = {};
  bool optional = false;       ///< Left out, nothing stands for it.
  bool may_be_locked = false;  ///< Of lines and partitions.
  bool or_none = false;        ///< Of a partition: 0 stands for none.
  bool derived = false;        ///< Filled in when it is first done, to be done again the same way.
  /// Of lines and partitions: the parameter that keeps where they are.
  std::string_view anchors = {};
  /// Exactly one of the parameters with the same text here is given.
  std::string_view one_of = {};
  /// The parameter without which it means nothing and is not taken.
  std::string_view only_with = {};
  /// The "method" with which it counts; empty: with any.
  std::string_view method = {};
  /// Its default is another one by another "method".
  bool by_method = false;
  /// Of `other` and texts: what a value must be, and whether one is; `accepts` may change it to how
  /// it is kept.
  std::string_view form = {};
  bool (*accepts)(nlohmann::json& value, const Document& document) = nullptr;
  /// What a slider spans, where that is less than what is allowed; logarithmic from `from` on.
  double from = 0.0, to = 0.0;
  bool logarithmic = false;
  /// The command line's option for it; empty: it has none.
  std::string_view option = {};
};

/// What a value must be: "a number from 0.1 to 179.9".
std::string form_of(const Parameter& parameter);

/// Whether it counts among these (resolved) parameters: with their method, not only kept.
bool counts_in(const nlohmann::json& parameters, const Parameter& parameter);

/// Whether a text can be written down as JSON, and so in a journal.
bool is_utf8(const std::string& text);

/// Reads the parameters of an operation by the table and collects them into the resolved object.
/// The first fault is kept; finish() returns it, or complains of unknown names.
class ParameterReader {
 public:
  ParameterReader(std::string_view operation, const Document& document, const nlohmann::json& given)
      : operation_(operation), document_(document), given_(given) {}

  /// Reads one after the other. Faults: missing, of the wrong type, out of range, not in the
  /// document.
  void read(const std::vector<Parameter>& parameters);

  const Document& document() const { return document_; }
  bool has(std::string_view name) const { return given_.contains(name); }
  /// As given; null where absent.
  const nlohmann::json& given(std::string_view name) const;
  /// What a parameter was resolved to.
  const nlohmann::json& resolved(std::string_view name) const { return resolved_.at(name); }
  void set(std::string_view name, nlohmann::json value) {
    resolved_[std::string(name)] = std::move(value);
  }
  void fault(std::string_view name, const std::string& expected);
  bool good() const { return !error_; }

  Result<nlohmann::json> finish();

 private:
  void read(const Parameter& parameter);
  void read_number(const Parameter& parameter, const nlohmann::json& value);
  void read_choice(const Parameter& parameter, const nlohmann::json& value);
  void read_lines(const Parameter& parameter, const nlohmann::json& value);
  void read_partitions(const Parameter& parameter, const nlohmann::json& value);
  void read_paths(const Parameter& parameter, const nlohmann::json& value);
  /// Ids of one or of several, ascending; nothing where they are none.
  std::optional<std::vector<std::uint32_t>> read_ids(const Parameter& parameter,
                                                     const nlohmann::json& value);
  void keep_anchors(const Parameter& parameter, const nlohmann::json& own, std::size_t least,
                    std::size_t most);
  void check_alternatives(const std::vector<Parameter>& parameters);
  /// `value` where it is good, with a fault where it is not.
  void take(const Parameter& parameter, const nlohmann::json& value, bool good);

  std::string operation_;
  const Document& document_;
  const nlohmann::json& given_;
  nlohmann::json resolved_ = nlohmann::json::object();
  std::set<std::string, std::less<>> known_;
  std::optional<Error> error_;
};

}  // namespace arris
