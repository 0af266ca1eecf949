#include "ui/window/session.h"

#include <atomic>
#include <chrono>
#include <utility>

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QEventLoop>
#include <QFile>
#include <QFileInfo>
#include <QRandomGenerator>
#include <QSaveFile>
#include <QStandardPaths>

#include "core/base/keyed_hash.h"
#include "core/base/vector_state.h"
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

void Session::tell_changed(bool other_mesh) {
  if (other_mesh) emit mesh_changed();
  emit surface_changed();
  emit changed(other_mesh);
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
  tell_changed(before != current_.document.mesh);
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

namespace {

QString recovery_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/sessions";
}

std::unique_ptr<QLockFile> lock_of(const QString& recovery) {
  auto lock = std::make_unique<QLockFile>(recovery + ".lock");
  lock->setStaleLockTime(0);
  return lock;
}

/// The user's own key, made when it is first wanted. Empty where it can be neither read nor kept:
/// sessions open by running their operations then.
std::string own_key() {
  QDir().mkpath(recovery_folder());
  const QString path = recovery_folder() + "/snapshot.key";
  QFile file(path);
  if (file.open(QIODevice::ReadOnly)) {
    const QByteArray kept = file.read(hash_key_size + 1);
    if (kept.size() == hash_key_size) return kept.toStdString();
    file.close();
  }
  QByteArray made(hash_key_size, Qt::Uninitialized);
  for (char& byte : made) byte = static_cast<char>(QRandomGenerator::system()->generate());
  QSaveFile kept(path);
  if (!kept.open(QIODevice::WriteOnly)) return {};
  kept.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
  kept.write(made);
  return kept.commit() ? made.toStdString() : std::string();
}

std::vector<std::string> to_std(const QStringList& texts) {
  std::vector<std::string> result;
  for (const QString& text : texts) result.push_back(text.toStdString());
  return result;
}

QString name_of_part(const Document& document) {
  return QFileInfo(QString::fromStdString(document.scan_path)).fileName();
}

}  // namespace

void Session::open(const QString& path, const QStringList& located) {
  if (holds_operations(path.toStdString()))
    open_session(path, located);
  else
    open_scan(path, nullptr);
}

void Session::open_made(const QString& path, std::function<Result<void>()> make) {
  open_scan(path, std::move(make));
}

Result<Session::Recovery> Session::start_recovery(const History& history,
                                                  const SessionExtras& extras,
                                                  const Context& context) {
  static std::atomic<unsigned> serial = 0;
  QDir().mkpath(recovery_folder());
  Recovery recovery;
  recovery.path = recovery_folder() + "/" +
                  QDateTime::currentDateTimeUtc().toString("yyyyMMdd-hhmmsszzz") + "-" +
                  QString::number(QCoreApplication::applicationPid()) + "-" +
                  QString::number(serial++) + ".arris";
  recovery.lock = lock_of(recovery.path);
  recovery.lock->tryLock(0);
  Result<std::shared_ptr<SessionFile>> file =
      SessionFile::start(recovery.path.toStdString(), history, extras, context);
  if (!file) return tl::unexpected<Error>(file.error());
  recovery.file = std::move(*file);
  return recovery;
}

void Session::keep(Opened& opened, const Context& context) {
  SessionExtras extras = opened.extras;
  extras.key = own_key();
  extras.part = name_of_part(opened.shown.document).toStdString();
  extras.saved_as = opened.read_only ? "" : opened.file.toStdString();
  Result<Recovery> recovery = start_recovery(opened.history, extras, context);
  if (recovery)
    opened.recovery = std::move(*recovery);
  else
    opened.no_recovery = recovery.error();
}

Result<Session::Opened> Session::replayed(const QString& path, const QStringList& located,
                                          const Context& context) {
  const std::string file = path.toStdString();
  Opened opened;
  Result<Replay> replayed =
      replay(file, {.located = to_std(located), .key = own_key()}, context.part(0.0, 0.9));
  if (!replayed) return tl::unexpected<Error>(replayed.error());
  opened.history = std::move(replayed->history);
  opened.warnings = std::move(replayed->warnings);
  opened.shown = shown_document(opened.history.current());
  if (SessionFile::is_session(file)) {
    const auto session = SessionFile::read(file);
    const Result<SessionExtras> extras =
        session ? (*session)->extras() : tl::unexpected<Error>(session.error());
    if (!extras) return tl::unexpected<Error>(extras.error());
    opened.extras = *extras;
  }
  return opened;
}

void Session::tell(const Error& error, const QString& session, const QStringList& located) {
  std::optional<std::string> lost;
  if (!error.cancelled) lost = lost_scan(session.toStdString(), {.located = to_std(located)});
  if (lost)
    emit scan_lost(session, QString::fromStdString(*lost));
  else
    tell(error);
}

