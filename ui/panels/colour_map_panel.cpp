#include "ui/panels/colour_map_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <QCheckBox>
#include <QColorDialog>
#include <QEvent>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QPixmap>
#include <QPushButton>
#include <QRadioButton>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr QSize strip_size(72, 12);

QPixmap strip(const ColourScale& scale, const QPalette& palette) {
  QPixmap pixmap(strip_size);
  QPainter painter(&pixmap);
  ColourScale unit = scale;
  unit.min = 0.0;
  unit.max = 1.0;
  unit.logarithmic = false;
  for (int x = 0; x < strip_size.width(); ++x) {
    const auto c = unit.colour((x + 0.5) / strip_size.width());
    painter.fillRect(x, 0, 1, strip_size.height(), QColor(c[0], c[1], c[2]));
  }
  painter.setPen(mix(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.4));
  painter.drawRect(0, 0, strip_size.width() - 1, strip_size.height() - 1);
  return pixmap;
}

QPixmap patch(const QColor& colour, const QPalette& palette) {
  QPixmap pixmap(32, 14);  // The last columns keep the text away.
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setBrush(colour);
  painter.setPen(mix(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.5));
  painter.drawRect(0, 0, 27, 13);
  return pixmap;
}

}  // namespace

class ColourMapPanel::Private {
 public:
  enum Own { below, above, undefined };

  explicit Private(ColourMapPanel* panel) : q(panel) {}

  ColourMapPanel* q;
  ColourMapState state;
  bool showing = false;  // set_state() at work: nothing is the user's.
  QStringList field_tooltips;
  QuietCombo *field = nullptr, *map = nullptr;
  QRadioButton *by_percentile = nullptr, *by_typing = nullptr;
  NumberBox *low = nullptr, *high = nullptr;
  NumberEdit *min = nullptr, *max = nullptr;
  QCheckBox *locked = nullptr, *logarithmic = nullptr, *reversed = nullptr;
  WholeBox* bands = nullptr;
  std::array<QPushButton*, 3> own{};

  QColor& own_colour(Own which) {
    if (which == below) return state.scale.below;
    return which == above ? state.scale.above : state.scale.undefined;
  }

  void tell() {
    show();
    emit q->changed(state);
  }

  /// Brings all editors in line with `state`; an editor somebody types in keeps its text.
  void show() {
    showing = true;
    field->setCurrentIndex(state.field);
    field->setToolTip(field_tooltips.value(state.field, QObject::tr("What colours the part.")));
    map->setCurrentIndex(static_cast<int>(state.scale.map));
    const bool percentile = state.range == ColourMapState::Range::percentile;
    by_percentile->setChecked(percentile);
    by_typing->setChecked(!percentile);
    low->setRange(0.0, 99.9);
    high->setRange(0.1, 100.0);
    low->setValue(state.low_percentile);
    high->setValue(state.high_percentile);
    low->setMaximum(std::min(99.9, std::max(0.0, state.high_percentile - 0.1)));
    high->setMinimum(std::max(0.1, std::min(100.0, state.low_percentile + 0.1)));
    show_number(min, state.scale.min);
    show_number(max, state.scale.max);
    locked->setChecked(state.locked);
    logarithmic->setChecked(state.scale.logarithmic);
    reversed->setChecked(state.scale.reversed);
    bands->setValue(std::max(1, state.scale.bands));
    for (const Own which : {below, above, undefined}) show_own(which);
    showing = false;
  }

  static void show_number(NumberEdit* edit, double value) {
    if (edit->hasFocus() && edit->isModified()) return;
    edit->setText(edit_text(round_significant(value)));
    edit->setModified(false);
    edit->set_mistake({});
  }

  void show_own(Own which) {
    QColor colour = own_colour(which);
    own[which]->setText(colour.isValid() ? colour.name() : QObject::tr("As the map"));
    if (!colour.isValid()) {
      const auto end = state.scale.colour(which == below ? state.scale.min : state.scale.max);
      colour = QColor(end[0], end[1], end[2]);
    }
    own[which]->setIcon(patch(colour, q->palette()));
  }

  void show_strips() {
    for (int i = 0; i < map->count(); ++i) {
      ColourScale scale;
      scale.map = static_cast<ColourMap>(i);
      scale.reversed = state.scale.reversed;
      scale.bands = state.scale.bands;
      map->setItemIcon(i, strip(scale, q->palette()));
    }
  }

  /// A typed end of the range: takes it if both ends make a range, else says why not.
  void typed(NumberEdit* edit) {
    if (!edit->isModified()) return;
    const auto value = typed_number(edit->text());
    if (!value) {
      edit->set_mistake(QObject::tr("Type a number, with a point for the decimals."));
      return;
    }
    const double least = edit == min ? *value : state.scale.min;
    const double most = edit == max ? *value : state.scale.max;
    if (least >= most) {
      edit->set_mistake(QObject::tr("The range must end above where it begins."));
      return;
    }
    if (state.scale.logarithmic && most <= 0.0) {
      edit->set_mistake(QObject::tr("A logarithmic range must end above 0."));
      return;
    }
    edit->setModified(false);
    (edit == min ? state.scale.min : state.scale.max) = *value;
    state.range = ColourMapState::Range::typed;
    tell();
  }

