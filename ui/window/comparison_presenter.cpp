#include "ui/window/comparison_presenter.h"

#include <algorithm>
#include <unordered_map>

#include <QInputDialog>
#include <QPainter>

#include "core/base/number_text.h"
#include "ui/window/actions.h"
#include "ui/window/shown_elements.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

constexpr double side_share = 0.6;  // of the magnification before, for each of two views

QString length_text(double length, LengthUnit unit) {
  return QString::fromStdString(arris::number_text(length, 4)) + unit_in_sentence(unit);
}

/// "279 lines, 2052 mm; 96 partitions".
QString holds_text(const Document& document, LengthUnit unit) {
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  return ComparisonPresenter::tr("%1 lines, %2 · %3 partitions")
      .arg(document.lines.lines.size())
      .arg(length_text(length, unit))
      .arg(document.partitions.partitions.size());
}

QString only_text(const Departure& only, LengthUnit unit) {
  if (only.stretches.empty()) return ComparisonPresenter::tr("nothing that the other has not");
  if (only.soft_length == 0.0)
    return ComparisonPresenter::tr("only here: %1 of lines")
        .arg(length_text(only.sharp_length, unit));
  return ComparisonPresenter::tr("only here: %1 of lines, %2 of borders")
      .arg(length_text(only.sharp_length, unit), length_text(only.soft_length, unit));
}

}  // namespace

ComparisonPresenter::ComparisonPresenter(Session* session, MeshView* view, SideBySide* side_by_side,
                                         FieldPresenter* fields, ElementsPresenter* elements,
                                         QObject* parent)
    : QObject(parent),
      session_(session),
      view_(view),
      side_by_side_(side_by_side),
      fields_(fields),
      elements_(elements),
      work_(this) {
  connect(session_, &Session::changed, this, &ComparisonPresenter::take_change);
  connect(session_, &Session::opened, this, [this] {
    stop();
    row_ = 0;
  });
  connect(session_, &Session::names_changed, this, [this] {
    show_headers();
    refresh();
  });
  connect(session_, &Session::busy_changed, this, [this](bool busy) {
    if (!busy) left_behind_.reset();  // of a travel that was cancelled, or failed
    refresh();
  });
  connect(fields_, &FieldPresenter::changed, this, &ComparisonPresenter::show_field);
  connect(elements_, &ElementsPresenter::partitions_shown_changed, this, [this] {
    show_field();
    show_partitions();
  });
  connect(elements_, &ElementsPresenter::visibility_changed, this,
          &ComparisonPresenter::show_visibility);
  // One selection for both views: keys mean the part as it is now.
  connect(elements_, &ElementsPresenter::selection_changed, this, [this] {
    const bool any = !elements_->selected_lines().empty() ||
                     !elements_->selected_partitions().empty() ||
                     !elements_->selected_boundaries().empty();
    if (any) select_line(std::nullopt);
  });
  connect(view_, &MeshView::look_changed, this, [this] {
    if (other_) other_->look_like(*view_);
  });
  connect(side_by_side_, &SideBySide::version_wanted, this, &ComparisonPresenter::compare_with);
  connect(side_by_side_, &SideBySide::travel_wanted, this, &ComparisonPresenter::swap);
  connect(side_by_side_, &SideBySide::line_wanted, this, &ComparisonPresenter::take_line);
  connect(side_by_side_, &SideBySide::closed, this, &ComparisonPresenter::stop);
  connect(side_by_side_, &SideBySide::marks_wanted, this, [this](bool shown) {
    marks_shown_ = shown;
    show_marks();
  });
}

void ComparisonPresenter::add_actions(QMenu* menu) {
  name_ = action(menu, tr("&Name this version…"), QKeySequence("Ctrl+Shift+N"),
                 tr("Give the state of the part a name, to come back to it and to compare"));
  connect(name_, &QAction::triggered, this, [this] { ask_name(session_->history().head()); });
  compare_ = action(menu, tr("Co&mpare versions"), QKeySequence("Ctrl+K"),
                    tr("Show another version beside the part, and mark where the two differ"));
  compare_->setCheckable(true);
  connect(compare_, &QAction::triggered, this, [this](bool on) {
    if (on)
      compare_with(likely_row());
    else
      stop();
    refresh();
  });
  refresh();
}

void ComparisonPresenter::refresh() {
  if (!name_) return;
  // The history belongs to the work that runs.
  const bool busy = session_->busy();
  const bool part = !session_->current().document.empty();
  const QString why =
      part ? tr("Wait until the work that runs is done.") : tr("Open a part first.");
  set_available(name_, part && !busy, why);
  const bool other = !busy && part && (active() || likely_row() != 0);
  set_available(compare_, other,
                part && !busy ? tr("There is only one state of the part yet.") : why);
  compare_->setChecked(active());
  side_by_side_->set_travel_possible(!busy);
  side_by_side_->set_line_takeable(active() && line_ != 0 && !busy);
}

