#include "ui/panels/element_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <QAbstractTableModel>
#include <QEvent>
#include <QHash>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>
#include <QPixmap>
#include <QScrollBar>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

bool is_number(const QVariant& cell) {
  switch (cell.typeId()) {
    case QMetaType::Double:
    case QMetaType::Float:
    case QMetaType::Int:
    case QMetaType::UInt:
    case QMetaType::Long:
    case QMetaType::ULong:
    case QMetaType::LongLong:
    case QMetaType::ULongLong:
      return true;
    default:
      return false;
  }
}

QString cell_text(const QVariant& cell) {
  const int type = cell.typeId();
  if (type == QMetaType::Double || type == QMetaType::Float) return shown_number(cell.toDouble());
  return cell.toString();
}

/// Order of two cells: empty ones last, numbers by value (NaN after them) before words.
int compare(const QVariant& a, const QVariant& b) {
  const auto group = [](const QVariant& cell) {
    if (!cell.isValid()) return 3;
    if (!is_number(cell)) return 2;
    return std::isnan(cell.toDouble()) ? 1 : 0;
  };
  const int first = group(a), second = group(b);
  if (first != second) return first - second;
  if (first == 0) {
    const double x = a.toDouble(), y = b.toDouble();
    return x < y ? -1 : (x > y ? 1 : 0);
  }
  return first == 2 ? QString::localeAwareCompare(a.toString(), b.toString()) : 0;
}

class Model : public QAbstractTableModel {
 public:
  Model(const QStringList& headers, const QStringList& tooltips, QObject* parent)
      : QAbstractTableModel(parent), headers_(headers), tooltips_(tooltips) {}

  void set_rows(std::vector<ElementRow> rows) {
    beginResetModel();
    rows_ = std::move(rows);
    lines_.assign(rows_.size(), QString());
    row_of_.clear();
    row_of_.reserve(static_cast<qsizetype>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) row_of_.insert(rows_[i].id, static_cast<int>(i));
    endResetModel();
  }

  void set_headers(const QStringList& headers) {
    if (headers_ == headers) return;
    headers_ = headers;
    emit headerDataChanged(Qt::Horizontal, 0, static_cast<int>(headers_.size()) - 1);
  }

  /// Everything is read afresh. A filter that hides thousands of scattered rows takes a hundredth
  /// of the time that telling the view about each of them would.
  void reset() {
    beginResetModel();
    endResetModel();
  }

  const std::vector<ElementRow>& rows() const { return rows_; }
  /// -1: none.
  int row_of(std::uint32_t id) const { return row_of_.value(id, -1); }
  const QVariant& cell(int row, int column) const {
    static const QVariant none;
    const auto& cells = rows_[row].cells;
    return column < static_cast<int>(cells.size()) ? cells[column] : none;
  }

  /// All texts of a row, for the filter.
  const QString& line(int row) const {
    QString& line = lines_[row];
    if (line.isNull()) {
      line = QLatin1String("");
      for (const QVariant& cell : rows_[row].cells) line += cell_text(cell) + QLatin1Char('\n');
    }
    return line;
  }

  int rowCount(const QModelIndex& parent = {}) const override {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
  }
  int columnCount(const QModelIndex& parent = {}) const override {
    return parent.isValid() ? 0 : static_cast<int>(headers_.size());
  }

  QVariant data(const QModelIndex& index, int role) const override {
    const QVariant& value = cell(index.row(), index.column());
    if (role == Qt::DisplayRole) return cell_text(value);
    if (role == Qt::TextAlignmentRole) {
      return QVariant::fromValue(
          Qt::Alignment(Qt::AlignVCenter | (is_number(value) ? Qt::AlignRight : Qt::AlignLeft)));
    }
    if (role == Qt::DecorationRole && index.column() == 0) {
      const QColor& colour = rows_[index.row()].swatch;
      if (colour.isValid()) return swatch(colour);
    }
    if (role == Qt::ToolTipRole) {
      const QString text = cell_text(value);
      const QString title = headers_.value(index.column());
      return text.isEmpty() ? title : title + QStringLiteral(": ") + text;
    }
    return {};
  }

  QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::DisplayRole) return headers_.value(section);
    if (role == Qt::ToolTipRole) return tooltips_.value(section);
    if (role == Qt::TextAlignmentRole) {
      const bool number = !rows_.empty() && is_number(cell(0, section));
      return QVariant::fromValue(
          Qt::Alignment(Qt::AlignVCenter | (number ? Qt::AlignRight : Qt::AlignLeft)));
    }
    return {};
  }

 private:
  QPixmap swatch(const QColor& colour) const {
    auto found = swatches_.constFind(colour.rgb());
    if (found != swatches_.constEnd()) return *found;
    QPixmap pixmap(14, 14);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(128, 128, 128));
    painter.setBrush(colour);
    painter.drawRoundedRect(QRectF(0.5, 0.5, 13, 13), 3, 3);
    return *swatches_.insert(colour.rgb(), pixmap);
  }

  QStringList headers_, tooltips_;
  std::vector<ElementRow> rows_;
  mutable std::vector<QString> lines_;  // Null: not needed so far.
  QHash<std::uint32_t, int> row_of_;
  mutable QHash<QRgb, QPixmap> swatches_;
};

/// Sorts by value; a row passes if each word of the filter occurs in it.
class Proxy : public QSortFilterProxyModel {
 public:
  explicit Proxy(Model* model) : QSortFilterProxyModel(model), model_(model) {
    setSourceModel(model);
  }

  void set_filter(const QString& text) {
    words_ = text.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    model_->reset();
  }

 protected:
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override {
    const int order =
        compare(model_->cell(left.row(), left.column()), model_->cell(right.row(), right.column()));
    if (order != 0) return order < 0;
    const auto first = model_->rows()[left.row()].id, second = model_->rows()[right.row()].id;
    return sortOrder() == Qt::AscendingOrder ? first < second : first > second;
  }

  bool filterAcceptsRow(int row, const QModelIndex&) const override {
    return std::all_of(words_.begin(), words_.end(), [this, row](const QString& word) {
      return model_->line(row).contains(word, Qt::CaseInsensitive);
    });
  }

 private:
  Model* model_;
  QStringList words_;
};

/// Table that says why it is empty.
class View : public QTableView {
 public:
  using QTableView::QTableView;
  QString note;

  /// Brings the scroll bars in line with the rows at once, so that they can be set.
  void settle() {
    executeDelayedItemsLayout();
    updateGeometries();
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QTableView::paintEvent(event);
    if (model() == nullptr || model()->rowCount() > 0) return;
    QPainter painter(viewport());
    painter.setPen(muted_text(palette()));
    painter.drawText(viewport()->rect().adjusted(12, 12, -12, -12),
                     Qt::AlignCenter | Qt::TextWordWrap, note);
  }
};

}  // namespace

class ElementTable::Private {
 public:
  ElementTable* q = nullptr;
  QString what, empty_text;
  QLineEdit* filter = nullptr;
  MutedLabel* count = nullptr;
  View* view = nullptr;
  Model* model = nullptr;
  Proxy* proxy = nullptr;
  std::unordered_set<std::uint32_t> chosen;  // Also those that the filter hides.
  bool showing = false;                      // A change of the selection is not the user's.
  std::vector<int> fitted;                   // width each column was given; 0: nothing in it yet
  bool unseen = false;  // Selected while the table was hidden: to be scrolled to when it shows.

  std::uint32_t id_at(int proxy_row) const {
    return model->rows()[proxy->mapToSource(proxy->index(proxy_row, 0)).row()].id;
  }

  QModelIndex index_of(std::uint32_t id) const {
    const int row = model->row_of(id);
    return row < 0 ? QModelIndex() : proxy->mapFromSource(model->index(row, 0));
  }

