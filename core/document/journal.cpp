#include "core/document/journal.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unordered_map>
#include <utility>

#include "core/document/document_bytes.h"
#include "core/document/perform.h"
#include "core/document/scan_places.h"
#include "core/document/session_file.h"

namespace arris {

namespace {

std::string row_text(const HistoryEntry& entry) {
  const nlohmann::json row{{"sequence", entry.sequence},
                           {"parent", entry.parent},
                           {"operation", entry.operation.to_json()},
                           {"hash", entry.hash}};
  return row.dump() + "\n";
}

std::string head_text(std::uint32_t sequence) {
  return nlohmann::json{{"head", sequence}}.dump() + "\n";
}

std::string name_text(std::uint32_t sequence, const std::string& name) {
  return nlohmann::json{{"name", name}, {"row", sequence}}.dump() + "\n";
}

/// What a file holds, and where the scans are that it names.
struct JournalContent {
  std::vector<JournalRecord> records;
  std::shared_ptr<const FileSource> files;
  std::optional<SessionSnapshot> snapshot;
  std::vector<std::string> warnings;
};

Result<JournalContent> read_text(const std::string& path, const ReplayOptions& options) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(path + " cannot be read: " + std::strerror(errno) + ".");
  JournalContent content;
  content.files = std::make_shared<const ScanPlaces>(path, options.located);
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string where = "line " + std::to_string(++number);
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    nlohmann::json json = parse_record(line);
    if (json.is_object()) {
      content.records.push_back({where, std::move(json)});
    } else if (file.eof()) {
      content.warnings.push_back(path + ", " + where +
                                 ": the last line was cut short and is left out.");
    } else {
      return fail(path + ", " + where + ": this is not a JSON object.");
    }
  }
  return content;
}

Result<JournalContent> read_content(const std::string& path, const ReplayOptions& options) {
  if (!SessionFile::is_session(path)) return read_text(path, options);
  const Result<std::shared_ptr<SessionFile>> session = SessionFile::read(path);
  if (!session) return tl::unexpected<Error>(session.error());
  Result<std::vector<JournalRecord>> records = (*session)->records();
  if (!records) return tl::unexpected<Error>(records.error());
  Result<std::optional<SessionSnapshot>> snapshot = (*session)->snapshot(options.key);
  if (!snapshot) return tl::unexpected<Error>(snapshot.error());
  if (!options.scan.empty()) snapshot->reset();  // of another scan
  return JournalContent{
      std::move(*records), SessionFile::files(*session, options.located), std::move(*snapshot), {}};
}

/// A history that stands on a snapshot, and how many records are in it already.
struct Restored {
  History history;
  std::size_t records = 0;
};

/// Nothing where the snapshot is not the document that its row says; all rows are run then. It was
/// signed here, and so were its rows: they were run once, and are not checked again.
Result<std::optional<Restored>> restore(const JournalContent& content, const Context& context) {
  const SessionSnapshot& snapshot = *content.snapshot;
  Restored restored;
  std::vector<HistoryEntry> entries;
  std::vector<History::Move> moves;
  for (; restored.records < content.records.size(); ++restored.records) {
    const nlohmann::json& json = content.records[restored.records].json;
    const auto rows = static_cast<std::uint32_t>(entries.size());
    if (json.contains("head")) {
      moves.push_back({rows, json["head"].get<std::uint32_t>()});
    } else if (json.contains("operation") && rows < snapshot.rows) {
      Result<Operation> operation = Operation::from_json(json["operation"]);
      if (!operation) return std::nullopt;
      entries.push_back({json["sequence"].get<std::uint32_t>(), json["parent"].get<std::uint32_t>(),
                         std::move(*operation), json["hash"]});
    } else {
      break;  // what follows was added later
    }
  }
  if (entries.size() != snapshot.rows || snapshot.row == 0 || snapshot.row > snapshot.rows)
    return std::nullopt;
  std::uint32_t opening = snapshot.row;
  while (opening != 0 && entries[opening - 1].operation.name != "open")
    opening = entries[opening - 1].parent < opening ? entries[opening - 1].parent : 0;
  if (opening == 0) return std::nullopt;
  const Result<Performed> opened = perform(Document{}, entries[opening - 1].operation,
                                           content.files.get(), context.part(0.0, 0.7));
  if (context.cancelled()) return cancelled();
  if (!opened) return std::nullopt;  // running the rows tells why
  std::optional<Document> document =
      document_from(snapshot.bytes, opened->document, context.part(0.7, 1.0));
  if (context.cancelled()) return cancelled();
  if (!document || hash_of(*document) != entries[snapshot.row - 1].hash) return std::nullopt;
  Result<History> history =
      History::restored(std::move(entries), moves, snapshot.row, std::move(*document));
  if (!history) return std::nullopt;
  restored.history = std::move(*history);
  restored.history.set_files(content.files);
  const std::uint32_t head =
      moves.empty() || moves.back().rows != snapshot.rows ? snapshot.rows : moves.back().head;
  if (const auto moved = restored.history.travel(head, context); !moved) {
    if (moved.error().cancelled) return cancelled();
    return std::nullopt;
  }
  return restored;
}

}  // namespace