std::uint32_t ComparisonPresenter::likely_row() const {
  const History& history = session_->history();
  if (row_ != 0 && row_ <= history.entries().size() && row_ != history.head()) return row_;
  for (auto named = history.names().rbegin(); named != history.names().rend(); ++named)
    if (named->first != history.head()) return named->first;
  if (history.head() == 0) return 0;
  if (const std::uint32_t before = history.entries()[history.head() - 1].parent) return before;
  const std::vector<std::uint32_t> rows = history.line_of_travel();
  return rows.size() > 1 ? rows[1] : 0;
}

QString ComparisonPresenter::row_text(std::uint32_t sequence) const {
  const History& history = session_->history();
  if (sequence == 0 || sequence > history.entries().size()) return {};
  const auto name = history.names().find(sequence);
  return QString::fromStdString(name != history.names().end()
                                    ? name->second
                                    : describe(history.entries()[sequence - 1].operation));
}

QString ComparisonPresenter::now_text() const {
  return session_->is_previewing() ? tr("Now: tuning")
                                   : tr("Now: %1").arg(row_text(session_->history().head()));
}

void ComparisonPresenter::ask_name(std::uint32_t sequence) {
  const History& history = session_->history();
  if (session_->busy() || sequence == 0 || sequence > history.entries().size()) return;
  const auto known = history.names().find(sequence);
  QString name = known == history.names().end() ? QString() : QString::fromStdString(known->second);
  const QString what = QString::fromStdString(describe(history.entries()[sequence - 1].operation));
  bool given = true;
  do {
    name = QInputDialog::getText(side_by_side_->window(), tr("Name this version"),
                                 tr("Name of the state after “%1” (empty: none):").arg(what),
                                 QLineEdit::Normal, name, &given);
  } while (given && !session_->name_version(sequence, name));
}

void ComparisonPresenter::compare_with(std::uint32_t sequence) {
  if (sequence == 0 || session_->busy()) return;
  session_->fetch(sequence, [this, sequence](Document version) {
    if (!version.empty()) begin(sequence, std::move(version));
  });
}

void ComparisonPresenter::begin(std::uint32_t sequence, Document version) {
  const bool other_mesh = version.mesh != version_.mesh || !other_;
  row_ = sequence;
  version_ = std::move(version);
  line_ = 0;
  work_.cancel();  // it compares with the version before
  outdated_ = false;
  comparison_.reset();
  colours_.clear();
  if (!other_) make_view();
  if (other_mesh) {
    other_->set_mesh(version_.mesh, false);
    const bool is_scan = version_.mesh == version_.opened.mesh;
    other_->set_reference(is_scan ? nullptr : version_.opened.mesh,
                          version_.zones ? version_.zones->largest_radius() : 0.0);
  }
  other_->set_selected_lines({});
  other_->look_like(*view_);
  other_->set_lines(view_lines(version_));
  show_field();
  show_partitions();
  show_headers();
  compare_anew();
  refresh();
}

void ComparisonPresenter::make_view() {
  other_ = new MeshView;
  other_->setAccessibleName(tr("The other version"));
  other_->set_scalar_bar_visible(false);
  other_->set_legend_visible(false);
  connect(other_, &MeshView::look_changed, this, [this] { view_->look_like(*other_); });
  connect(other_, &MeshView::clicked, this, &ComparisonPresenter::select_line);
  connect(other_, &MeshView::hovered, this,
          [this](const std::optional<Pick>& pick) { emit hovered(version_, pick); });
  side_by_side_->set_other(other_);
  // Nearly as much of the part, in half the room; one that was fitted is fitted again.
  if (!view_->is_fitted()) view_->zoom_by(side_share);
}

void ComparisonPresenter::stop() {
  if (!other_) return;
  work_.cancel();
  outdated_ = false;
  left_behind_.reset();
  comparison_.reset();
  version_ = {};
  line_ = 0;
  view_->set_marked_paths({});
  side_by_side_->set_other(nullptr);
  if (!view_->is_fitted()) view_->zoom_by(1.0 / side_share);
  delete std::exchange(other_, nullptr);
  view_->setFocus();
  refresh();
}

void ComparisonPresenter::take_change(bool other_mesh) {
  if (left_behind_ && session_->history().head() == row_ && !session_->is_previewing()) {
    auto [row, document] = std::move(*left_behind_);
    left_behind_.reset();
    begin(row, std::move(document));
    return;
  }
  if (other_ && !are_of_one_scan(session_->current().document, version_)) stop();
  refresh();
  if (!other_) return;
  if (other_mesh) view_->set_marked_paths({});
  if (plain_ != plain_wanted()) show_field();
  show_headers();
  compare_anew();
}

