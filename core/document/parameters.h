#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace arris {

/// Whether a text can be written down as JSON, and so in a journal.
bool is_utf8(const std::string& text);

/// One thing that a reader was asked for; a parameter may come more than once.
struct ParameterNote {
  std::string name;
  std::string expected = {};      ///< Why what is given was refused; empty: it was not.
  nlohmann::json otherwise = {};  ///< What stands for it where it is left out; null: not said here.
};

/// While it lives, notes what all readers of its thread are asked for: an operation's parameters
/// are known by what it reads. One at a time in a thread.
class ParameterWatch {
 public:
  ParameterWatch();
  ~ParameterWatch();
  ParameterWatch(const ParameterWatch&) = delete;
  ParameterWatch& operator=(const ParameterWatch&) = delete;

  const std::vector<ParameterNote>& notes() const { return notes_; }

 private:
  friend class ParameterReader;
  std::vector<ParameterNote> notes_;
};

/// Reads the parameters of an operation with types, ranges and defaults, and collects them into the
/// resolved object. The first fault is kept; finish() returns it, or complains of unknown names.
class ParameterReader {
 public:
  ParameterReader(std::string operation, const nlohmann::json& given)
      : operation_(std::move(operation)), given_(given) {}

  /// A number in [least, most].
  double real(const std::string& name, double otherwise, double least, double most);
  /// A whole number in [least, most].
  std::int64_t whole(const std::string& name, std::int64_t otherwise, std::int64_t least,
                     std::int64_t most);
  /// One of `choices`.
  std::string choice(const std::string& name, const std::string& otherwise,
                     const std::vector<std::string>& choices);
  std::string text(const std::string& name, const std::string& otherwise);
  bool flag(const std::string& name, bool otherwise);
  /// The value as given, to be checked by the caller; null where absent.
  const nlohmann::json& raw(const std::string& name);
  bool has(const std::string& name) const;
  /// Sets what raw() was resolved to.
  void set(const std::string& name, nlohmann::json value) { resolved_[name] = std::move(value); }
  void fault(const std::string& name, const std::string& expected);
  /// The first fault so far, for a reader that needs good values to go on.
  Result<void> check() const;
  /// What a parameter read so far was resolved to.
  const nlohmann::json& resolved(const std::string& name) const { return resolved_.at(name); }

  Result<nlohmann::json> finish();

 private:
  const nlohmann::json* take(const std::string& name, const nlohmann::json& otherwise = {});

  std::string operation_;
  const nlohmann::json& given_;
  nlohmann::json resolved_ = nlohmann::json::object();
  std::set<std::string> known_;
  std::optional<Error> error_;
};

}  // namespace arris
