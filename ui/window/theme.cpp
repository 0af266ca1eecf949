#include "ui/window/theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>

namespace arris::ui {

void set_theme(QApplication& application, bool dark) {
  if (application.style()->name() != "fusion")
    application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  const QColor accent = dark ? QColor(86, 156, 214) : QColor(28, 100, 172);
  const QColor window = dark ? QColor(43, 45, 48) : QColor(242, 242, 240);
  const QColor base = dark ? QColor(30, 31, 34) : QColor(255, 255, 255);
  const QColor text = dark ? QColor(220, 221, 222) : QColor(32, 33, 36);
  const QColor faint = dark ? QColor(128, 130, 133) : QColor(140, 142, 146);
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::WindowText, text);
  palette.setColor(QPalette::Base, base);
  palette.setColor(QPalette::AlternateBase, dark ? QColor(37, 39, 42) : QColor(247, 247, 245));
  palette.setColor(QPalette::Text, text);
  palette.setColor(QPalette::PlaceholderText, faint);
  palette.setColor(QPalette::Button, dark ? QColor(60, 63, 66) : QColor(236, 236, 233));
  palette.setColor(QPalette::ButtonText, text);
  palette.setColor(QPalette::BrightText, Qt::white);
  palette.setColor(QPalette::Highlight, accent);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::Link, accent);
  palette.setColor(QPalette::ToolTipBase, dark ? QColor(60, 63, 66) : QColor(255, 255, 240));
  palette.setColor(QPalette::ToolTipText, text);
  for (const QPalette::ColorRole role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
    palette.setColor(QPalette::Disabled, role, faint);
  // The style writes disabled entries of menus a second time in this, beside themselves.
  palette.setColor(QPalette::Disabled, QPalette::Light, base);
  application.setPalette(palette);
}

}  // namespace arris::ui
