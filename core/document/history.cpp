#include "core/document/history.h"

#include <algorithm>

#include "core/document/journal.h"
#include "core/document/parameters.h"
#include "core/document/perform.h"

namespace arris {

namespace {

tl::unexpected<Error> no_row(std::uint32_t sequence) {
  return fail("There is no step " + std::to_string(sequence) + " in the history.");
}

}  // namespace

History::History(std::size_t budget) : budget_(budget), redo_child_(1, 0) {}
History::~History() = default;
History::History(History&&) noexcept = default;
History& History::operator=(History&&) noexcept = default;

Result<History> History::restored(std::vector<HistoryEntry> entries, const std::vector<Move>& moves,
                                  std::uint32_t at, Document document) {
  History history;
  const auto no_such = [](std::uint32_t row) {
    return fail("row " + std::to_string(row) + " is not there.");
  };
  auto move = moves.begin();
  const auto make_moves = [&]() -> Result<void> {
    for (; move != moves.end() && move->rows == history.entries_.size(); ++move) {
      if (move->head > history.entries_.size()) return no_such(move->head);
      history.keep_way_back(move->head);
      history.head_ = move->head;
    }
    return {};
  };
  for (HistoryEntry& entry : entries) {
    if (const auto moved = make_moves(); !moved) return tl::unexpected<Error>(moved.error());
    const auto next = static_cast<std::uint32_t>(history.entries_.size() + 1);
    if (entry.sequence != next) return no_such(next);
    if (entry.parent >= next) return no_such(entry.parent);
    history.keep_way_back(entry.parent);
    history.redo_child_[entry.parent] = next;
    history.redo_child_.push_back(0);
    history.snapshots_.emplace_back();
    history.head_ = next;
    history.entries_.push_back(std::move(entry));
  }
  if (const auto moved = make_moves(); !moved) return tl::unexpected<Error>(moved.error());
  if (move != moves.end() || at == 0 || at > history.entries_.size()) return no_such(at);
  history.go(at, std::move(document));
  return history;
}

Result<void> History::commit(Operation operation, Document result) {
  HistoryEntry entry;
  entry.sequence = static_cast<std::uint32_t>(entries_.size() + 1);
  entry.parent = head_;
  entry.operation = std::move(operation);
  entry.hash = hash_of(result);
  if (journal_)
    if (const auto written = journal_->append(entry); !written) return written;
  redo_child_[head_] = entry.sequence;
  redo_child_.push_back(0);
  snapshots_.push_back(Snapshot{result, bytes_beyond(result, current_), ++clock_});
  head_ = entry.sequence;
  current_ = std::move(result);
  entries_.push_back(std::move(entry));
  keep_budget();
  return {};
}

Result<void> History::run(const Operation& operation, const Context& context) {
  Result<Performed> performed = perform(current_, operation, files_.get(), context);
  if (!performed) return tl::unexpected<Error>(performed.error());
  return commit(std::move(performed->operation), std::move(performed->document));
}

bool History::can_redo() const { return redo_child_[head_] != 0; }

Result<void> History::travel(std::uint32_t sequence, const Context& context) {
  if (sequence == head_) return {};
  Result<Document> document = document_at(sequence, context);
  if (!document) return tl::unexpected<Error>(document.error());
  return go_to(sequence, std::move(*document));
}

Result<void> History::go_to(std::uint32_t sequence, Document document) {
  if (sequence > entries_.size()) return no_row(sequence);
  if (sequence == head_) return {};
  if (journal_)
    if (const auto written = journal_->append_head(sequence); !written) return written;
  go(sequence, std::move(document));
  return {};
}

Result<void> History::undo(const Context& context) {
  if (!can_undo()) return fail("There is nothing to undo.");
  return travel(entries_[head_ - 1].parent, context);
}

Result<void> History::redo(const Context& context) {
  if (!can_redo()) return fail("There is nothing to redo.");
  return travel(redo_child_[head_], context);
}

std::optional<std::uint32_t> History::find_name(const std::string& name) const {
  for (const auto& [sequence, of_row] : names_)
    if (of_row == name) return sequence;
  return std::nullopt;
}

Result<void> History::set_name(std::uint32_t sequence, const std::string& name) {
  if (sequence == 0 || sequence > entries_.size()) return no_row(sequence);
  constexpr const char* blanks = " \t\r\n";
  const std::size_t begin = std::min(name.find_first_not_of(blanks), name.size());
  const std::string wanted = name.substr(begin, name.find_last_not_of(blanks) + 1 - begin);
  constexpr std::size_t longest = 80;
  const bool is_line =
      std::ranges::none_of(wanted, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (wanted.size() > longest || !is_line || !is_utf8(wanted))
    return fail("The name of a version is one line of at most " + std::to_string(longest) +
                " bytes of UTF-8.");
  const std::optional<std::uint32_t> other = find_name(wanted);
  if (other && *other != sequence)
    return fail("There is a version “" + wanted +
                "” already: " + describe(entries_[*other - 1].operation) + " (row " +
                std::to_string(*other) + "). Choose another name.");
  const auto known = names_.find(sequence);
  if ((known == names_.end() ? std::string() : known->second) == wanted) return {};
  if (journal_)
    if (const auto written = journal_->append_name(sequence, wanted); !written) return written;
  if (wanted.empty())
    names_.erase(sequence);
  else
    names_[sequence] = wanted;
  return {};
}

std::vector<std::uint32_t> History::line_of_travel() const {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t s = head_; s != 0; s = entries_[s - 1].parent) rows.push_back(s);
  std::reverse(rows.begin(), rows.end());
  for (std::uint32_t s = redo_child_[head_]; s != 0; s = redo_child_[s]) rows.push_back(s);
  return rows;
}

std::vector<std::uint32_t> History::closing_moves() const {
  std::vector<std::uint32_t> moves;
  const std::vector<std::uint32_t> line = line_of_travel();
  const auto last = static_cast<std::uint32_t>(entries_.size());
  const std::uint32_t end = line.empty() ? 0 : line.back();
  if (end != last) moves.push_back(end);
  if (head_ != end) moves.push_back(head_);
  return moves;
}

History History::copy_to_save() const {
  History copy(budget_);
  copy.entries_ = entries_;
  copy.snapshots_.resize(entries_.size());
  copy.names_ = names_;
  copy.redo_child_ = redo_child_;
  copy.current_ = current_;
  copy.head_ = head_;
  copy.files_ = files_;
  return copy;
}

void History::set_journal(std::shared_ptr<Journal> journal) { journal_ = std::move(journal); }

std::size_t History::bytes() const {
  std::size_t sum = 0;
  for (const auto& snapshot : snapshots_)
    if (snapshot) sum += snapshot->bytes;
  return sum;
}

void History::keep_way_back(std::uint32_t sequence) {
  // From the new head on, redo retraces the way back to where we came from, where it lies ahead.
  for (std::uint32_t s = head_; s != 0 && s != sequence; s = entries_[s - 1].parent)
    redo_child_[entries_[s - 1].parent] = s;
  for (std::uint32_t s = sequence; s != 0; s = entries_[s - 1].parent)
    redo_child_[entries_[s - 1].parent] = s;
}

void History::go(std::uint32_t sequence, Document document) {
  keep_way_back(sequence);
  if (sequence != 0 && !snapshots_[sequence - 1]) {
    const std::uint32_t parent = entries_[sequence - 1].parent;
    const bool known = parent != 0 && snapshots_[parent - 1];
    snapshots_[sequence - 1] = Snapshot{
        document, bytes_beyond(document, known ? snapshots_[parent - 1]->document : Document{}), 0};
  }
  if (sequence != 0) snapshots_[sequence - 1]->last_use = ++clock_;
  head_ = sequence;
  current_ = std::move(document);
  keep_budget();
}

void History::keep_budget() {
  std::size_t sum = bytes();
  while (sum > budget_) {
    std::optional<Snapshot>* oldest = nullptr;
    for (std::size_t k = 0; k < snapshots_.size(); ++k)
      if (snapshots_[k] && k + 1 != head_ &&
          (!oldest || snapshots_[k]->last_use < (*oldest)->last_use))
        oldest = &snapshots_[k];
    if (!oldest) return;
    sum -= (*oldest)->bytes;
    oldest->reset();
  }
}

Result<Document> History::document_at(std::uint32_t sequence, const Context& context) const {
  if (sequence > entries_.size()) return no_row(sequence);
  std::vector<std::uint32_t> missing;
  Document document;
  for (std::uint32_t s = sequence; s != 0; s = entries_[s - 1].parent) {
    if (s == head_ || snapshots_[s - 1]) {
      document = s == head_ ? current_ : snapshots_[s - 1]->document;
      break;
    }
    missing.push_back(s);
  }
  for (std::size_t k = missing.size(); k-- > 0;) {
    const double step = 1.0 / static_cast<double>(missing.size());
    const double done = static_cast<double>(missing.size() - 1 - k) * step;
    Result<Performed> next = perform(document, entries_[missing[k] - 1].operation, files_.get(),
                                     context.part(done, done + step));
    if (!next) return tl::unexpected<Error>(next.error());
    document = std::move(next->document);
  }
  return document;
}

}  // namespace arris
