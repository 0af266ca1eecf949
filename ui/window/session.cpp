#include "ui/window/session.h"

#include <chrono>
#include <utility>

namespace arris::ui {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Snapshot snapshot_of(Document document) {
  Snapshot snapshot{std::move(document), {}};
  if (!snapshot.document.empty())
    snapshot.boundaries = derive_boundaries(*snapshot.document.mesh, *snapshot.document.curvatures,
                                            snapshot.document.lines, snapshot.document.partitions);
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
  const std::optional<Step>& run =
      step == "find_sharp_lines" ? document.find_sharp_lines : document.find_partitions;
  return run ? run->parameters : current_parameters(step);
}

nlohmann::json Session::current_parameters(const std::string& step) const {
  const Document& document = current_.document;
  const std::optional<Step>& run =
      step == "find_sharp_lines" ? document.find_sharp_lines : document.find_partitions;
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
  return Context(
      [this](double fraction, std::string_view what) {
        const QString text = QString::fromUtf8(what.data(), static_cast<qsizetype>(what.size()));
        QMetaObject::invokeMethod(this, [this, fraction, text] { emit progress(fraction, text); });
      },
      stop_.get_token());
}

void Session::start(std::function<void()> work) { pool_.start(std::move(work)); }

void Session::show(Snapshot snapshot) {
  const MeshPtr before = shown().document.mesh;
  current_ = std::move(snapshot);
  defaults_.clear();
  previewed_ = nullptr;
  emit changed(before != current_.document.mesh);
}

void Session::finish_work() {
  busy_ = false;
  emit busy_changed(false);
  if (wanted_preview_) start_preview();
}

void Session::open(const QString& path) {
  if (busy_) return;
  cancel_preview();
  busy_ = true;
  stop_ = std::stop_source();
  emit busy_changed(true);
  const Operation operation{"open", {{"file", path.toStdString()}}};
  start([this, operation, context = context_of_work()] {
    const auto begin = Clock::now();
    auto performed = std::make_shared<Result<Performed>>(perform(Document{}, operation, context));
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
          history_ = std::move(history);
          seconds_ = {{"open", seconds}};
          show(std::move(*snapshot));
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

void Session::run(std::vector<Operation> operations) {
  if (busy_ || operations.empty()) return;
  cancel_preview();
  queue_ = std::move(operations);
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

void Session::undo() {
  if (!busy_ && history_.can_undo()) travel(history_.entries()[history_.head() - 1].parent);
}

void Session::redo() {
  if (busy_ || !history_.can_redo()) return;
  const std::vector<std::uint32_t> rows = history_.line_of_travel();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool next = history_.head() == 0 ? k == 0 : k > 0 && rows[k - 1] == history_.head();
    if (next) return travel(rows[k]);
  }
}

void Session::cancel() {
  queue_.clear();
  stop_.request_stop();
}

void Session::preview(const Operation& operation) {
  wanted_preview_ = operation;
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
      }
      if (wanted_preview_ && !busy_) start_preview();
    });
  });
}

void Session::commit_preview(const Operation& operation) {
  if (busy_) return;
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
  wanted_preview_.reset();
  preview_result_.reset();
  ++preview_round_;
  if (!previewed_) return;
  const MeshPtr before = previewed_->document.mesh;
  previewed_ = nullptr;
  emit changed(before != current_.document.mesh);
}

}  // namespace arris::ui
