#include "ui/window/session.h"

#include <atomic>
#include <chrono>
#include <utility>

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QStandardPaths>

#include "core/base/vector_state.h"
#include "core/base/write_file.h"
#include "core/document/journal.h"

namespace arris::ui {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ShownDocument shown_document(Document document) {
  ShownDocument shown{std::move(document), {}};
  if (!shown.document.empty()) shown.boundaries = *shown.document.boundaries;
  return shown;
}

}  // namespace

Session::Session(QObject* parent) : QObject(parent) {}

Session::~Session() { stop_.request_stop(); }

double Session::seconds_of(const std::string& operation) const {
  for (const auto& [name, seconds] : seconds_)
    if (name == operation) return seconds;
  return 0.0;
}

nlohmann::json Session::parameters(const std::string& step) const {
  const Document& document = shown().document;
  const std::optional<Step>& run = document.step(step);
  return run ? run->parameters : current_parameters(step);
}

nlohmann::json Session::current_parameters(const std::string& step) const {
  const Document& document = current_.document;
  const std::optional<Step>& run = document.step(step);
  if (run) return run->parameters;
  if (document.empty()) return nlohmann::json::object();
  const auto known = defaults_.find(step);
  if (known != defaults_.end()) return known->second;
  nlohmann::json parameters = nlohmann::json::object();
  if (const Result<Operation> resolved = resolve(document, {step, parameters})) {
    parameters = resolved->parameters;
    parameters.erase("version");
  }
  return defaults_[step] = parameters;
}

Context Session::context_of_work() {
  const auto told = std::make_shared<std::atomic<Clock::rep>>(0);
  return Context(
      [this, told](double fraction, std::string_view what) {
        // Told often enough to be seen; each time costs drawing.
        constexpr Clock::duration least = std::chrono::milliseconds(100);
        const Clock::rep now = Clock::now().time_since_epoch().count();
        Clock::rep before = told->load();
        if (now - before < least.count() || !told->compare_exchange_strong(before, now)) return;
        const QString text = QString::fromUtf8(what.data(), static_cast<qsizetype>(what.size()));
        worker_.tell([this, fraction, text] { emit progress(fraction, text); });
      },
      stop_.get_token());
}

template <class Work, class Finish>
void Session::work_aside(Work work, Finish finish) {
  worker_.start([this, work = std::move(work), finish = std::move(finish)] {
    const auto result = std::make_shared<decltype(work())>(work());
    worker_.tell([result, finish] { finish(std::move(*result)); });
  });
}

template <class Work, class Finish>
void Session::start_work(Work work, Finish finish) {
  ++works_;
  if (!busy_) {
    busy_ = true;
    stop_ = std::stop_source();
    emit busy_changed(true);
  }
  work_aside([work = std::move(work), context = context_of_work()] { return work(context); },
             [this, finish = std::move(finish)](auto result) {
               --works_;
               finish(std::move(result));
               if (busy_ && works_ == 0) finish_work();
             });
}

Session::Outcome Session::outcome_of(const Document& base, const Operation& operation,
                                     const Context& context) {
  const auto begin = Clock::now();
  Outcome outcome{perform(base, operation, context), {}, 0.0};
  if (outcome.performed) outcome.shown = shown_document(outcome.performed->document);
  outcome.seconds = seconds_since(begin);
  return outcome;
}

std::optional<Error> Session::commit(Outcome outcome) {
  if (!outcome.performed) return outcome.performed.error();
  const std::string name = outcome.performed->operation.name;
  const Result<void> committed = history_.commit(std::move(outcome.performed->operation),
                                                 std::move(outcome.performed->document));
  if (!committed) return committed.error();
  std::erase_if(seconds_, [&](const auto& entry) { return entry.first == name; });
  seconds_.emplace_back(name, outcome.seconds);
  show(std::move(outcome.shown));
  return std::nullopt;
}

void Session::tell(const Error& error) {
  if (!error.cancelled) emit failed(QString::fromStdString(error.message));
}

void Session::show(ShownDocument wanted) {
  const MeshPtr before = shown().document.mesh;
  current_ = std::move(wanted);
  defaults_.clear();
  previewed_ = nullptr;
  emit changed(before != current_.document.mesh);
}

void Session::finish_work() {
  busy_ = false;
  travelling_ = false;
  const int steps = std::exchange(steps_to_go_, 0);
  emit busy_changed(false);
  if (steps != 0 && !busy_) {
    steps < 0 ? undo() : redo();
    if (travelling_) steps_to_go_ = steps < 0 ? steps + 1 : steps - 1;
  }
  if (wanted_preview_) start_preview();
}

void Session::open(const QString& path) {
  if (path.endsWith(".jsonl", Qt::CaseInsensitive))
    open_journal(path, false);
  else
    open_scan(path, nullptr);
}

void Session::open_made(const QString& path, std::function<Result<void>()> make) {
  open_scan(path, std::move(make));
}

void Session::recover(const QString& journal) { open_journal(journal, true); }

