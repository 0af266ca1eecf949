#include "core/document/parameters.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/document/document.h"

namespace arris {

namespace {

using nlohmann::json;

bool is_id(const json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() < no_id;
}

bool is_list_of_ids(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), is_id);
}

bool is_list(ParameterKind kind) {
  return kind == ParameterKind::lines || kind == ParameterKind::partitions;
}

bool is_interval(const json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() &&
         (value[1].is_number() || value[1].is_null()) && std::isfinite(value[0].get<double>()) &&
         value[0].get<double>() >= 0.0 &&
         (value[1].is_null() || value[1].get<double>() > value[0].get<double>());
}

bool is_vertex(const json& value, const Mesh& mesh) {
  return is_id(value) && value.get<VertexId>() < mesh.vertex_count() &&
         !mesh.is_isolated(value.get<VertexId>());
}

bool is_path(const json& value, std::size_t count, const Mesh& mesh) {
  return value.is_array() && value.size() >= count &&
         std::all_of(value.begin(), value.end(), [&](const json& v) { return is_vertex(v, mesh); });
}

bool is_region(const json& value, const Mesh& mesh) {
  return value.is_object() && value.size() == 2 && value.contains("vertices") &&
         value.contains("radius") && is_list_of_ids(value["vertices"]) &&
         !value["vertices"].empty() && value["radius"].is_number() &&
         value["radius"].get<double>() >= 0.0 &&
         value["radius"].get<double>() <= longest_length * mesh.diagonal();
}

/// "a line", "two partitions"
std::string at_least(std::size_t count, const char* one, const char* many) {
  return count == 1   ? "a " + std::string(one)
         : count == 2 ? "two " + std::string(many)
                      : std::to_string(count) + " " + many;
}

std::string quoted(const std::vector<ParameterChoice>& choices) {
  std::string list;
  for (const ParameterChoice& choice : choices)
    list += (list.empty() ? "\"" : ", \"") + std::string(choice.key) + "\"";
  return list;
}

std::string number_form(ParameterKind kind, double least, double most) {
  return kind == ParameterKind::whole
             ? "a whole number from " + std::to_string(static_cast<std::int64_t>(least)) + " to " +
                   std::to_string(static_cast<std::int64_t>(most))
             : "a number from " + number_text(least) + " to " + number_text(most);
}

}  // namespace

std::string form_of(const Parameter& parameter) {
  if (!parameter.form.empty()) return std::string(parameter.form);
  const std::string count = std::to_string(parameter.count);
  switch (parameter.kind) {
    case ParameterKind::real:
      if (parameter.unit == unit_of_part)
        return "a length of at least " + number_text(parameter.least);
      [[fallthrough]];
    case ParameterKind::whole:
      return number_form(parameter.kind, parameter.least, parameter.most);
    case ParameterKind::choice:
      return "one of " + quoted(parameter.choices);
    case ParameterKind::flag:
      return "true or false";
    case ParameterKind::interval:
      return "an interval [min, max] with 0 <= min < max";
    case ParameterKind::intervals:
      return "a list of intervals [min, max] with 0 <= min < max";
    case ParameterKind::line:
    case ParameterKind::partition:
      return "an id";
    case ParameterKind::lines:
    case ParameterKind::partitions:
      return "a list of ids";
    case ParameterKind::vertex:
      return "a vertex of the working mesh";
    case ParameterKind::path:
      return "a list of " + count + " or more vertices of the working mesh";
    case ParameterKind::paths:
      return "a list of paths of two or more vertices of the working mesh";
    case ParameterKind::region:
      return "a region {\"vertices\": [...], \"radius\": length}";
    case ParameterKind::text:
    case ParameterKind::other:
      break;
  }
  return "a text";
}

bool counts_in(const json& parameters, const Parameter& parameter) {
  return parameter.method.empty() || parameters.value("method", "") == parameter.method;
}

bool is_utf8(const std::string& text) {
  const std::string kept = json(text).dump(-1, ' ', false, json::error_handler_t::ignore);
  return json::parse(kept).get<std::string>() == text;
}

