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
#include "core/document/journal.h"
#include "core/mesh/write_ply.h"

namespace arris::ui {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Snapshot snapshot_of(Document document) {
  Snapshot snapshot{std::move(document), {}};
  if (!snapshot.document.empty()) snapshot.boundaries = *snapshot.document.boundaries;
  return snapshot;
}

}  // namespace

Session::Session(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }

Session::~Session() {
  stop_.request_stop();
  pool_.waitForDone();
}

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
        QMetaObject::invokeMethod(this, [this, fraction, text] { emit progress(fraction, text); });
      },
      stop_.get_token());
}

void Session::start(std::function<void()> work) {
  pool_.start([work = std::move(work)] {
    clear_vector_state();
    work();
  });
}

void Session::show(Snapshot snapshot) {
  const MeshPtr before = shown().document.mesh;
  current_ = std::move(snapshot);
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
  busy_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  start([this, path, go_on, context = context_of_work()] {
    auto replayed = std::make_shared<Result<Replay>>(replay(path.toStdString(), {}, context));
    auto snapshot = std::make_shared<Snapshot>();
    if (*replayed) *snapshot = snapshot_of((*replayed)->history.current());
    QMetaObject::invokeMethod(this, [this, path, go_on, replayed, snapshot] {
      if (*replayed) {
        close();
        history_ = std::move((*replayed)->history);
        start_journal(go_on ? path : QString());
        mark_saved();
        if (go_on) saved_head_ = 0;
        seconds_.clear();
        show(std::move(*snapshot));
        applies_corrections_ = true;
        for (const auto* step :
             {&current_.document.find_sharp_lines, &current_.document.find_partitions})
          if (*step && !(*step)->parameters.value("corrections", true))
            applies_corrections_ = false;
        emit opened();
        for (const std::string& warning : (*replayed)->warnings)
          emit failed(QString::fromStdString(warning));
      } else if (!replayed->error().cancelled) {
        emit failed(QString::fromStdString(replayed->error().message));
      }
      finish_work();
    });
  });
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
  busy_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  const Operation operation{"open", {{"file", path.toStdString()}}};
  start([this, operation, make = std::move(make), context = context_of_work()] {
    const auto begin = Clock::now();
    const Result<void> made = make ? make() : Result<void>();
    auto performed = std::make_shared<Result<Performed>>(
        made ? perform(Document{}, operation, context)
             : Result<Performed>(tl::unexpected<Error>(made.error())));
    auto snapshot = std::make_shared<Snapshot>();
    if (*performed) *snapshot = snapshot_of((*performed)->document);
    const double seconds = seconds_since(begin);
    QMetaObject::invokeMethod(this, [this, performed, snapshot, seconds] {
      if (!*performed) {
        if (!performed->error().cancelled)
          emit failed(QString::fromStdString(performed->error().message));
      } else {
        History history;
        const Result<void> committed =
            history.commit(std::move((*performed)->operation), std::move((*performed)->document));
        if (committed) {
          close();
          history_ = std::move(history);
          start_journal({});
          saved_head_ = 0;
          saved_names_.clear();
          seconds_ = {{"open", seconds}};
          show(std::move(*snapshot));
          applies_corrections_ = true;
          emit opened();
          emit done("open");
        } else {
          emit failed(QString::fromStdString(committed.error().message));
        }
      }
      finish_work();
    });
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
  busy_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  run_next();
}

void Session::run_next() {
  const Operation operation = queue_.front();
  queue_.erase(queue_.begin());
  start([this, operation, base = current_.document, context = context_of_work()] {
    const auto begin = Clock::now();
    auto performed = std::make_shared<Result<Performed>>(perform(base, operation, context));
    auto snapshot = std::make_shared<Snapshot>();
    if (*performed) *snapshot = snapshot_of((*performed)->document);
    const double seconds = seconds_since(begin);
    QMetaObject::invokeMethod(this, [this, performed, snapshot, seconds] {
      Result<void> committed;
      if (*performed) {
        const std::string name = (*performed)->operation.name;
        committed =
            history_.commit(std::move((*performed)->operation), std::move((*performed)->document));
        if (committed) {
          std::erase_if(seconds_, [&](const auto& entry) { return entry.first == name; });
          seconds_.emplace_back(name, seconds);
          show(std::move(*snapshot));
          emit done(QString::fromStdString(name));
        }
      }
      const Error* error = !*performed  ? &performed->error()
                           : !committed ? &committed.error()
                                        : nullptr;
      if (error) queue_.clear();
      if (error && !error->cancelled) emit failed(QString::fromStdString(error->message));
      if (!queue_.empty())
        run_next();
      else
        finish_work();
    });
  });
}

void Session::travel(std::uint32_t sequence) {
  if (busy_ || sequence == history_.head()) return;
  cancel_preview();
  busy_ = true;
  travelling_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  // The history is the worker's until it answers; usually that is at once.
  start([this, sequence, context = context_of_work()] {
    auto travelled = std::make_shared<Result<void>>(history_.travel(sequence, context));
    auto snapshot = std::make_shared<Snapshot>();
    if (*travelled) *snapshot = snapshot_of(history_.current());
    QMetaObject::invokeMethod(this, [this, travelled, snapshot] {
      if (*travelled)
        show(std::move(*snapshot));
      else if (!travelled->error().cancelled)
        emit failed(QString::fromStdString(travelled->error().message));
      finish_work();
    });
  });
}

void Session::fetch(std::uint32_t sequence, std::function<void(Document)> take) {
  if (busy_) return;
  if (sequence == history_.head()) return take(history_.current());
  busy_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  start([this, sequence, take = std::move(take), context = context_of_work()] {
    auto found = std::make_shared<Result<Document>>(history_.document_at(sequence, context));
    QMetaObject::invokeMethod(this, [this, take, found] {
      finish_work();
      if (*found)
        take(std::move(**found));
      else if (!found->error().cancelled)
        emit failed(QString::fromStdString(found->error().message));
    });
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
  start([this, operation, base = current_.document, round = preview_round_] {
    auto performed = std::make_shared<Result<Performed>>(perform(base, operation));
    auto snapshot = std::make_shared<Snapshot>();
    if (*performed) *snapshot = snapshot_of((*performed)->document);
    QMetaObject::invokeMethod(this, [this, operation, performed, snapshot, round] {
      preview_running_ = false;
      if (round == preview_round_ && *performed) {
        const MeshPtr before = shown().document.mesh;
        previewed_ = snapshot;
        preview_result_ = PreviewResult{operation, std::move(**performed)};
        emit changed(before != snapshot->document.mesh);
      } else if (round == preview_round_ && !wanted_preview_) {
        const QString why = QString::fromStdString(performed->error().message);
        drop_preview();
        emit preview_refused(why);
      }
      if (wanted_preview_ && !busy_) start_preview();
    });
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
    busy_ = true;
    stop_ = std::stop_source();
    emit busy_changed(true);
    run_next();
    return;
  }
  const std::shared_ptr<const Snapshot> snapshot = previewed_;
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
  show(*snapshot);
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