void Session::open_journal(const QString& path, bool go_on) {
  if (busy_) return;
  cancel_preview();
  start_work(
      [path](const Context& context) {
        Result<Replay> replayed = replay(path.toStdString(), {}, context);
        ShownDocument shown;
        if (replayed) shown = shown_document(replayed->history.current());
        return std::pair(std::move(replayed), std::move(shown));
      },
      [this, path, go_on](std::pair<Result<Replay>, ShownDocument> opened_part) {
        auto& [replayed, shown] = opened_part;
        if (!replayed) return tell(replayed.error());
        take_over(std::move(replayed->history), go_on ? path : QString());
        mark_saved();
        if (go_on) saved_head_ = 0;
        show(std::move(shown));
        for (const auto* step :
             {&current_.document.find_sharp_lines, &current_.document.find_partitions})
          if (*step && !(*step)->parameters.value("corrections", true))
            applies_corrections_ = false;
        emit opened();
        for (const std::string& warning : replayed->warnings)
          emit failed(QString::fromStdString(warning));
      });
}

void Session::take_over(History history, const QString& journal) {
  close();
  history_ = std::move(history);
  start_journal(journal);
  seconds_.clear();
  applies_corrections_ = true;
}

namespace {

QString journal_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/sessions";
}

QString lock_of(const QString& journal) { return journal + ".lock"; }

}  // namespace

void Session::start_journal(const QString& path) {
  journal_path_ = path;
  if (path.isEmpty()) {
    QDir().mkpath(journal_folder());
    const QString name = QDateTime::currentDateTimeUtc().toString("yyyyMMdd-hhmmsszzz") + "-" +
                         QString::number(QCoreApplication::applicationPid());
    journal_path_ = journal_folder() + "/" + name + ".jsonl";
  }
  journal_lock_ = std::make_unique<QLockFile>(lock_of(journal_path_));
  journal_lock_->setStaleLockTime(0);
  journal_lock_->tryLock(0);
  const std::string file = journal_path_.toStdString();
  // Rows of before, whole and without what a crash cut short.
  Result<void> written = write_file_whole(file, journal_text(history_));
  if (written) {
    Result<std::shared_ptr<Journal>> journal = Journal::open(file);
    if (journal)
      history_.set_journal(std::move(*journal));
    else
      written = tl::unexpected<Error>(journal.error());
  }
  if (!written)
    emit failed(tr("This session cannot be recovered after a crash: %1")
                    .arg(QString::fromStdString(written.error().message)));
}

QStringList Session::abandoned_journals() {
  QStringList found;
  const QDir folder(journal_folder());
  for (const QString& name :
       folder.entryList({"*.jsonl"}, QDir::Files, QDir::Name | QDir::Reversed)) {
    const QString path = folder.filePath(name);
    QLockFile lock(lock_of(path));
    lock.setStaleLockTime(0);
    if (!lock.tryLock(0)) continue;  // another window works on it
    lock.unlock();
    found << path;
  }
  return found;
}

void Session::discard_journal(const QString& journal) { QFile::remove(journal); }

bool Session::has_unsaved_edits() const {
  const bool edited =
      history_.entries().size() > 1 && history_.head() > 1 && history_.head() != saved_head_;
  return edited || history_.names() != saved_names_;
}

void Session::close() {
  history_.set_journal(nullptr);
  if (!journal_path_.isEmpty()) QFile::remove(journal_path_);
  journal_path_.clear();
  journal_lock_.reset();
}

void Session::open_scan(const QString& path, std::function<Result<void>()> make) {
  if (busy_) return;
  cancel_preview();
  start_work(
      [operation = Operation{"open", {{"file", path.toStdString()}}},
       make = std::move(make)](const Context& context) -> Outcome {
        const auto begin = Clock::now();
        const Result<void> made = make ? make() : Result<void>();
        if (!made) return {tl::unexpected<Error>(made.error()), {}, 0.0};
        Outcome outcome = outcome_of(Document{}, operation, context);
        outcome.seconds = seconds_since(begin);
        return outcome;
      },
      [this](Outcome outcome) {
        if (!outcome.performed) return tell(outcome.performed.error());
        History history;
        const Result<void> committed = history.commit(std::move(outcome.performed->operation),
                                                      std::move(outcome.performed->document));
        if (!committed) return tell(committed.error());
        take_over(std::move(history), {});
        saved_head_ = 0;
        saved_names_.clear();
        seconds_ = {{"open", outcome.seconds}};
        show(std::move(outcome.shown));
        emit opened();
        emit done("open");
      });
}

Operation Session::as_wanted(Operation operation) const {
  if (operation.name == "find_sharp_lines" || operation.name == "find_partitions")
    operation.parameters["corrections"] = applies_corrections_;
  return operation;
}

void Session::run(std::vector<Operation> operations) {
  if (busy_ || operations.empty()) return;
  cancel_preview();
  queue_.clear();
  for (Operation& operation : operations) queue_.push_back(as_wanted(std::move(operation)));
  run_next();
}

