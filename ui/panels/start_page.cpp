#include "ui/panels/start_page.h"

#include <algorithm>

#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QResizeEvent>
#include <QScrollArea>
#include <QStyle>
#include <QStyleOptionButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int most_recent = 8;
constexpr int widest = 820;      // pixels of the column in a wide window
constexpr int one_column = 640;  // below this the tour goes under the recent files

QFont scaled(const QFont& font, double factor, bool bold) {
  QFont result = font;
  result.setPointSizeF(font.pointSizeF() * factor);
  result.setBold(bold);
  return result;
}

/// A recent file: its picture where it has one, its name, its kind and its folder.
class FileButton : public QPushButton {
 public:
  /// `room`: for a picture, whether there is one or not.
  FileButton(const QString& file, const QImage& picture, bool room, QWidget* parent)
      : QPushButton(parent), picture_(picture), room_(room) {
    const QFileInfo info(file);
    name_ = info.fileName().isEmpty() ? file : info.fileName();
    const bool is_session = file.endsWith(".arris") || file.endsWith(".jsonl");
    folder_ =
        (is_session ? tr("Session") : tr("Scan")) + "  ·  " + QDir::toNativeSeparators(info.path());
    setToolTip(tr("Open %1").arg(QDir::toNativeSeparators(file)));
    setAccessibleName(name_);
    setAccessibleDescription(folder_);
    setAutoDefault(false);
    setFlat(true);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    setCursor(Qt::PointingHandCursor);
  }

  QSize sizeHint() const override { return QSize(200, 2 * fontMetrics().height() + 12); }
  QSize minimumSizeHint() const override { return QSize(80, sizeHint().height()); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    const QColor accent = palette().color(QPalette::Highlight);
    if (underMouse() || isDown()) {
      painter.fillRect(rect(),
                       mix(palette().color(QPalette::Window), accent, isDown() ? 0.3 : 0.15));
    }
    if (hasFocus()) {
      painter.setPen(QPen(accent, 2));
      painter.drawRect(rect().adjusted(1, 1, -1, -1));
    }
    QRect inner = rect().adjusted(8, 6, -8, -6);
    const int line = fontMetrics().height();
    if (!picture_.isNull()) {
      painter.setRenderHint(QPainter::SmoothPixmapTransform);
      const QSize size =
          picture_.size().scaled(width_of_picture, inner.height(), Qt::KeepAspectRatio);
      QRect place(QPoint(), size);
      place.moveCenter({inner.left() + width_of_picture / 2, inner.center().y()});
      painter.drawImage(place, picture_);
    }
    if (room_) inner.setLeft(inner.left() + width_of_picture + 8);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(inner.left(), inner.top(), inner.width(), line, Qt::AlignVCenter,
                     fontMetrics().elidedText(name_, Qt::ElideMiddle, inner.width()));
    painter.setPen(muted_text(palette()));
    painter.drawText(inner.left(), inner.top() + line, inner.width(), line, Qt::AlignVCenter,
                     fontMetrics().elidedText(folder_, Qt::ElideMiddle, inner.width()));
  }

 private:
  static constexpr int width_of_picture = 46;  // pixels
  QString name_, folder_;
  QImage picture_;
  bool room_;
};

/// Number of a step in the tour, in a circle.
class Number : public QWidget {
 public:
  Number(int number, QWidget* parent) : QWidget(parent), number_(number) { setFixedSize(26, 26); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().color(QPalette::Highlight));
    painter.drawEllipse(QRectF(1, 1, 24, 24));
    painter.setPen(palette().color(QPalette::HighlightedText));
    painter.setFont(scaled(font(), 1.0, true));
    painter.drawText(rect(), Qt::AlignCenter, QString::number(number_));
  }

 private:
  int number_;
};

/// Where a file may be dropped (in truth anywhere in the window).
class DropHint : public MutedLabel {
 public:
  using MutedLabel::MutedLabel;

 protected:
  void paintEvent(QPaintEvent* event) override {
    {
      QPainter painter(this);
      painter.setRenderHint(QPainter::Antialiasing);
      painter.setPen(
          QPen(mix(palette().color(QPalette::Window), palette().color(QPalette::WindowText), 0.4),
               1.4, Qt::DashLine));
      painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 6, 6);
    }
    MutedLabel::paintEvent(event);
  }
};

}  // namespace

class StartPage::Private {
 public:
  QBoxLayout* columns = nullptr;
  QBoxLayout* buttons = nullptr;
  QWidget* page = nullptr;
  QVBoxLayout* recent = nullptr;
  QVBoxLayout* steps = nullptr;
  MutedLabel* none = nullptr;
  std::vector<FileButton*> files;

  QLabel* heading(const QString& text) const {
    auto* label = new QLabel(text, page);
    label->setFont(scaled(label->font(), 1.15, true));
    return label;
  }

  QPushButton* big_button(const QString& text, const QString& tooltip) const {
    auto* button = new QPushButton(text, page);
    button->setToolTip(tooltip);
    button->setFont(scaled(button->font(), 1.15, false));
    button->setMinimumHeight(48);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    return button;
  }
};

