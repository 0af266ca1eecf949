#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QStringList>

#include "core/base/file_lock.h"
#include "core/document/history.h"
#include "core/document/session_file.h"
#include "core/partitions/boundaries.h"
#include "ui/window/worker.h"

namespace arris::ui {

/// A document with the boundaries derived from it, as the window shows it.
struct ShownDocument {
  Document document;
  Boundaries boundaries;
};

/// The open part: its history, and the work on it, which runs on a thread of its own. All calls and
/// all signals are on the UI thread, and so is every change of the history: the worker only makes
/// documents.
///
/// A saved session is a document as in any other program: save() writes the file whole, and it
/// stays as it is until the next save(). What is done between goes, row by row and durable, to a
/// recovery session in the user's state folder, which a crash leaves behind and closing removes. So
/// a file never holds what nobody saved, can lie on any disk, and can be put back by not saving.
class Session : public QObject {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);
  ~Session() override;

  /// What is to be shown: the preview while there is one, else the current document.
  const ShownDocument& shown() const { return previewed_ ? *previewed_ : current_; }
  const ShownDocument& current() const { return current_; }
  bool is_previewing() const { return previewed_ != nullptr; }
  const History& history() const { return history_; }
  /// Seconds the last run of an operation took here; 0: not run in this window.
  double seconds_of(const std::string& operation) const;

  /// Parameters of a step as last run in the document shown, or in the current one; else as they
  /// would be by default. An empty object where there is no part.
  nlohmann::json parameters(const std::string& step) const;
  nlohmann::json current_parameters(const std::string& step) const;

  /// Whether finding lines or partitions does the corrections again, from now on. At first as the
  /// part was last run.
  bool applies_corrections() const { return applies_corrections_; }
  void set_applies_corrections(bool applies) { applies_corrections_ = applies; }

  bool busy() const { return busy_; }
  /// Whether the work is going to another row of the history: undo() and redo() are taken then, and
  /// done one after the other.
  bool travelling() const { return travelling_; }
  /// Opens a scan or a session (its content decides) in a history of its own. The open part stays
  /// until the new one is there. `located`: files pointed at, for scans that a session names and
  /// that are not where they were (scan_lost()). A session that another window has open is opened
  /// read-only.
  void open(const QString& path, const QStringList& located = {});
  /// The same, for a file that `make` writes first (on the worker thread).
  void open_made(const QString& path, std::function<Result<void>()> make);
  /// The file of the session, to which it is saved; empty where it was never saved.
  const QString& file() const { return file_; }
  /// Another window has the session open: what is done here can be saved under another name only.
  bool is_read_only() const { return read_only_; }
  /// The name of the part: that of its scan's file.
  QString part_name() const;
  /// What the session that was opened holds beside its history.
  const SessionExtras& extras() const { return extras_; }
  /// Writes the session as it is now to a file, which is its file from then on; on the worker
  /// thread, while this one goes on. `then` hears on this thread how it went. Errors: cannot be
  /// written, another window has that file open, work is running; the session is as it was then.
  void save(const QString& path, const SessionExtras& extras,
            std::function<void(const Result<void>&)> then);
  bool saving() const { return saves_ > 0; }
  /// Returns once nothing is being saved any more. The window is drawn meanwhile, and takes no
  /// input but that of a question that saving leads to.
  void wait_until_saved();
  /// Keeps how the part is looked at by now in the recovery session, for after a crash.
  void keep_view(const std::string& view);

  /// What the session keeps beside its history was changed by the user, as its named views.
  void edit_extras();

  /// Goes on with a session that a crash left behind (see abandoned_sessions()).
  void recover(const QString& recovery, const QStringList& located = {});
  /// Recovery sessions that ended without being closed, newest first.
  static QStringList abandoned_sessions();
  /// The name of the part of such a session; empty where it cannot be told.
  static QString part_of(const QString& recovery);
  static void discard(const QString& recovery);
  /// True where there are edits that were not saved.
  bool has_unsaved_edits() const;
  void mark_saved() {
    saved_head_ = history_.head();
    saved_names_ = history_.names();
    saved_extras_ = edited_extras_;
    emit saved();
  }
  /// Removes the recovery session: this one was closed on purpose.
  void close();
  /// Runs operations one after the other, each a history entry; stops at the first that fails.
  void run(std::vector<Operation> operations);
  void undo();
  void redo();
  void travel(std::uint32_t sequence);
  /// Gives the document after a row to `take`, without going there; at once where its snapshot is
  /// kept, else once it was made again.
  void fetch(std::uint32_t sequence, std::function<void(Document)> take);
  /// Names a version, or takes its name away (History::set_name()). Errors are told, and returned
  /// as false.
  bool name_version(std::uint32_t sequence, const QString& name);
  /// Asks the running work to stop; nothing of it is kept.
  void cancel();

  /// Live tuning: shows what the operation would give, on the current document. The latest wins;
  /// nothing is journalled.
  void preview(const Operation& operation);
  /// Lets go: commits the operation as one history entry.
  void commit_preview(const Operation& given);
  void cancel_preview();