void Session::open_session(const QString& path, const QStringList& located) {
  if (busy_) return;
  cancel_preview();
  // The file that is open here already is opened again, not by another window.
  const auto own = std::make_shared<std::unique_ptr<FileLock>>();
  if (QFileInfo(path).absoluteFilePath() == file_) *own = std::move(file_lock_);
  start_work(
      [path, located, own](const Context& context) {
        // The lock comes first, so that no other window saves between reading and locking.
        const std::string file = path.toStdString();
        const bool is_file = SessionFile::is_session(file);
        std::unique_ptr<FileLock> lock = *own      ? std::move(*own)
                                         : is_file ? FileLock::take(file)
                                                   : nullptr;
        Result<Opened> opened = replayed(path, located, context);
        if (!opened) {
          *own = std::move(lock);
          return opened;
        }
        if (is_file) opened->file = QFileInfo(path).absoluteFilePath();
        opened->read_only = is_file && !lock;
        opened->lock = std::move(lock);
        keep(*opened, context.part(0.9, 1.0));
        return opened;
      },
      [this, path, located, own](Result<Opened> opened) {
        if (!opened) {
          if (QFileInfo(path).absoluteFilePath() == file_) file_lock_ = std::move(*own);
          return tell(opened.error(), path, located);
        }
        take_over(std::move(*opened));
      });
}

void Session::recover(const QString& path, const QStringList& located) {
  if (busy_) return;
  cancel_preview();
  const auto lock = std::make_shared<std::unique_ptr<QLockFile>>(lock_of(path));
  if (!(*lock)->tryLock(0)) {
    emit failed(tr("Another window goes on with this session already."));
    return;
  }
  start_work(
      [path, located, lock](const Context& context) -> Result<Opened> {
        const bool is_text = !SessionFile::is_session(path.toStdString());
        std::shared_ptr<SessionFile> file;
        if (!is_text) {  // what was half written when it crashed is taken back
          auto gone_on = SessionFile::go_on(path.toStdString());
          if (!gone_on) return tl::unexpected<Error>(gone_on.error());
          file = std::move(*gone_on);
        }
        Result<Opened> opened = replayed(path, located, context);
        if (!opened) return opened;
        opened->unsaved = true;
        const std::string saved_as = std::exchange(opened->extras.saved_as, "");
        if (auto its_own = FileLock::take(saved_as); !saved_as.empty() && its_own) {
          opened->file = QString::fromStdString(saved_as);
          opened->lock = std::move(its_own);
        }
        if (is_text) {  // as older versions left it
          keep(*opened, context.part(0.9, 1.0));
          if (!opened->no_recovery) {
            (*lock)->unlock();
            QFile::remove(path);
          }
        } else {
          opened->recovery = {path, std::move(*lock), std::move(file)};
        }
        return opened;
      },
      [this, path, located](Result<Opened> opened) {
        if (!opened) return tell(opened.error(), path, located);
        take_over(std::move(*opened));
      });
}

void Session::set_recovery(Recovery recovery) {
  kept_view_.clear();
  recovery_ = std::move(recovery);
  history_.set_journal(recovery_.file);
  if (recovery_.file) history_.set_files(SessionFile::files(recovery_.file));
}

void Session::take_over(Opened opened) {
  close();
  history_ = std::move(opened.history);
  set_recovery(std::move(opened.recovery));
  file_ = opened.file;
  file_lock_ = std::move(opened.lock);
  read_only_ = opened.read_only;
  extras_ = std::move(opened.extras);
  seconds_.clear();
  if (opened.seconds > 0.0) seconds_ = {{"open", opened.seconds}};
  applies_corrections_ = true;
  saved_head_ = opened.unsaved ? 0 : history_.head();
  saved_names_ = history_.names();
  saved_extras_ = edited_extras_;
  show(std::move(opened.shown));
  for (const auto* step :
       {&current_.document.step("find_sharp_lines"), &current_.document.step("find_partitions")})
    if (*step && !(*step)->parameters.value("corrections", true)) applies_corrections_ = false;
  emit this->opened();
  if (opened.no_recovery)
    emit failed(tr("This session cannot be recovered after a crash: %1")
                    .arg(QString::fromStdString(opened.no_recovery->message)));
  for (const std::string& warning : opened.warnings) emit failed(QString::fromStdString(warning));
}

QString Session::part_name() const { return name_of_part(current_.document); }

void Session::save(const QString& path, const SessionExtras& given,
                   std::function<void(const Result<void>&)> then) {
  const std::string file = QFileInfo(path).absoluteFilePath().toStdString();
  if (busy_) return then(fail(tr("Wait until the work that runs is done.").toStdString()));
  const bool is_own = file == file_.toStdString() && !read_only_;
  if (!is_own && FileLock::is_taken(file))
    return then(
        fail(tr("%1 is open in another window. Choose another name.").arg(path).toStdString()));
  SessionExtras extras = given;
  extras.key = own_key();
  extras.part = part_name().toStdString();
  extras.saved_as.clear();
  ++saves_;
  // A copy, which shares the document: what is done from here on does not touch it.
  const auto history = std::make_shared<const History>(history_.copy_to_save());
  work_aside([file, history, extras] { return save_session(file, *history, extras); },
             [this, file, history, extras, round = round_, edited = edited_extras_,
              then = std::move(then)](const Result<void>& written) {
               --saves_;
               if (written && round == round_) take_saved(file, *history, extras, edited);
               then(written);
             });
}