StartPage::StartPage(QWidget* parent) : QWidget(parent), p_(std::make_unique<Private>()) {
  make_ground();
  auto* name = new QLabel(QStringLiteral("Arris"), p_->page);
  name->setFont(scaled(name->font(), 3.0, true));
  auto* sentence = new QLabel(tr("Finds the sharp lines and the partitions of a scanned mould, and "
                                 "keeps every step in your "
                                 "hands."),
                              p_->page);
  sentence->setFont(scaled(sentence->font(), 1.15, false));
  sentence->setWordWrap(true);
  make_buttons();
  auto* drop = new DropHint(tr("Drop a file here"), p_->page);
  drop->setAlignment(Qt::AlignCenter);
  drop->setMinimumHeight(56);
  drop->setToolTip(tr("PLY, STL, OBJ and OFF files can be dropped anywhere in this window."));
  p_->columns = new QHBoxLayout;
  p_->columns->setSpacing(32);
  p_->columns->addLayout(make_recent(), 1);
  p_->columns->addLayout(make_steps(), 1);

  auto* column = new QVBoxLayout(p_->page);
  column->setContentsMargins(20, 28, 20, 20);
  column->setSpacing(8);
  column->addStretch(1);
  column->addWidget(name);
  column->addWidget(sentence);
  column->addSpacing(14);
  column->addLayout(p_->buttons);
  column->addSpacing(4);
  column->addWidget(drop);
  column->addSpacing(20);
  column->addLayout(p_->columns);
  column->addStretch(2);
}

void StartPage::make_ground() {
  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(0, 0, 0, 0);
  outer->addWidget(scroll);

  auto* ground = new QWidget;
  scroll->setWidget(ground);
  p_->page = new QWidget(ground);
  p_->page->setMaximumWidth(widest);
  auto* centred = new QHBoxLayout(ground);
  centred->addStretch(1);
  centred->addWidget(p_->page, 100);
  centred->addStretch(1);
}

void StartPage::make_buttons() {
  auto* open = p_->big_button(tr("Open scan…"), tr("Opens a scan or a session from a file."));
  open->setDefault(true);
  auto* sample = p_->big_button(tr("Open the sample mould"),
                                tr("Opens a mould that comes with Arris, to try things out."));
  p_->buttons = new QHBoxLayout;
  p_->buttons->setSpacing(12);
  p_->buttons->addWidget(open);
  p_->buttons->addWidget(sample);
  connect(open, &QPushButton::clicked, this, &StartPage::open_wanted);
  connect(sample, &QPushButton::clicked, this, &StartPage::sample_wanted);
}

QBoxLayout* StartPage::make_recent() {
  auto* left = new QVBoxLayout;
  left->setSpacing(6);
  left->addWidget(p_->heading(tr("Recent files")));
  p_->none = new MutedLabel(tr("What you open will be listed here."), p_->page);
  p_->none->setWordWrap(true);
  left->addWidget(p_->none);
  p_->recent = new QVBoxLayout;
  p_->recent->setSpacing(0);
  left->addLayout(p_->recent);
  left->addStretch(1);
  return left;
}

QBoxLayout* StartPage::make_steps() {
  auto* right = new QVBoxLayout;
  right->setSpacing(10);
  auto* tour = new QPushButton(tr("Take the tour on the sample mould"), p_->page);
  tour->setToolTip(tr("Leads through the steps once, two minutes, each done by you."));
  tour->setAutoDefault(false);
  tour->setMinimumWidth(tour->sizeHint().width() + 16);
  auto* head = new QHBoxLayout;
  head->addWidget(p_->heading(tr("In five steps")));
  head->addStretch(1);
  head->addWidget(tour);
  right->addLayout(head);
  p_->steps = new QVBoxLayout;
  p_->steps->setSpacing(10);
  right->addLayout(p_->steps);
  right->addStretch(1);
  connect(tour, &QPushButton::clicked, this, &StartPage::tour_wanted);
  return right;
}

StartPage::~StartPage() = default;

void StartPage::set_recent(const QStringList& files, const QList<QImage>& pictures) {
  for (FileButton* button : p_->files) {
    // Maybe it is a click on one of them that leads here.
    button->hide();
    button->deleteLater();
  }
  p_->files.clear();
  const bool room = std::ranges::any_of(pictures, [](const QImage& p) { return !p.isNull(); });
  for (qsizetype k = 0; k < std::min<qsizetype>(files.size(), most_recent); ++k) {
    const QString& file = files[k];
    auto* button = new FileButton(file, pictures.value(k), room, p_->page);
    connect(button, &QPushButton::clicked, this, [this, file] { emit recent_wanted(file); });
    p_->recent->addWidget(button);
    p_->files.push_back(button);
  }
  p_->none->setVisible(files.isEmpty());
}

void StartPage::add_step(const QString& title, const QString& gist) {
  auto* row = new QHBoxLayout;
  row->setSpacing(10);
  row->addWidget(new Number(p_->steps->count() + 1, p_->page), 0, Qt::AlignTop);
  auto* words = new QVBoxLayout;
  words->setSpacing(1);
  auto* name = new QLabel(title, p_->page);
  name->setFont(scaled(name->font(), 1.0, true));
  auto* note = new MutedLabel(gist, p_->page);
  note->setWordWrap(true);
  words->addWidget(name);
  words->addWidget(note);
  row->addLayout(words, 1);
  p_->steps->addLayout(row);
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const auto direction = width() < one_column ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight;
  p_->columns->setDirection(direction);
  p_->buttons->setDirection(width() < 440 ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

}  // namespace arris::ui