 signals:
  /// Another document is current, or shown: who holds its mesh takes it first, where that is
  /// another one than before, then who colours it, then who shows what is on it.
  void mesh_changed();
  void surface_changed();
  void changed(bool other_mesh);
  /// A file was opened (after changed()).
  void opened();
  /// `session` was not opened: the scan that it was made on is nowhere to be found. Whoever knows
  /// where it is opens the session again and says so.
  void scan_lost(const QString& session, const QString& scan);
  /// All edits are in the file now, or need not be.
  void saved();
  void busy_changed(bool busy);
  void progress(double fraction, const QString& what);
  /// The preview was taken back by something else than its commit.
  void preview_cancelled();
  /// There is no preview: the operation would fail, and why.
  void preview_refused(const QString& why);
  /// A version was named, or lost its name.
  void names_changed();
  /// An operation went through: its name.
  void done(const QString& operation);
  void failed(const QString& message);

 private:
  void tell_changed(bool other_mesh);
  /// As it is to be run: finding does corrections again, or not.
  Operation as_wanted(Operation operation) const;
  /// What an operation gave.
  struct Outcome {
    Result<Performed> performed;
    ShownDocument shown;  ///< Where it was performed.
    double seconds = 0.0;
  };
  static Outcome outcome_of(const Document& base, const Operation& operation,
                            const Context& context);

  /// `work`() runs on the worker thread, then `finish`(its result) on the UI thread.
  template <class Work, class Finish>
  void work_aside(Work work, Finish finish);
  /// The same with `work`(context), and the session busy from now until `finish` returns, or until
  /// the end of the work that `finish` starts.
  template <class Work, class Finish>
  void start_work(Work work, Finish finish);
  void finish_work();
  /// Makes a history entry of it and shows it. The error where that fails, or where it is one.
  std::optional<Error> commit(Outcome outcome);
  void tell(const Error& error);
  void run_next();
  void start_preview();
  void drop_preview();
  /// Where every edit goes before its result is shown.
  struct Recovery {
    QString path;
    std::unique_ptr<QLockFile> lock;  // tells other windows that it is in use
    std::shared_ptr<SessionFile> file;
  };
  static Result<Recovery> start_recovery(const History& history, const SessionExtras& extras,
                                         const Context& context);
  /// What opening a file gives, made on the worker thread.
  struct Opened {
    History history;
    ShownDocument shown;
    SessionExtras extras;
    std::vector<std::string> warnings;
    Recovery recovery;
    std::optional<Error> no_recovery;  // why there is none
    QString file;
    std::unique_ptr<FileLock> lock;
    bool read_only = false;
    bool unsaved = false;
    double seconds = 0.0;
  };
  void open_scan(const QString& path, std::function<Result<void>()> make);
  void open_session(const QString& path, const QStringList& located);
  static Result<Opened> replayed(const QString& path, const QStringList& located,
                                 const Context& context);
  /// Keeps what was opened safe from here on.
  static void keep(Opened& opened, const Context& context);
  void take_saved(const std::string& file, const History& saved, SessionExtras extras,
                  std::uint64_t edited_extras);
  void set_recovery(Recovery recovery);
  void take_over(Opened opened);
  /// Tells why a session was not opened.
  void tell(const Error& error, const QString& session, const QStringList& located);
  Context context_of_work();
  void show(ShownDocument wanted);

  History history_;
  Recovery recovery_;
  QString file_;
  std::unique_ptr<FileLock> file_lock_;
  bool read_only_ = false;
  SessionExtras extras_;
  int saves_ = 0;            // that are not done
  std::uint64_t round_ = 0;  // of the session: what was saved of one before is not of this one
  std::string kept_view_;
  std::uint32_t saved_head_ = 0;
  std::map<std::uint32_t, std::string> saved_names_;
  std::uint64_t edited_extras_ = 0, saved_extras_ = 0;  // how often, and what of that is saved
  ShownDocument current_;
  std::shared_ptr<const ShownDocument> previewed_;
  std::vector<std::pair<std::string, double>> seconds_;
  /// Defaults of steps that the current document has not run; worked out when first asked for.
  mutable std::map<std::string, nlohmann::json> defaults_;

  bool applies_corrections_ = true;

  bool busy_ = false;
  int works_ = 0;  // begun by start_work() and not finished
  bool travelling_ = false;
  int steps_to_go_ = 0;  // asked for while travelling: back where negative
  std::stop_source stop_;
  std::vector<Operation> queue_;  // still to run

  struct PreviewResult {
    Operation wanted;
    Performed performed;
  };
  std::optional<Operation> wanted_preview_;  // the latest, not started yet
  bool preview_running_ = false;
  std::uint64_t preview_round_ = 0;  // results of earlier rounds are stale
  std::optional<PreviewResult> preview_result_;

  Worker worker_;  // the last member: it ends before what its work may use
};

}  // namespace arris::ui
