#include "core/document/parameters.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"

namespace arris {

namespace {

thread_local ParameterWatch* watch = nullptr;

}  // namespace

ParameterWatch::ParameterWatch() { watch = this; }
ParameterWatch::~ParameterWatch() { watch = nullptr; }

bool is_utf8(const std::string& text) {
  const std::string kept =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::ignore);
  return nlohmann::json::parse(kept).get<std::string>() == text;
}

const nlohmann::json* ParameterReader::take(const std::string& name,
                                            const nlohmann::json& otherwise) {
  known_.insert(name);
  if (watch) watch->notes_.push_back({name, {}, otherwise});
  const auto found = given_.find(name);
  return found == given_.end() || found->is_null() ? nullptr : &*found;
}

void ParameterReader::fault(const std::string& name, const std::string& expected) {
  if (watch) watch->notes_.push_back({name, expected});
  if (error_) return;
  const auto found = given_.find(name);
  std::string value = found == given_.end()
                          ? "nothing"
                          : found->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (value.size() > 60) value = value.substr(0, 57) + "...";
  error_ = Error{operation_ + ": '" + name + "' is " + value + "; expected " + expected + "."};
}

bool ParameterReader::has(const std::string& name) const {
  if (watch) watch->notes_.push_back({name});
  return given_.contains(name);
}

double ParameterReader::real(const std::string& name, double otherwise, double least, double most) {
  double value = otherwise;
  // What a part of absurd size suggests: a journal can hold no number that is infinite or none.
  if (!std::isfinite(value) || value < least || value > most)
    value = value > most && std::isfinite(most) ? most : least;
  if (const nlohmann::json* given = take(name, value)) {
    if (!given->is_number() || !std::isfinite(given->get<double>()) ||
        given->get<double>() < least || given->get<double>() > most)
      fault(name, "a number from " + number_text(least) + " to " + number_text(most));
    else
      value = given->get<double>();
  }
  resolved_[name] = value;
  return value;
}

std::int64_t ParameterReader::whole(const std::string& name, std::int64_t otherwise,
                                    std::int64_t least, std::int64_t most) {
  const nlohmann::json* given = take(name, otherwise);
  std::int64_t value = otherwise;
  if (given) {
    if (!given->is_number_integer() || given->get<std::int64_t>() < least ||
        given->get<std::int64_t>() > most)
      fault(name, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    else
      value = given->get<std::int64_t>();
  }
  resolved_[name] = value;
  return value;
}

std::string ParameterReader::choice(const std::string& name, const std::string& otherwise,
                                    const std::vector<std::string>& choices) {
  const nlohmann::json* given = take(name, otherwise);
  std::string value = otherwise;
  if (given) {
    if (!given->is_string() ||
        std::find(choices.begin(), choices.end(), given->get<std::string>()) == choices.end()) {
      std::string list;
      for (const std::string& c : choices) list += (list.empty() ? "\"" : ", \"") + c + "\"";
      fault(name, "one of " + list);
    } else {
      value = given->get<std::string>();
    }
  }
  resolved_[name] = value;
  return value;
}

std::string ParameterReader::text(const std::string& name, const std::string& otherwise) {
  const nlohmann::json* given = take(name, otherwise);
  std::string value = otherwise;
  if (given) {
    if (!given->is_string())
      fault(name, "a text");
    else
      value = given->get<std::string>();
  }
  resolved_[name] = value;
  return value;
}

bool ParameterReader::flag(const std::string& name, bool otherwise) {
  const nlohmann::json* given = take(name, otherwise);
  bool value = otherwise;
  if (given) {
    if (!given->is_boolean())
      fault(name, "true or false");
    else
      value = given->get<bool>();
  }
  resolved_[name] = value;
  return value;
}

const nlohmann::json& ParameterReader::raw(const std::string& name) {
  static const nlohmann::json nothing;
  const nlohmann::json* given = take(name);
  return given ? *given : nothing;
}

Result<void> ParameterReader::check() const {
  if (error_) return tl::unexpected<Error>(*error_);
  return {};
}

Result<nlohmann::json> ParameterReader::finish() {
  if (!error_)
    for (const auto& [name, value] : given_.items())
      if (!known_.contains(name)) {
        std::string list;
        for (const std::string& k : known_) list += (list.empty() ? "" : ", ") + k;
        return fail(operation_ + ": there is no parameter '" + name + "'" +
                    (list.empty() ? "; it takes none." : "; it takes " + list + "."));
      }
  if (error_) return tl::unexpected<Error>(*error_);
  return std::move(resolved_);
}

}  // namespace arris
