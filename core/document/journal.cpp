#include "core/document/journal.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unordered_map>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#else
#include <fcntl.h>
#include <unistd.h>
#endif

namespace arris {

namespace {

#ifdef _WIN32
int open_for_append(const char* path) {
  return _open(path, _O_CREAT | _O_APPEND | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
}
auto write_some(int file, const char* data, std::size_t size) {
  return _write(file, data, static_cast<unsigned>(size));
}
int make_durable(int file) { return _commit(file); }
long long size_of(int file) { return _filelengthi64(file); }
int cut_to(int file, long long size) { return _chsize_s(file, size); }
void close_file(int file) { _close(file); }
#else
int open_for_append(const char* path) {
  return ::open(path, O_CREAT | O_APPEND | O_WRONLY | O_CLOEXEC, 0644);
}
auto write_some(int file, const char* data, std::size_t size) { return ::write(file, data, size); }
int make_durable(int file) { return ::fsync(file); }
long long size_of(int file) { return ::lseek(file, 0, SEEK_END); }
int cut_to(int file, long long size) { return ::ftruncate(file, size); }
void close_file(int file) { ::close(file); }
#endif

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

}  // namespace

Result<std::shared_ptr<Journal>> Journal::open(const std::string& path) {
  const int file = open_for_append(path.c_str());
  if (file < 0)
    return fail("The journal " + path + " cannot be opened for writing: " + std::strerror(errno) +
                ".");
  // What is appended must not run into a last row without its end: one that a crash cut short goes
  // (it never counted), a whole one gets its end.
  if (std::filesystem::is_regular_file(path)) {
    std::ifstream before(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(before), {}};
    const std::size_t whole = text.find_last_of('\n') + 1;  // npos + 1 is 0
    const bool ends_well = whole == text.size();
    const bool mended = ends_well || (nlohmann::json::accept(text.substr(whole))
                                          ? write_some(file, "\n", 1) == 1
                                          : cut_to(file, static_cast<long long>(whole)) == 0);
    if (!mended) {
      const std::string reason = std::strerror(errno);
      close_file(file);
      return fail("The journal " + path +
                  " ends in a row cut short that cannot be mended: " + reason + ".");
    }
  }
  return std::shared_ptr<Journal>(new Journal(file, path));
}

Journal::~Journal() { close_file(file_); }

Result<void> Journal::append(const HistoryEntry& entry) { return append_line(row_text(entry)); }

Result<void> Journal::append_head(std::uint32_t sequence) {
  return append_line(head_text(sequence));
}

Result<void> Journal::append_name(std::uint32_t sequence, const std::string& name) {
  return append_line(name_text(sequence, name));
}

Result<void> Journal::append_line(const std::string& line) {
  const long long before = size_of(file_);
  std::size_t done = 0;
  while (done < line.size()) {
    const auto written = write_some(file_, line.data() + done, line.size() - done);
    if (written < 0) {
      if (errno == EINTR) continue;
      const std::string reason = std::strerror(errno);
      const bool cut = cut_to(file_, before) == 0;  // no half row for the next one to run into
      return fail(
          "The journal " + path_ + " cannot be written: " + reason +
          (cut ? ". The edit was not made." : ". The edit was not made; close the session."));
    }
    done += static_cast<std::size_t>(written);
  }
  if (make_durable(file_) != 0)
    return fail("The journal " + path_ + " cannot be made durable: " + std::strerror(errno) + ".");
  return {};
}

Result<Replay> replay(const std::string& path, const ReplayOptions& options,
                      const Context& context) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(path + " cannot be read: " + std::strerror(errno) + ".");
  std::vector<std::string> lines;
  bool ends_whole = true;
  for (std::string line; std::getline(file, line);) {
    ends_whole = !file.eof();
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(std::move(line));
  }

  Replay result;
  std::unordered_map<std::uint32_t, std::uint32_t> row_of{{0, 0}};  // stored sequence to ours
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string where = path + ", line " + std::to_string(k + 1) + ": ";
    if (lines[k].find_first_not_of(" \t") == std::string::npos) continue;
    const nlohmann::json json = nlohmann::json::parse(lines[k], nullptr, false);
    if (json.is_discarded() || !json.is_object()) {
      if (k + 1 == lines.size() && !ends_whole) {
        result.warnings.push_back(where + "the last line was cut short and is left out.");
        break;
      }
      return fail(where + "this is not a JSON object.");
    }
    const auto to_row = [&](const char* key) -> Result<std::uint32_t> {
      if (!json[key].is_number_unsigned() || json[key].get<std::uint64_t>() > 0xFFFFFFFFu ||
          !row_of.contains(json[key].get<std::uint32_t>()))
        return fail(where + "'" + key + "' names a row that is not there.");
      return row_of[json[key].get<std::uint32_t>()];
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
    const bool is_row =
        json.contains("sequence") && json.contains("parent") && json["operation"].is_object();
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
    const double step = 1.0 / static_cast<double>(lines.size());
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
  if (result.history.entries().empty()) return fail(path + " holds no operation.");
  return result;
}

std::string journal_text(const History& history) {
  std::string text;
  for (const HistoryEntry& entry : history.entries()) text += row_text(entry);
  for (const auto& [sequence, name] : history.names()) text += name_text(sequence, name);
  if (history.head() != history.entries().size()) text += head_text(history.head());
  return text;
}

}  // namespace arris