void ComparisonPresenter::compare_anew() {
  outdated_ = work_.running();  // what runs is finished: a drag must not starve it
  if (outdated_) return;
  const Document& now = session_->shown().document;
  work_.start(
      [version = version_, now](const Context& context) { return compare(version, now, context); },
      [this, mesh = now.mesh](const Result<Comparison>& comparison) {
        if (!other_) return;
        if (comparison)
          take(mesh, *comparison);
        else if (!comparison.error().cancelled)
          side_by_side_->set_figures(
              0, holds_text(version_, length_unit_of(session_->shown().document)),
              QString::fromStdString(comparison.error().message));
        if (std::exchange(outdated_, false)) compare_anew();
      });
}

void ComparisonPresenter::take(const MeshPtr& mesh, const Comparison& comparison) {
  comparison_ = comparison;
  compared_mesh_ = mesh;
  show_marks();
  show_partitions();
  show_visibility();
  show_headers();
}

void ComparisonPresenter::show_marks() {
  if (!other_ || !comparison_) return;
  const bool shown = marks_shown_ && compared_mesh_ == session_->shown().document.mesh;
  using Paths = std::vector<std::vector<VertexId>>;
  other_->set_marked_paths(shown ? comparison_->only[0].stretches : Paths());
  view_->set_marked_paths(shown ? comparison_->only[1].stretches : Paths());
}

bool ComparisonPresenter::plain_wanted() const {
  // A version without partitions is plain beside one whose partitions are shown.
  return elements_->partitions_shown() && !session_->shown().document.partitions.labels.empty();
}

void ComparisonPresenter::show_field() {
  if (!other_) return;
  plain_ = plain_wanted();
  other_->set_field(plain_ ? std::nullopt : fields_->of(version_));
}

void ComparisonPresenter::show_partitions() {
  if (!other_) return;
  if (!elements_->partitions_shown()) {
    colours_.clear();
    other_->set_face_labels({}, {});
    return;
  }
  // Partitions that stand for each other have one colour in both views. While there are none to
  // stand for these, as when lines are tuned, they keep what they had.
  const Document& now = session_->shown().document;
  std::vector<std::optional<QColor>> given(version_.partitions.partitions.size());
  if (comparison_ && comparison_->partitions.empty() && colours_.size() == given.size()) return;
  if (comparison_) {
    const std::vector<QColor> colours = colours_of_partitions(now);
    const std::vector<std::uint32_t> place = places_of_partitions(version_);
    std::unordered_map<std::uint32_t, std::size_t> of_now;
    for (std::size_t k = 0; k < now.partitions.partitions.size(); ++k)
      of_now[now.partitions.partitions[k]->id] = k;
    for (const auto& [before, after] : comparison_->partitions)
      if (const auto found = of_now.find(after); found != of_now.end())
        given[place[before] - 1] = colours[found->second];
  }
  std::vector<QColor> colours = colours_of_partitions(version_, given);
  if (!colours.empty() && colours == colours_) return;
  colours_ = std::move(colours);
  show_partitions_in(*other_, version_, colours_);
}

void ComparisonPresenter::show_visibility() {
  if (!other_) return;
  if (!elements_->hides_any() || !comparison_ || version_.partitions.labels.empty()) {
    other_->set_hidden_faces({});
    return;
  }
  // A partition is hidden with the one it stands for; one that stands for none is shown, but for
  // where others are isolated.
  std::vector<bool> hides(version_.next_id, elements_->isolates_any());
  for (const auto& [before, after] : comparison_->partitions)
    hides[before] = elements_->hides(after);
  hides[0] = elements_->hides(0);
  std::vector<bool> hidden(version_.mesh->face_count());
  for (FaceId f = 0; f < hidden.size(); ++f) hidden[f] = hides[version_.partitions.labels[f]];
  other_->set_hidden_faces(std::move(hidden));
}