const json& ParameterReader::given(std::string_view name) const {
  static const json nothing;
  const auto found = given_.find(name);
  return found == given_.end() ? nothing : *found;
}

void ParameterReader::fault(std::string_view name, const std::string& expected) {
  if (error_) return;
  const auto found = given_.find(name);
  std::string value = found == given_.end()
                          ? "nothing"
                          : found->dump(-1, ' ', false, json::error_handler_t::replace);
  if (value.size() > 60) value = value.substr(0, 57) + "...";
  error_ = Error{operation_ + ": '" + std::string(name) + "' is " + value + "; expected " +
                 expected + "."};
}

void ParameterReader::check_alternatives(const std::vector<Parameter>& parameters) {
  std::set<std::string_view> checked;
  for (const Parameter& parameter : parameters) {
    if (parameter.one_of.empty() || !checked.insert(parameter.one_of).second) continue;
    std::string names;
    std::size_t there = 0;
    for (const Parameter& other : parameters)
      if (other.one_of == parameter.one_of) {
        names += (names.empty() ? "" : ", ") + std::string(other.name);
        there += has(other.name);
      }
    if (there != 1) fault(parameter.name, "exactly one of " + names);
  }
}

void ParameterReader::read(const std::vector<Parameter>& parameters) {
  check_alternatives(parameters);
  for (const Parameter& parameter : parameters) {
    if (parameter.only_with.empty() || has(parameter.only_with)) {
      known_.emplace(parameter.name);
      if (!parameter.anchors.empty()) known_.emplace(parameter.anchors);
    }
    read(parameter);
  }
}

void ParameterReader::take(const Parameter& parameter, const json& value, bool good) {
  if (!good) fault(parameter.name, form_of(parameter));
  set(parameter.name, value);
}

void ParameterReader::read(const Parameter& parameter) {
  json value = given(parameter.name);
  const bool left_out = value.is_null();
  if (parameter.derived || (!parameter.only_with.empty() && !has(parameter.only_with))) return;
  if (left_out) {
    // A faulty parameter before may be what the default is made from.
    if (error_ || parameter.optional || (!parameter.one_of.empty() && !has(parameter.name))) return;
    value = parameter.otherwise.value({document_, given_, resolved_});
  }
  const Mesh* mesh = document_.mesh.get();
  switch (parameter.kind) {
    case ParameterKind::real:
    case ParameterKind::whole:
      return read_number(parameter, value);
    case ParameterKind::choice:
      return read_choice(parameter, value);
    case ParameterKind::flag:
      return take(parameter, value, value.is_boolean());
    case ParameterKind::interval:
      return take(parameter, value, is_interval(value));
    case ParameterKind::intervals:
      // An empty list says no more than none.
      if (value.is_array() && value.empty())
        value = parameter.otherwise.value({document_, given_, resolved_});
      return take(parameter, value,
                  value.is_array() && std::all_of(value.begin(), value.end(), is_interval));
    case ParameterKind::line:
    case ParameterKind::lines:
      return read_lines(parameter, value);
    case ParameterKind::partition:
    case ParameterKind::partitions:
      return read_partitions(parameter, value);
    case ParameterKind::vertex:
      return take(parameter, value, is_vertex(value, *mesh));
    case ParameterKind::path:
      return take(parameter, value, is_path(value, parameter.count, *mesh));
    case ParameterKind::paths:
      return take(parameter, value,
                  value.is_array() && !value.empty() &&
                      std::all_of(value.begin(), value.end(),
                                  [&](const json& path) { return is_path(path, 2, *mesh); }));
    case ParameterKind::region:
      return take(parameter, value, is_region(value, *mesh));
    case ParameterKind::text:
    case ParameterKind::other:
      break;
  }
  const bool good = (parameter.kind != ParameterKind::text || value.is_string()) &&
                    (!parameter.accepts || parameter.accepts(value, document_));
  take(parameter, value, good);
}