void Session::take_saved(const std::string& file, const History& saved, SessionExtras extras,
                         std::uint64_t edited_extras) {
  file_ = QString::fromStdString(file);
  file_lock_ = FileLock::take(file);
  read_only_ = false;
  // A recovery session that went, or was none, begins anew. One that cannot is no fault of saving.
  extras.saved_as = file;
  if (!recovery_.file || !recovery_.file->set_saved_as(file)) {
    Result<Recovery> recovery = start_recovery(history_, extras, {});
    if (recovery) set_recovery(std::move(*recovery));
  }
  saved_head_ = saved.head();
  saved_names_ = saved.names();
  saved_extras_ = edited_extras;
  emit this->saved();
}

void Session::wait_until_saved() {
  while (saving()) {
    // A question that a failure leads to runs a loop of its own, with input.
    QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents |
                                    QEventLoop::WaitForMoreEvents);
  }
}

void Session::edit_extras() {
  ++edited_extras_;
  emit names_changed();
}

void Session::keep_view(const std::string& view) {
  if (!recovery_.file || view == kept_view_) return;
  kept_view_ = view;
  // An edit will tell what is wrong with the file; a view alone is not worth a word.
  static_cast<void>(recovery_.file->set_view(view));
}

namespace {

/// Whether all that a recovery session holds is in the file that was saved last, too.
bool is_saved(const std::string& recovery) {
  if (!SessionFile::is_session(recovery)) return false;
  const auto session = SessionFile::go_on(recovery);  // it is ours, and may be half written
  const Result<SessionExtras> extras =
      session ? (*session)->extras() : tl::unexpected<Error>(session.error());
  if (!extras || extras->saved_as.empty()) return false;
  const auto saved = SessionFile::read(extras->saved_as);
  return saved && hold_the_same(**session, **saved) == true;
}

}  // namespace

QStringList Session::abandoned_sessions() {
  QStringList found;
  const QDir folder(recovery_folder());
  for (const QString& name :
       folder.entryList({"*.arris", "*.jsonl"}, QDir::Files, QDir::Name | QDir::Reversed)) {
    const QString path = folder.filePath(name);
    const auto lock = lock_of(path);
    if (!lock->tryLock(0)) continue;  // another window works on it
    if (is_saved(path.toStdString()))
      discard(path);  // nothing would be lost: no reason to ask
    else
      found << path;
    lock->unlock();
  }
  return found;
}

QString Session::part_of(const QString& recovery) {
  const std::string path = recovery.toStdString();
  if (SessionFile::is_session(path)) {
    const auto session = SessionFile::go_on(path);  // it is ours, and may be half written
    const Result<SessionExtras> extras =
        session ? (*session)->extras() : tl::unexpected<Error>(session.error());
    return extras ? QString::fromStdString(extras->part) : QString();
  }
  QFile file(recovery);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const nlohmann::json row = parse_record(file.readLine().toStdString());
  const nlohmann::json operation =
      row.is_object() ? row.value("operation", nlohmann::json()) : nlohmann::json();
  if (!operation.is_object() || !operation.value("file", nlohmann::json()).is_string()) return {};
  return QFileInfo(QString::fromStdString(operation["file"].get<std::string>())).fileName();
}

void Session::discard(const QString& recovery) {
  QFile::remove(recovery);
  QFile::remove(recovery + "-journal");
}

bool Session::has_unsaved_edits() const {
  const bool edited =
      history_.entries().size() > 1 && history_.head() > 1 && history_.head() != saved_head_;
  return edited || history_.names() != saved_names_ || edited_extras_ != saved_extras_;
}

void Session::close() {
  ++round_;
  history_.set_journal(nullptr);
  history_.set_files(nullptr);
  recovery_.file.reset();
  if (!recovery_.path.isEmpty()) discard(recovery_.path);
  recovery_ = {};
  file_.clear();
  file_lock_.reset();
  read_only_ = false;
}

void Session::open_scan(const QString& path, std::function<Result<void>()> make) {
  if (busy_) return;
  cancel_preview();
  start_work(
      [operation = open_file(path.toStdString()),
       make = std::move(make)](const Context& context) -> Result<Opened> {
        const auto begin = Clock::now();
        const Result<void> made = make ? make() : Result<void>();
        if (!made) return tl::unexpected<Error>(made.error());
        Opened opened;
        if (const auto run = opened.history.run(operation, context.part(0.0, 0.9)); !run)
          return tl::unexpected<Error>(run.error());
        opened.shown = shown_document(opened.history.current());
        opened.seconds = seconds_since(begin);
        keep(opened, context.part(0.9, 1.0));
        return opened;
      },
      [this](Result<Opened> opened) {
        if (!opened) return tell(opened.error());
        take_over(std::move(*opened));
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
                 tell_changed(before != shown().document.mesh);
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
  tell_changed(before != current_.document.mesh);
}

}  // namespace arris::ui
