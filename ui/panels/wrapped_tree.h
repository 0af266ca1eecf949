#pragma once

#include <QTreeWidget>

namespace arris::ui {

/// Tree whose first column is wrapped over as many lines as it needs, and that says why it is
/// empty.
class WrappedTree : public QTreeWidget {
  Q_OBJECT
 public:
  explicit WrappedTree(QWidget* parent = nullptr);
  void set_empty_text(const QString& text);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QString empty_text_;
};

}  // namespace arris::ui
