// Pictures as they are asked for in the window: in pixels, or on paper to scale.

#include <cmath>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTimer>

#include "tests/ui/window_fixture.h"
#include "ui/window/picture_dialog.h"

namespace arris::ui {
namespace {

class SavePicture : public MainWindowTest {
 protected:
  /// Ctrl+P, what is done in the dialog, and the picture that is written.
  QImage saved(const std::function<void(PictureDialog&)>& act) {
    const QString path = folder.filePath("picture.png");
    bool asked = false, chosen = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
      QWidget* modal = QApplication::activeModalWidget();
      if (auto* files = qobject_cast<QFileDialog*>(modal)) {
        if (std::exchange(chosen, true)) return;
        files->findChild<QLineEdit*>()->setText(path);
        QMetaObject::invokeMethod(files, "accept");
      } else if (auto* dialog = qobject_cast<PictureDialog*>(modal); dialog && !asked) {
        asked = true;
        act(*dialog);
        dialog->accept();
      }
    });
    timer.start(20);
    press(Qt::Key_P, Qt::ControlModifier);
    EXPECT_TRUE(QTest::qWaitFor([&] { return asked && chosen; }, patience));
    QImage image(path);
    QFile::remove(path);
    return image;
  }
  static void choose(PictureDialog& dialog, const char* name, const QString& text) {
    auto* box = dialog.findChild<QComboBox*>(name);
    box->setCurrentIndex(box->findText(text));
    EXPECT_EQ(box->currentText(), text);
  }
  static void without_extras(PictureDialog& dialog) {
    for (QCheckBox* box : dialog.findChildren<QCheckBox*>())
      if (box->text() != "Proportion of the view") box->setChecked(false);
  }
  /// Columns in which something is on the white ground.
  static int wide(const QImage& image) {
    int first = image.width(), last = -1;
    for (int x = 0; x < image.width(); ++x)
      for (int y = 0; y < image.height(); ++y)
        if (image.pixel(x, y) != qRgb(255, 255, 255)) {
          first = std::min(first, x);
          last = std::max(last, x);
          break;
        }
    return last - first + 1;
  }
  const QTemporaryDir folder;
};

TEST_F(SavePicture, TitleAndThresholdsStandUnderThePartAndAreRemembered) {
  open_sample();
  run({"find_sharp_lines"});
  window->view().look_from(MeshView::StandardView::top);
  const QImage bare = saved([&](PictureDialog& dialog) { without_extras(dialog); });
  QString said;
  const QImage titled = saved([&](PictureDialog& dialog) {
    EXPECT_FALSE(dialog.findChild<QCheckBox*>("picture_titled")->isChecked()) << "remembered";
    dialog.findChild<QCheckBox*>("picture_titled")->setChecked(true);
    EXPECT_EQ(dialog.findChild<QLineEdit*>("picture_title")->text(), "sample_mould");
    dialog.findChild<QLineEdit*>("picture_title")->setText("Cover, second try");
    auto* thresholds = dialog.findChild<QCheckBox*>("picture_thresholds");
    EXPECT_TRUE(thresholds->toolTip().contains("Find sharp lines, "));
    thresholds->setChecked(true);
    said = dialog.options().caption;
  });
  EXPECT_TRUE(said.startsWith("Cover, second try\nFind sharp lines, ")) << said.toStdString();
  EXPECT_TRUE(said.contains(" lines, ")) << "what was found";
  ASSERT_EQ(bare.size(), titled.size());
  int above = 0, below = 0;  // pixels that differ
  for (int y = 0; y < bare.height(); ++y)
    for (int x = 0; x < bare.width(); ++x)
      (y < bare.height() * 4 / 5 ? above : below) += bare.pixel(x, y) != titled.pixel(x, y);
  EXPECT_EQ(above, 0) << "the part is where it was";
  EXPECT_GT(below, 1000);
}

TEST_F(SavePicture, OnPaperIsToScaleAndSaysItsResolution) {
  open_sample();
  window->view().look_from(MeshView::StandardView::top);
  window->view().set_legend_visible(false);
  const Mesh& mesh = *document().mesh;
  const double part = mesh.box_max().x() - mesh.box_min().x();  // mm, as the sample says
  for (const auto& [scale, factor] :
       std::vector<std::pair<QString, double>>{{"1:1", 1.0}, {"1:2", 0.5}}) {
    const QImage image = saved([&, scale = scale](PictureDialog& dialog) {
      choose(dialog, "picture_unit", "Millimetres");
      dialog.findChild<QSpinBox*>("picture_dots")->setValue(150);
      dialog.findChild<QCheckBox*>()->setChecked(false);  // the proportion
      dialog.findChild<QDoubleSpinBox*>("picture_width")->setValue(160.0);
      dialog.findChild<QDoubleSpinBox*>("picture_height")->setValue(150.0);
      EXPECT_TRUE(dialog.findChild<QComboBox*>("picture_scale")->isEnabled());
      const auto* pixels = dialog.findChild<QLabel*>("picture_pixels");
      choose(dialog, "picture_scale", "2:1");
      EXPECT_TRUE(pixels->text().contains(QString::number(std::ceil(2.0 * part)) + " ×"))
          << pixels->text().toStdString();
      choose(dialog, "picture_scale", scale);
      EXPECT_FALSE(pixels->text().contains("does not fit")) << pixels->text().toStdString();
      without_extras(dialog);
    });
    ASSERT_FALSE(image.isNull());
    EXPECT_NEAR(image.width(), 160.0 / 25.4 * 150.0, 1.0);
    EXPECT_NEAR(image.height(), 150.0 / 25.4 * 150.0, 1.0);
    EXPECT_NEAR(image.dotsPerMeterX(), 150.0 / 0.0254, 1.0);
    EXPECT_NEAR(wide(image), part * factor / 25.4 * 150.0, 4.0) << factor;
  }
}

TEST_F(SavePicture, InPixelsHasNoScaleAndIsRemembered) {
  open_sample();
  QImage image = saved([&](PictureDialog& dialog) {
    choose(dialog, "picture_unit", "Pixels");
    EXPECT_FALSE(dialog.findChild<QComboBox*>("picture_scale")->isEnabled());
    EXPECT_FALSE(dialog.findChild<QSpinBox*>("picture_dots")->isEnabled());
    dialog.findChild<QCheckBox*>()->setChecked(false);
    dialog.findChild<QDoubleSpinBox*>("picture_width")->setValue(700.0);
    dialog.findChild<QDoubleSpinBox*>("picture_height")->setValue(500.0);
    // To and fro: the same.
    choose(dialog, "picture_unit", "Millimetres");
    EXPECT_NEAR(dialog.findChild<QDoubleSpinBox*>("picture_width")->value(),
                700.0 / dialog.findChild<QSpinBox*>("picture_dots")->value() * 25.4, 0.06);
    choose(dialog, "picture_unit", "Pixels");
  });
  EXPECT_NEAR(image.width(), 700, 1);
  EXPECT_NEAR(image.height(), 500, 1);
  image = saved([&](PictureDialog& dialog) {
    EXPECT_EQ(dialog.findChild<QComboBox*>("picture_unit")->currentText(), "Pixels");
  });
  EXPECT_FALSE(image.isNull());
}

}  // namespace
}  // namespace arris::ui
