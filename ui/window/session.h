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

#include "core/document/history.h"
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
  /// Opens a scan, or replays a session (*.jsonl), in a history of its own. The open part stays
  /// until the new one is there.
  void open(const QString& path);
  /// The same, for a file that `make` writes first (on the worker thread).
  void open_made(const QString& path, std::function<Result<void>()> make);
  /// Goes on with the journal that a crash left behind (see abandoned_journals()).
  void recover(const QString& journal);
  /// Journals of sessions that ended without being closed, newest first.
  static QStringList abandoned_journals();
  static void discard_journal(const QString& journal);
  /// True where there are edits that were not written to a session file or results folder.
  bool has_unsaved_edits() const;
  void mark_saved() {
    saved_head_ = history_.head();
    saved_names_ = history_.names();
  }
  /// Removes the journal: the session was closed on purpose.
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
  /// Another document is current, or shown. `other_mesh`: its mesh is another one than before.
  void changed(bool other_mesh);
  /// A file was opened (after changed()).
  void opened();
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
  void open_scan(const QString& path, std::function<Result<void>()> make);
  void open_journal(const QString& path, bool go_on);
  /// From here on every edit is on disk before its result is shown.
  void start_journal(const QString& path);
  /// The history of another part from here on, journalled to `journal` (empty: a new file).
  void take_over(History history, const QString& journal);
  Context context_of_work();
  void show(ShownDocument wanted);

  History history_;
  std::unique_ptr<QLockFile> journal_lock_;  // tells other windows that the journal is in use
  QString journal_path_;
  std::uint32_t saved_head_ = 0;
  std::map<std::uint32_t, std::string> saved_names_;
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