  void choose(Own which, const QString& title) {
    auto* dialog = new QColorDialog(own_colour(which), q);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(title);
    QObject::connect(dialog, &QColorDialog::colorSelected, q, [this, which](const QColor& colour) {
      own_colour(which) = colour;
      tell();
    });
    dialog->open();
  }

  QPushButton* own_button(Own which, const QString& title, const QString& tooltip) {
    auto* button = new QPushButton(q);
    button->setToolTip(tooltip);
    button->setAccessibleName(title);
    button->setIconSize(QSize(32, 14));
    button->setAutoDefault(false);
    auto* menu = new QMenu(button);
    menu->addAction(QObject::tr("Choose colour…"), q,
                    [this, which, title] { choose(which, title); });
    const QString plain_text = which == undefined ? QObject::tr("Grey") : QObject::tr("As the map");
    menu->addAction(plain_text, q, [this, which] {
      own_colour(which) = which == undefined ? ColourScale().undefined : QColor();
      tell();
    });
    button->setMenu(menu);
    own[which] = button;
    return button;
  }

  QFormLayout* form = nullptr;

  void add(const QString& text, QWidget* editor, const QString& tooltip) {
    auto* label = new QLabel(text, q);
    label->setToolTip(tooltip);
    label->setBuddy(editor);
    if (editor->toolTip().isEmpty()) editor->setToolTip(tooltip);
    form->addRow(label, editor);
  }
  void add_under_top(const QString& text, QLayout* editors) {
    auto* label = new QLabel(text, q);
    label->setAlignment(Qt::AlignTop);
    label->setContentsMargins(0, 2, 0, 0);
    form->addRow(label, editors);
  }
  void make_range_ends();
  void add_range();
  void add_scale();
  void add_colours();
  void follow_map_and_range();
  void follow_scale();
  void build();
};

void ColourMapPanel::Private::build() {
  form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setVerticalSpacing(6);
  field = new QuietCombo(q);
  add(tr("Fiel&d"), field, tr("What colours the part."));
  map = new QuietCombo(q);
  map->addItems(colour_map_names());
  map->setIconSize(strip_size);
  add(tr("&Map"), map, tr("The colours from low to high."));
  make_range_ends();
  add_range();
  add_scale();
  add_colours();
  auto* column = new QVBoxLayout(q);
  column->addLayout(form);
  column->addStretch(1);
  follow_map_and_range();
  follow_scale();
  show_strips();
  show();
}

void ColourMapPanel::Private::make_range_ends() {
  by_percentile = new QRadioButton(tr("Per&centiles"), q);
  by_percentile->setToolTip(tr("The range leaves out these shares of the area at both ends."));
  by_typing = new QRadioButton(tr("V&alues"), q);
  by_typing->setToolTip(tr("The range goes from and to these values of the field."));
  low = new NumberBox(q);
  high = new NumberBox(q);
  for (NumberBox* box : {low, high}) {
    box->setDecimals(1);
    box->setSuffix(QStringLiteral(" %"));
    box->setStepType(QAbstractSpinBox::DefaultStepType);
    box->setSingleStep(0.5);
    box->setMinimumWidth(40);
  }
  low->setToolTip(tr("This share of the area lies below the range."));
  low->setAccessibleName(tr("Low percentile"));
  high->setToolTip(tr("This share of the area lies below the end of the range."));
  high->setAccessibleName(tr("High percentile"));
  min = new NumberEdit(q);
  min->set_help(tr("Value at the low end of the colours; Enter sets it."));
  min->setAccessibleName(tr("Least value"));
  max = new NumberEdit(q);
  max->set_help(tr("Value at the high end of the colours; Enter sets it."));
  max->setAccessibleName(tr("Greatest value"));
}

/// The two ways to a range stand under each other, their ends in two columns.
void ColourMapPanel::Private::add_range() {
  locked = new QCheckBox(tr("&Lock across parts"), q);
  locked->setToolTip(tr("Keeps this range when another part is opened, so that pictures compare."));

  auto* range = new QGridLayout;
  range->setContentsMargins(0, 0, 0, 0);
  range->setHorizontalSpacing(4);
  range->setColumnStretch(0, 1);
  range->setColumnStretch(2, 1);
  const auto add_ends = [&](int row, QWidget* way, QWidget* from, QWidget* to) {
    range->addWidget(way, row, 0, 1, 3);
    range->addWidget(from, row + 1, 0);
    range->addWidget(new QLabel(QStringLiteral("–"), q), row + 1, 1);
    range->addWidget(to, row + 1, 2);
  };
  add_ends(0, by_percentile, low, high);
  add_ends(2, by_typing, min, max);
  range->addWidget(locked, 4, 0, 1, 3);
  add_under_top(tr("Range"), range);
}