void ParameterReader::read_number(const Parameter& parameter, const json& value) {
  const bool whole = parameter.kind == ParameterKind::whole;
  const double scale = parameter.unit == unit_of_part ? document_.mesh->diagonal() : 1.0;
  const double least = parameter.least, most = parameter.most * scale;
  if (given(parameter.name).is_null() && value.is_number() && !whole) {
    // What a part of absurd size suggests: a journal can hold no number that is infinite or none.
    double fitting = value;
    if (!std::isfinite(fitting) || fitting < least || fitting > most)
      fitting = fitting > most && std::isfinite(most) ? most : least;
    set(parameter.name, fitting);
    return;
  }
  const bool good = (whole ? value.is_number_integer() : value.is_number()) &&
                    std::isfinite(value.get<double>()) && value.get<double>() >= least &&
                    value.get<double>() <= most;
  if (!good) return fault(parameter.name, number_form(parameter.kind, least, most));
  if (whole)
    set(parameter.name, value.get<std::int64_t>());
  else
    set(parameter.name, value.get<double>());
}

void ParameterReader::read_choice(const Parameter& parameter, const json& value) {
  take(parameter, value,
       value.is_string() && std::ranges::any_of(parameter.choices, [&](const auto& choice) {
         return choice.key == value.get_ref<const std::string&>();
       }));
}

std::optional<std::vector<std::uint32_t>> ParameterReader::read_ids(const Parameter& parameter,
                                                                    const json& value) {
  const bool many = is_list(parameter.kind);
  const json list = many ? value : json::array({value});
  if (!is_list_of_ids(list)) {
    fault(parameter.name, form_of(parameter));
    return std::nullopt;
  }
  std::vector<std::uint32_t> ids = list;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  set(parameter.name, many ? json(ids) : value);
  return ids;
}

void ParameterReader::read_lines(const Parameter& parameter, const json& value) {
  const auto ids = read_ids(parameter, value);
  if (!ids) return;
  if (ids->size() < parameter.count)
    fault(parameter.name, at_least(parameter.count, "line", "lines") + " at least");
  json paths = json::array();
  for (const std::uint32_t id : *ids) {
    const Line* line = document_.lines.find(id);
    if (!line) return fault(parameter.name, "ids of lines; there is no line " + std::to_string(id));
    if (line->locked && !parameter.may_be_locked)
      return fault(parameter.name,
                   "lines that are not locked; unlock line " + std::to_string(id) + " first");
    paths.push_back(line->vertices);
  }
  keep_anchors(parameter, paths, 2, std::numeric_limits<std::size_t>::max());
}

void ParameterReader::read_partitions(const Parameter& parameter, const json& value) {
  if (parameter.or_none && value == 0u) {
    set(parameter.name, 0u);
    set(parameter.anchors, Triangle{});
    return;
  }
  const auto ids = read_ids(parameter, value);
  if (!ids) return;
  json faces = json::array();
  for (const std::uint32_t id : *ids) {
    const Partition* partition = document_.partitions.find(id);
    if (!partition)
      return fault(parameter.name,
                   "ids of partitions; there is no partition " + std::to_string(id));
    if (partition->locked && !parameter.may_be_locked)
      return fault(parameter.name, "partitions that are not locked; unlock partition " +
                                       std::to_string(id) + " first");
    faces.push_back(partition->anchor);
  }
  if (ids->size() < parameter.count)
    fault(parameter.name, at_least(parameter.count, "partition", "partitions") + " at least");
  keep_anchors(parameter, faces, 3, 3);
}

void ParameterReader::keep_anchors(const Parameter& parameter, const json& own, std::size_t least,
                                   std::size_t most) {
  const json& kept = given(parameter.anchors);
  const bool many = is_list(parameter.kind);
  if (kept.is_null()) {
    set(parameter.anchors, many ? own : own[0]);
    return;
  }
  const json list = many ? kept : json::array({kept});
  if (!list.is_array() || list.size() != own.size() ||
      !std::all_of(list.begin(), list.end(), [&](const json& anchor) {
        return is_list_of_ids(anchor) && anchor.size() >= least && anchor.size() <= most;
      }))
    fault(parameter.anchors, most == least ? "a face [a, b, c] for each partition"
                                           : "a path of vertices for each line");
  set(parameter.anchors, kept);
}

Result<json> ParameterReader::finish() {
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