void ComparisonPresenter::show_headers() {
  if (!other_) return;
  const Document& now = session_->shown().document;
  // Of one scan, even where the version is from before the unit was told.
  const LengthUnit unit = length_unit_of(now);
  other_->set_length_unit(unit);
  side_by_side_->set_figures(
      0, holds_text(version_, unit),
      comparison_ ? only_text(comparison_->only[0], unit) : tr("comparing…"));
  QString holds = holds_text(now, unit);
  if (comparison_ && comparison_->divided_otherwise)
    holds +=
        tr(" · %1 % differs")
            .arg(QString::fromStdString(fixed_text(100.0 * *comparison_->divided_otherwise, 1)));
  side_by_side_->set_figures(
      1, holds, comparison_ ? only_text(comparison_->only[1], unit) : tr("comparing…"));
  side_by_side_->set_now(now_text());

  const History& history = session_->history();
  std::vector<SideBySide::Version> versions;
  const auto add = [&](std::uint32_t row, const QString& text) {
    const bool known = std::ranges::any_of(
        versions, [row](const SideBySide::Version& v) { return v.sequence == row; });
    if (!known) versions.push_back({row, text});
  };
  for (auto named = history.names().rbegin(); named != history.names().rend(); ++named)
    add(named->first, QString::fromStdString(named->second));
  if (history.head() != 0)
    if (const std::uint32_t before = history.entries()[history.head() - 1].parent)
      add(before, tr("The state before “%1”").arg(row_text(history.head())));
  add(row_, row_text(row_));
  side_by_side_->set_versions(versions, row_);
}

void ComparisonPresenter::select_line(const std::optional<Pick>& pick) {
  if (!other_) return;
  line_ = pick && pick->line < first_boundary ? pick->line : 0;
  if (line_ != 0) elements_->clear_selection();
  other_->set_selected_lines(line_ == 0 ? std::unordered_set<std::uint32_t>()
                                        : std::unordered_set<std::uint32_t>{line_});
  refresh();
}

void ComparisonPresenter::take_line() {
  const Line* line = version_.lines.find(line_);
  if (!line) return;
  // Vertices keep their ids for life; those that this mesh does not have are passed by.
  const Mesh& mesh = *session_->current().document.mesh;
  std::vector<VertexId> path = line->vertices;
  std::erase_if(path, [&](VertexId v) { return v >= mesh.vertex_count() || mesh.is_isolated(v); });
  select_line(std::nullopt);
  session_->run({Operation{"draw_line", {{"vertices", path}}}});
}

void ComparisonPresenter::swap() {
  if (!other_ || session_->busy() || row_ == session_->history().head()) return;
  left_behind_ = {session_->history().head(), session_->current().document};
  session_->travel(row_);
}

QImage ComparisonPresenter::picture(const PictureOptions& options) {
  const QSize whole = options.size;
  const int gap = std::max(2, whole.width() / 400);
  const double scale =
      static_cast<double>(whole.width() - gap) / (2.0 * std::max(1, view_->width()));
  const int caption = static_cast<int>(65 * scale);
  PictureOptions half = options;
  half.size = {(whole.width() - gap) / 2, whole.height() - caption};
  half.height *= static_cast<double>(half.size.height()) / whole.height();
  if (half.size.height() < caption) return {};
  QImage result(whole, QImage::Format_ARGB32_Premultiplied);
  result.fill(options.background);
  QPainter painter(&result);
  const QColor text = options.background.alpha() == 0 || options.background.lightness() > 128
                          ? QColor(24, 26, 30)
                          : QColor(236, 238, 242);
  const std::array<MeshView*, 2> views{other_, view_};
  const std::array<QString, 2> titles{row_text(row_), now_text()};
  const Document& now = session_->shown().document;
  const LengthUnit unit = length_unit_of(now);
  const std::array<QString, 2> holds{holds_text(version_, unit), holds_text(now, unit)};
  for (std::size_t side = 0; side < 2; ++side) {
    half.scalar_bar = options.scalar_bar && side == 1;
    const QImage image = views[side]->picture(half);
    if (image.isNull()) return {};
    const int left = side == 0 ? 0 : whole.width() - half.size.width();
    painter.drawImage(left, caption, image);
    painter.save();
    painter.translate(left, 0);
    painter.scale(scale, scale);
    painter.setPen(text);
    QFont bold = view_->font();
    bold.setBold(true);
    const double width = half.size.width() / scale - 16.0;
    const auto line = [&](const QFont& font, double top, const QString& words) {
      painter.setFont(font);
      painter.drawText(
          QRectF(8, top, width, 20), Qt::AlignVCenter,
          QFontMetrics(font).elidedText(words, Qt::ElideRight, static_cast<int>(width)));
    };
    line(bold, 4, titles[side]);
    line(view_->font(), 23, holds[side]);
    if (comparison_) {
      constexpr double key = 22.0;
      painter.fillRect(QRectF(8, 47, key, 10), marked_colour());
      painter.translate(key + 6.0, 0.0);
      line(view_->font(), 42, only_text(comparison_->only[side], unit));
    }
    painter.restore();
  }
  painter.fillRect(QRect(half.size.width(), 0, gap, whole.height()),
                   QColor(text.red(), text.green(), text.blue(), 60));
  painter.end();
  return options.background.alpha() == 255 ? result.convertToFormat(QImage::Format_RGB32) : result;
}

}  // namespace arris::ui