nlohmann::json parse_record(std::string_view text) {
  constexpr int deepest = 32;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{') && ++depth > deepest)
      return nlohmann::json(nlohmann::json::value_t::discarded);
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return nlohmann::json::parse(text, nullptr, false);
}

bool holds_operations(const std::string& path) {
  if (SessionFile::is_session(path)) return true;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    std::ifstream file(path, std::ios::binary);
    char first = 0;
    if (file >> std::ws >> first) return first == '{';
  }
  return path.ends_with(".arris") || path.ends_with(".jsonl");
}

std::optional<std::string> lost_scan(const std::string& path, const ReplayOptions& options) {
  const Result<JournalContent> content = read_content(path, options);
  if (!content) return std::nullopt;
  for (const JournalRecord& record : content->records) {
    const nlohmann::json& json = record.json;
    const bool is_row = json.contains("operation") && json["operation"].is_object();
    const Result<Operation> operation = Operation::from_json(is_row ? json["operation"] : json);
    if (!operation || operation->name != "open" || !operation->parameters.contains("hash"))
      continue;
    const Result<Operation> resolved = resolve(Document{}, *operation);
    if (!resolved) continue;
    const std::string scan = opened_path(resolved->parameters);
    if (!content->files->find(scan, resolved->parameters["hash"], {})) return scan;
  }
  return std::nullopt;
}

Result<Replay> replay(const std::string& path, const ReplayOptions& options,
                      const Context& context) {
  Result<JournalContent> content = read_content(path, options);
  if (!content) return tl::unexpected<Error>(content.error());
  const std::vector<JournalRecord>& records = content->records;

  Replay result;
  result.history.set_files(content->files);
  std::unordered_map<std::uint32_t, std::uint32_t> row_of{{0, 0}};  // stored sequence to ours
  std::size_t first = 0;                                            // record to be run
  if (content->snapshot) {
    Result<std::optional<Restored>> restored = restore(*content, context);
    if (!restored) return tl::unexpected<Error>(restored.error());
    if (*restored) {
      result.history = std::move((*restored)->history);
      first = (*restored)->records;
      for (const HistoryEntry& entry : result.history.entries())
        row_of[entry.sequence] = entry.sequence;
    }
  }
  for (std::size_t k = first; k < records.size(); ++k) {
    const std::string where = path + ", " + records[k].where + ": ";
    const nlohmann::json& json = records[k].json;
    const auto to_row = [&](const char* key) -> Result<std::uint32_t> {
      if (!json[key].is_number_unsigned() || json[key].get<std::uint64_t>() > 0xFFFFFFFFu ||
          !row_of.contains(json[key].get<std::uint32_t>()))
        return fail(where + "'" + key + "' names a row that is not there.");
      return row_of.at(json[key].get<std::uint32_t>());
    };
    if (json.contains("head")) {
      const Result<std::uint32_t> row = to_row("head");
      if (!row) return tl::unexpected<Error>(row.error());
      if (const auto moved = result.history.travel(*row, context); !moved)
        return fail(where + moved.error().message);
      continue;
    }
    if (json.contains("row")) {
      const Result<std::uint32_t> row = to_row("row");
      if (!row) return tl::unexpected<Error>(row.error());
      const auto name = json.find("name");
      if (name == json.end() || !name->is_string()) return fail(where + "'name' is no text.");
      if (const auto named = result.history.set_name(*row, name->get<std::string>()); !named)
        return fail(where + named.error().message);
      continue;
    }
    const bool is_row = json.contains("sequence") && json.contains("parent") &&
                        json.contains("operation") && json["operation"].is_object();
    Result<Operation> operation = Operation::from_json(is_row ? json["operation"] : json);
    if (!operation) return fail(where + operation.error().message);
    if (is_row) {
      if (!json["sequence"].is_number_unsigned()) return fail(where + "'sequence' is no number.");
      const Result<std::uint32_t> parent = to_row("parent");
      if (!parent) return tl::unexpected<Error>(parent.error());
      if (const auto moved = result.history.travel(*parent, context); !moved)
        return fail(where + moved.error().message);
    }
    if (operation->name == "open" && !options.scan.empty()) {
      for (const char* key : {"file", "file_bytes", "hash"}) operation->parameters.erase(key);
      operation->parameters.update(open_file(options.scan).parameters);
    }
    const double step = 1.0 / static_cast<double>(records.size());
    const Context part =
        context.part(static_cast<double>(k) * step, static_cast<double>(k + 1) * step);
    const Result<void> run = result.history.run(*operation, part);
    if (!run && !run.error().nothing_to_do)
      return run.error().cancelled ? tl::unexpected<Error>(run.error())
                                   : fail(where + run.error().message);
    if (is_row) row_of[json["sequence"].get<std::uint32_t>()] = result.history.head();
    if (!run) {
      result.warnings.push_back(where + run.error().message + " Left out.");
      continue;
    }
    if (is_row) {
      const std::string& hash = result.history.entries().back().hash;
      if (options.scan.empty() && json.contains("hash") && json["hash"] != hash)
        result.warnings.push_back(
            where + "the result differs from the stored one (made by another build?).");
    }
  }
  for (std::string& warning : content->warnings) result.warnings.push_back(std::move(warning));
  if (result.history.entries().empty()) return fail(path + " holds no operation.");
  return result;
}

std::string journal_text(const History& history) {
  std::string text;
  for (const HistoryEntry& entry : history.entries()) text += row_text(entry);
  for (const auto& [sequence, name] : history.names()) text += name_text(sequence, name);
  for (const std::uint32_t head : history.closing_moves()) text += head_text(head);
  return text;
}

}  // namespace arris
