#include "core/document/operation_manual.h"

#include <algorithm>
#include <cstring>

#include "core/base/file_source.h"
#include "core/base/number_text.h"
#include "core/document/document.h"
#include "core/document/parameters.h"
#include "core/document/perform.h"
#include "core/samples/mould.h"

namespace arris {

namespace {

using nlohmann::json;

/// The sample as a file that was never written.
class SampleFile : public FileSource {
 public:
  explicit SampleFile(const MouldOptions& options) {
    const SampleMould mould = make_mould(options);
    text_ = "OFF\n" + std::to_string(mould.points.size()) + " " +
            std::to_string(mould.triangles.size()) + " 0\n";
    for (const Point& p : mould.points)
      text_ += number_text(p.x(), 17) + " " + number_text(p.y(), 17) + " " +
               number_text(p.z(), 17) + "\n";
    for (const Triangle& t : mould.triangles)
      text_ += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
               std::to_string(t[2]) + "\n";
  }

  Result<FileContent> find(const std::string&, const std::string&, const Context&) const override {
    FileContent content{std::make_unique<char[]>(text_.size()), text_.size()};
    std::memcpy(content.bytes.get(), text_.data(), text_.size());
    return content;
  }
  std::string hash() const { return hash_of_content(text_); }

 private:
  std::string text_;
};

/// A sample with lines and partitions, so that there is something to treat.
Result<Document> sample_document(const MouldOptions& options) {
  const SampleFile file(options);
  Document document;
  for (const Operation& operation :
       {Operation{"open", {{"file", "sample.off"}, {"hash", file.hash()}}},
        Operation{"find_sharp_lines"}, Operation{"find_partitions"}}) {
    Result<Performed> performed = perform(document, operation, &file, {});
    if (!performed) return tl::unexpected<Error>(performed.error());
    document = std::move(performed->document);
  }
  return document;
}

/// What came of resolving an operation with certain parameters.
struct Asked {
  std::vector<ParameterNote> notes;
  Result<json> resolved;