  /// Selects in the view what is chosen and shown, and nothing else.
  void show_chosen() {
    showing = true;
    std::vector<int> rows;
    rows.reserve(chosen.size());
    for (const std::uint32_t id : chosen) {
      const QModelIndex index = index_of(id);
      if (index.isValid()) rows.push_back(index.row());
    }
    std::sort(rows.begin(), rows.end());
    QItemSelection selection;
    const int last_column = std::max(0, proxy->columnCount() - 1);
    for (std::size_t i = 0; i < rows.size();) {
      std::size_t end = i + 1;
      while (end < rows.size() && rows[end] == rows[end - 1] + 1) ++end;
      selection.append(
          QItemSelectionRange(proxy->index(rows[i], 0), proxy->index(rows[end - 1], last_column)));
      i = end;
    }
    view->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
    showing = false;
    show_count();
  }

  void show_count() {
    const int all = model->rowCount(), shown = proxy->rowCount();
    QString text = shown == all ? tr("%1 %2").arg(count_text(all), what)
                                : tr("%1 of %2 %3").arg(count_text(shown), count_text(all), what);
    if (!chosen.empty()) {
      text += tr(", %1 selected").arg(count_text(static_cast<qint64>(chosen.size())));
      const auto hidden = std::count_if(chosen.begin(), chosen.end(), [this](std::uint32_t id) {
        return !index_of(id).isValid();
      });
      if (hidden > 0) text += tr(" (%1 filtered out)").arg(count_text(hidden));
    }
    count->setText(text);
    view->note =
        all == 0 ? empty_text : tr("No %1 match “%2”.").arg(what, filter->text().trimmed());
    if (shown == 0) view->viewport()->update();
  }

  void user_selected() {
    if (showing) return;
    chosen.clear();
    for (const QItemSelectionRange& range : view->selectionModel()->selection()) {
      for (int row = range.top(); row <= range.bottom(); ++row) chosen.insert(id_at(row));
    }
    show_count();
    emit q->selection_changed(chosen);
  }

  /// Resets the model by `action` and keeps the current row and the selection.
  template <class Action>
  void reset(const Action& action) {
    const QModelIndex current = view->currentIndex();
    std::optional<std::uint32_t> current_id;
    if (current.isValid()) current_id = id_at(current.row());
    showing = true;
    action();
    if (current_id) {
      const QModelIndex index = index_of(*current_id);
      if (index.isValid()) {
        view->selectionModel()->setCurrentIndex(index, QItemSelectionModel::NoUpdate);
      }
    }
    show_chosen();
  }

  void apply_filter() {
    reset([this] { proxy->set_filter(filter->text()); });
    scroll_to_first();
  }

  void scroll_to_first() {
    unseen = !q->isVisible();
    view->settle();
    int first = -1;
    for (const QItemSelectionRange& range : view->selectionModel()->selection()) {
      if (first < 0 || range.top() < first) first = range.top();
    }
    if (first >= 0) view->scrollTo(proxy->index(first, 0), QAbstractItemView::EnsureVisible);
  }
};

ElementTable::ElementTable(const QString& what, const QStringList& headers,
                           const QStringList& tooltips, QWidget* parent)
    : QWidget(parent), p_(std::make_unique<Private>()) {
  p_->q = this;
  p_->what = what;
  p_->empty_text = tr("No %1 yet.").arg(what);

  p_->filter = new QLineEdit(this);
  p_->filter->setPlaceholderText(tr("Filter %1").arg(what));
  p_->filter->setToolTip(
      tr("Shows the %1 in whose row each of these words or numbers occurs.").arg(what));
  p_->filter->setClearButtonEnabled(true);
  p_->filter->installEventFilter(this);

  p_->model = new Model(headers, tooltips, this);
  p_->proxy = new Proxy(p_->model);
  p_->view = new View(this);
  p_->view->setModel(p_->proxy);
  p_->view->setSelectionBehavior(QAbstractItemView::SelectRows);
  p_->view->setSelectionMode(QAbstractItemView::ExtendedSelection);
  p_->view->setEditTriggers(QAbstractItemView::NoEditTriggers);
  p_->view->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  p_->view->setAlternatingRowColors(true);
  p_->view->setShowGrid(false);
  p_->view->setWordWrap(false);
  p_->view->setTabKeyNavigation(false);
  p_->view->setIconSize(QSize(14, 14));
  p_->view->setAccessibleName(what);
  p_->view->installEventFilter(this);
  p_->view->verticalHeader()->hide();
  p_->view->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  p_->view->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 6);
  QHeaderView* header = p_->view->horizontalHeader();
  header->setHighlightSections(false);
  header->setStretchLastSection(true);
  header->setMinimumSectionSize(36);
  header->setResizeContentsPrecision(200);
  header->setTextElideMode(Qt::ElideRight);
  p_->view->sortByColumn(0, Qt::AscendingOrder);
  p_->view->setSortingEnabled(true);

  p_->count = new MutedLabel({}, this);
  p_->count->setWordWrap(true);

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->setSpacing(4);
  column->addWidget(p_->filter);
  column->addWidget(p_->view, 1);
  column->addWidget(p_->count);

  connect(p_->filter, &QLineEdit::textChanged, this, [this] { p_->apply_filter(); });
  connect(p_->view->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          [this] { p_->user_selected(); });
  connect(p_->view, &QTableView::doubleClicked, this,
          [this](const QModelIndex& index) { emit activated(p_->id_at(index.row())); });
  p_->view->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(p_->view, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
    emit context_menu_wanted(p_->view->viewport()->mapToGlobal(at));
  });
  p_->show_count();
}