void Session::run_next() {
  const Operation operation = queue_.front();
  queue_.erase(queue_.begin());
  start_work([operation, base = current_.document](
                 const Context& context) { return outcome_of(base, operation, context); },
             [this, name = operation.name](Outcome outcome) {
               if (const std::optional<Error> error = commit(std::move(outcome))) {
                 queue_.clear();
                 tell(*error);
               } else {
                 emit done(QString::fromStdString(name));
               }
               if (!queue_.empty()) run_next();
             });
}

void Session::travel(std::uint32_t sequence) {
  if (busy_ || sequence == history_.head()) return;
  cancel_preview();
  travelling_ = true;
  start_work(
      [this, sequence](const Context& context) {  // usually there at once
        Result<Document> found = history_.document_at(sequence, context);
        return found ? Result<ShownDocument>(shown_document(std::move(*found)))
                     : Result<ShownDocument>(tl::unexpected<Error>(found.error()));
      },
      [this, sequence](Result<ShownDocument> found) {
        if (!found) return tell(found.error());
        if (const auto gone = history_.go_to(sequence, found->document); !gone)
          return tell(gone.error());
        show(std::move(*found));
      });
}

void Session::fetch(std::uint32_t sequence, std::function<void(Document)> take) {
  if (busy_) return;
  if (sequence == history_.head()) return take(history_.current());
  start_work(
      [this, sequence](const Context& context) { return history_.document_at(sequence, context); },
      [this, take = std::move(take)](Result<Document> found) {
        finish_work();  // what is taken may lead to more work
        if (found)
          take(std::move(*found));
        else
          tell(found.error());
      });
}

bool Session::name_version(std::uint32_t sequence, const QString& name) {
  if (busy_) return false;
  const Result<void> named = history_.set_name(sequence, name.toStdString());
  if (!named) {
    emit failed(QString::fromStdString(named.error().message));
    return false;
  }
  emit names_changed();
  return true;
}

void Session::undo() {
  if (travelling_) --steps_to_go_;
  if (!busy_ && history_.can_undo()) travel(history_.entries()[history_.head() - 1].parent);
}

void Session::redo() {
  if (travelling_) ++steps_to_go_;
  if (busy_ || !history_.can_redo()) return;
  const std::vector<std::uint32_t> rows = history_.line_of_travel();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool next = history_.head() == 0 ? k == 0 : k > 0 && rows[k - 1] == history_.head();
    if (next) return travel(rows[k]);
  }
}

void Session::cancel() {
  queue_.clear();
  steps_to_go_ = 0;
  stop_.request_stop();
}

void Session::preview(const Operation& operation) {
  wanted_preview_ = as_wanted(operation);
  if (!busy_ && !preview_running_) start_preview();
}

void Session::start_preview() {
  const Operation operation = *wanted_preview_;
  wanted_preview_.reset();
  preview_running_ = true;
  work_aside([operation, base = current_.document] { return outcome_of(base, operation, {}); },
             [this, operation, round = preview_round_](Outcome outcome) {
               preview_running_ = false;
               if (round == preview_round_ && outcome.performed) {
                 const MeshPtr before = shown().document.mesh;
                 previewed_ = std::make_shared<const ShownDocument>(std::move(outcome.shown));
                 preview_result_ = PreviewResult{operation, std::move(*outcome.performed)};
                 emit changed(before != shown().document.mesh);
               } else if (round == preview_round_ && !wanted_preview_) {
                 drop_preview();
                 emit preview_refused(QString::fromStdString(outcome.performed.error().message));
               }
               if (wanted_preview_ && !busy_) start_preview();
             });
}

void Session::commit_preview(const Operation& given) {
  if (busy_) return;
  const Operation operation = as_wanted(given);
  if (!preview_result_ || !previewed_ || preview_result_->wanted != operation) {
    wanted_preview_.reset();
    ++preview_round_;
    // The picture stays the preview's until the result is there.
    queue_ = {operation};
    run_next();
    return;
  }
  const std::shared_ptr<const ShownDocument> previewed = previewed_;
  const std::string name = preview_result_->performed.operation.name;
  const Result<void> committed = history_.commit(std::move(preview_result_->performed.operation),
                                                 std::move(preview_result_->performed.document));
  wanted_preview_.reset();
  preview_result_.reset();
  ++preview_round_;
  if (!committed) {
    cancel_preview();
    emit failed(QString::fromStdString(committed.error().message));
    return;
  }
  show(*previewed);
  emit done(QString::fromStdString(name));
}

void Session::cancel_preview() {
  const bool any = wanted_preview_ || preview_running_ || previewed_;
  drop_preview();
  if (any) emit preview_cancelled();
}

void Session::drop_preview() {
  wanted_preview_.reset();
  preview_result_.reset();
  ++preview_round_;
  if (!previewed_) return;
  const MeshPtr before = previewed_->document.mesh;
  previewed_ = nullptr;
  emit changed(before != current_.document.mesh);
}

}  // namespace arris::ui