  /// Why a parameter was refused first; empty: it was not.
  std::string refused(const std::string& name) const {
    for (const ParameterNote& note : notes)
      if (note.name == name && !note.expected.empty()) return note.expected;
    return {};
  }
  /// What the reader said stands for a parameter that is left out; null: it said nothing.
  json otherwise(const std::string& name) const {
    for (const ParameterNote& note : notes)
      if (note.name == name && !note.otherwise.is_null()) return note.otherwise;
    return {};
  }
};

Asked ask(const OperationKind& kind, const Document& document, const json& given) {
  const ParameterWatch watch;
  Result<json> resolved = kind.resolve(document, given);
  return {watch.notes(), std::move(resolved)};
}

/// Values of which each operation takes one where it needs one, to come to what it reads after.
std::vector<json> plausible_values(const Document& document) {
  std::vector<json> values{"mm", {0.0, 1.0}};
  for (const LinePtr& line : document.lines.lines) {
    const std::vector<VertexId>& path = line->vertices;
    if (line->closed || path.size() < 4) continue;
    for (const json& value : {json(path[2]), json(path[0]), json(path), json(line->id),
                              json::array({line->id}), json{{"vertices", path}, {"radius", 1.0}}})
      values.push_back(value);
  }
  for (const PartitionPtr& partition : document.partitions.partitions) {
    values.push_back(partition->id);
    values.push_back(json::array({partition->id}));
  }
  for (const BoundaryPtr& boundary : *document.boundaries)
    values.push_back({boundary->left, boundary->right});
  return values;
}

json with(json given, const std::string& name, json value) {
  given[name] = std::move(value);
  return given;
}

/// What an operation takes on one part.
std::vector<ParameterManual> parameters_of(const OperationKind& kind, const Document& document) {
  const std::vector<json> values = plausible_values(document);
  const json nonsense{{"?", true}};  // no parameter takes such an object
  json enough = json::object();      // what has to be given
  std::vector<std::string> names;
  const auto note = [&](const Asked& asked) {
    for (const ParameterNote& one : asked.notes)
      if (std::find(names.begin(), names.end(), one.name) == names.end()) names.push_back(one.name);
  };
  note(ask(kind, document, enough));
  for (std::size_t k = 0; k < names.size(); ++k) note(ask(kind, document, {{names[k], nonsense}}));
  // What is read after all that has to be given is there; one may fit only once another is.
  for (int round = 0; round < 2; ++round)
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (ask(kind, document, enough).refused(names[k]).empty()) continue;
      for (const json& value : values)
        if (const Asked asked = ask(kind, document, with(enough, names[k], value));
            asked.refused(names[k]).empty()) {
          enough = with(enough, names[k], value);
          note(asked);
          break;
        }
    }
  std::vector<ParameterManual> parameters;
  for (const std::string& name : names) {
    json without = enough;
    without.erase(name);
    const Asked absent = ask(kind, document, without);
    ParameterManual parameter;
    parameter.name = name;
    parameter.required = absent.refused(name);
    // Alone, with what has to be given, or with another one without which it is not read.
    std::vector<json> refusals{{{name, nonsense}}, with(enough, name, nonsense)};
    json otherwise = absent.otherwise(name);
    for (const std::string& other : names) {
      refusals.push_back({{other, nonsense}, {name, nonsense}});
      if (otherwise.is_null() && other != name)
        otherwise = ask(kind, document, {{other, nonsense}}).otherwise(name);
    }
    for (const json& given : refusals)
      if (parameter.expected.empty()) parameter.expected = ask(kind, document, given).refused(name);
    if (otherwise.is_null() && absent.resolved && absent.resolved->contains(name))
      otherwise = (*absent.resolved)[name];
    if (!otherwise.is_null()) parameter.otherwise = otherwise;
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::string value_text(const json& value) {
  if (value.is_number_float()) return number_text(value, 4);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// "A number from 0.1 to 179.9; left out: from the part (27 on the sample mould)."
std::string sentence_of(const ParameterManual& parameter) {
  const json otherwise = parameter.otherwise.value_or(json());
  std::string text = parameter.expected;
  if (parameter.range_depends_on_part) text += " on the sample mould";
  if (!text.empty()) text += "; ";
  if (!parameter.required.empty()) {
    text += "must be given";
    if (parameter.required != parameter.expected) text += ": " + parameter.required;
  } else if (otherwise.is_null() || otherwise == "") {
    text += "may be left out";
  } else if (!parameter.depends_on_part) {
    text += "left out: " + (otherwise.empty() ? "none" : value_text(otherwise));
  } else {
    text += "left out: from the part";
    if (otherwise.is_primitive()) text += " (" + value_text(otherwise) + " on the sample mould)";
  }
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

}  // namespace

Result<std::vector<OperationManual>> operation_manual() {
  const Result<Document> sample = sample_document({});
  if (!sample) return tl::unexpected<Error>(sample.error());
  // Coarser and noisier: where a default differs, the part decides.
  const Result<Document> other = sample_document({.edge_length = 2.1, .noise = 0.6, .seed = 2});
  if (!other) return tl::unexpected<Error>(other.error());
  std::vector<OperationManual> operations;
  for (const OperationKind& kind : operation_table()) {
    OperationManual operation{&kind, parameters_of(kind, *sample)};
    const std::vector<ParameterManual> others = parameters_of(kind, *other);
    for (ParameterManual& parameter : operation.parameters) {
      const auto same = std::find_if(others.begin(), others.end(), [&](const ParameterManual& p) {
        return p.name == parameter.name;
      });
      if (same == others.end()) continue;
      parameter.depends_on_part = same->otherwise != parameter.otherwise;
      parameter.range_depends_on_part = same->expected != parameter.expected;
    }
    operations.push_back(std::move(operation));
  }
  return operations;
}

void add_operations(ManualPage& page, const std::vector<OperationManual>& operations) {
  for (const OperationManual& operation : operations) {
    page.subsection(operation.kind->name);
    page.paragraph(std::string(operation.kind->title) + " (version " +
                   std::to_string(operation.kind->version) + ")." +
                   (operation.parameters.empty() ? " It takes no parameter." : ""));
    for (const ParameterManual& parameter : operation.parameters)
      page.entry(parameter.name, sentence_of(parameter));
  }
}

}  // namespace arris