void ColourMapPanel::Private::add_scale() {
  logarithmic = new QCheckBox(tr("Lo&garithmic"), q);
  logarithmic->setToolTip(tr("Equal ratios get equal steps of colour; for fields never below 0."));
  reversed = new QCheckBox(tr("&Reversed"), q);
  reversed->setToolTip(tr("Turns the colours around: high values get the low colours."));
  auto* scale_row = new QVBoxLayout;
  scale_row->setContentsMargins(0, 2, 0, 2);
  scale_row->setSpacing(4);
  scale_row->addWidget(logarithmic);
  scale_row->addWidget(reversed);
  add_under_top(tr("Scale"), scale_row);
}

void ColourMapPanel::Private::add_colours() {
  bands = new WholeBox(q);
  bands->setRange(1, 32);
  bands->setSpecialValueText(tr("Smooth"));
  add(tr("&Bands"), bands, tr("Shows the colours in this many flat steps."));
  add(tr("Below"),
      own_button(below, tr("Colour below the range"), tr("Colour of values below the range.")), {});
  add(tr("Above"),
      own_button(above, tr("Colour above the range"), tr("Colour of values above the range.")), {});
  add(tr("Undefined"),
      own_button(undefined, tr("Colour where the field is undefined"),
                 tr("Colour where the field has no value, as on the border.")),
      {});
}

void ColourMapPanel::Private::follow_map_and_range() {
  QObject::connect(field, &QComboBox::activated, q, [this](int index) {
    if (index == state.field) return;
    state.field = index;
    tell();
  });
  QObject::connect(map, &QComboBox::activated, q, [this](int index) {
    if (index == static_cast<int>(state.scale.map)) return;
    state.scale.map = static_cast<ColourMap>(index);
    tell();
  });
  QObject::connect(by_percentile, &QRadioButton::toggled, q, [this](bool on) {
    if (showing) return;
    state.range = on ? ColourMapState::Range::percentile : ColourMapState::Range::typed;
    tell();
  });
  const auto percentile = [this](double& end, double value) {
    if (showing) return;
    end = value;
    state.range = ColourMapState::Range::percentile;
    tell();
  };
  QObject::connect(low, &QDoubleSpinBox::valueChanged, q,
                   [this, percentile](double v) { percentile(state.low_percentile, v); });
  QObject::connect(high, &QDoubleSpinBox::valueChanged, q,
                   [this, percentile](double v) { percentile(state.high_percentile, v); });
  for (NumberEdit* edit : {min, max}) {
    QObject::connect(edit, &QLineEdit::editingFinished, q, [this, edit] { typed(edit); });
  }
}

void ColourMapPanel::Private::follow_scale() {
  const auto flag = [this](QCheckBox* box, bool& kept) {
    QObject::connect(box, &QCheckBox::clicked, q, [this, &kept](bool on) {
      kept = on;
      show_strips();
      tell();
    });
  };
  flag(locked, state.locked);
  flag(logarithmic, state.scale.logarithmic);
  flag(reversed, state.scale.reversed);
  QObject::connect(bands, &QSpinBox::valueChanged, q, [this](int count) {
    if (showing) return;
    state.scale.bands = count < 2 ? 0 : count;
    show_strips();
    tell();
  });
}

ColourMapPanel::ColourMapPanel(QWidget* parent)
    : QWidget(parent), p_(std::make_unique<Private>(this)) {
  p_->build();
}

ColourMapPanel::~ColourMapPanel() = default;

void ColourMapPanel::set_fields(const QStringList& names, const QStringList& tooltips) {
  p_->field_tooltips = tooltips;
  p_->field->clear();
  p_->field->addItems(names);
  for (int i = 0; i < names.size(); ++i) {
    p_->field->setItemData(i, tooltips.value(i), Qt::ToolTipRole);
  }
  p_->show();
}

void ColourMapPanel::set_field_names(const QStringList& names) {
  for (int i = 0; i < names.size(); ++i) p_->field->setItemText(i, names[i]);
}

void ColourMapPanel::set_field_available(int field, bool available, const QString& reason) {
  auto* items = qobject_cast<QStandardItemModel*>(p_->field->model());
  QStandardItem* item = items ? items->item(field) : nullptr;
  if (!item) return;
  item->setEnabled(available);
  item->setToolTip(available ? p_->field_tooltips.value(field) : reason);
}

void ColourMapPanel::set_state(const ColourMapState& state) {
  p_->state = state;
  p_->show_strips();
  p_->show();
}

ColourMapState ColourMapPanel::state() const { return p_->state; }

void ColourMapPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() != QEvent::PaletteChange) return;
  p_->show_strips();
  p_->show();
}

}  // namespace arris::ui