ElementTable::~ElementTable() = default;

void ElementTable::set_headers(const QStringList& headers) { p_->model->set_headers(headers); }

void ElementTable::set_rows(std::vector<ElementRow> rows) {
  const int down = p_->view->verticalScrollBar()->value();
  const int across = p_->view->horizontalScrollBar()->value();
  p_->reset([&] {
    p_->model->set_rows(std::move(rows));
    std::erase_if(p_->chosen, [this](std::uint32_t id) { return p_->model->row_of(id) < 0; });
  });
  // What takes longer to work out comes into its columns later.
  const int columns = p_->model->columnCount(), looked_at = std::min(p_->model->rowCount(), 100);
  p_->fitted.resize(static_cast<std::size_t>(columns), 0);
  for (int column = 0; column < columns; ++column) {
    int& fitted = p_->fitted[static_cast<std::size_t>(column)];
    bool fits = fitted != 0;
    for (int row = 0; row < looked_at && !fits; ++row)
      fits = !p_->model->index(row, column).data().toString().isEmpty();
    if (!fits) continue;
    // It grows with what comes, unless the user has set its width.
    const int before = p_->view->columnWidth(column);
    if (fitted != 0 && before != fitted) continue;
    p_->view->resizeColumnToContents(column);
    if (fitted != 0 && p_->view->columnWidth(column) < before)
      p_->view->setColumnWidth(column, before);
    fitted = p_->view->columnWidth(column);
  }
  p_->view->settle();
  p_->view->verticalScrollBar()->setValue(down);
  p_->view->horizontalScrollBar()->setValue(across);
}

void ElementTable::set_selected(const std::unordered_set<std::uint32_t>& ids) {
  std::unordered_set<std::uint32_t> present = ids;
  std::erase_if(present, [this](std::uint32_t id) { return p_->model->row_of(id) < 0; });
  if (present == p_->chosen) return;  // Most often the answer to the user's own click.
  p_->chosen = std::move(present);
  p_->show_chosen();
  p_->scroll_to_first();
}

std::unordered_set<std::uint32_t> ElementTable::selected() const { return p_->chosen; }

void ElementTable::set_empty_text(const QString& text) {
  p_->empty_text = text;
  p_->show_count();
}

void ElementTable::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (p_->unseen) p_->scroll_to_first();
}

bool ElementTable::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
  if (watched == p_->view && enter) {
    const QModelIndex current = p_->view->currentIndex();
    if (current.isValid()) emit activated(p_->id_at(current.row()));
    return true;
  }
  if (watched == p_->filter && key == Qt::Key_Escape && !p_->filter->text().isEmpty()) {
    p_->filter->clear();
    return true;
  }
  if (watched == p_->filter && (key == Qt::Key_Down || enter)) {
    p_->view->setFocus();
    if (!p_->view->currentIndex().isValid() && p_->proxy->rowCount() > 0) p_->view->selectRow(0);
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace arris::ui
