// arris: the window.

#include <cstdio>

#include <QApplication>
#include <QCommandLineParser>
#include <QTimer>

#include "core/document/flow.h"
#include "ui/window/main_window.h"
#include "ui/window/theme.h"

namespace {

using namespace arris;
using namespace arris::ui;

constexpr int bad_input = 1;
constexpr int bad_usage = 2;

/// Debian's VTK loads OpenGL through GLX (shared knowledge of Qt 6 with VTK 9.1); what the user set
/// is left alone.
void prefer_glx() {
#ifdef __linux__
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "xcb");
  if (!qEnvironmentVariableIsSet("QT_XCB_GL_INTEGRATION"))
    qputenv("QT_XCB_GL_INTEGRATION", "xcb_glx");
#endif
}

/// As they are typed: with quotes where there is a space in one.
QString field_names() {
  QStringList names;
  for (const FieldInfo& info : field_table()) {
    const QString name = QString::fromUtf8(info.name.data(), qsizetype(info.name.size()));
    names << (name.contains(' ') ? '"' + name + '"' : name);
  }
  return names.join(' ');
}

int complain(const QString& message, int code) {
  std::fprintf(stderr, "arris: %s\n", qPrintable(message));
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  prefer_glx();
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QApplication application(argc, argv);
  QApplication::setApplicationName("arris");
  QApplication::setOrganizationName("arris");
  QApplication::setApplicationDisplayName("Arris");
  QApplication::setApplicationVersion(ARRIS_VERSION);
  QLocale::setDefault(QLocale::c());

  QCommandLineParser parser;
  parser.setApplicationDescription("Segments scanned moulds: sharp lines, curvature, partitions.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument("SCAN", "Scan (STL, PLY, OBJ, OFF, 3MF) or session to open.",
                               "[SCAN]");
  const QCommandLineOption sample("sample", "Open the sample mould.");
  const QCommandLineOption screenshot("screenshot", "Open, draw, save the picture and exit.",
                                      "OUT.png");
  const QString fields = field_names();
  const QCommandLineOption field("field", "Field to show: " + fields + ".", "F");
  const QCommandLineOption size("size", "Size of the picture in pixels (1600x1200).", "WxH",
                                "1600x1200");
  const QCommandLineOption run("run", "Find sharp lines and partitions after opening.");
  const QCommandLineOption flow(
      "flow",
      "With --run: scan, the scan as it is; or paper, simplified first and equilateralised (scan).",
      "FLOW", "scan");
  const QCommandLineOption window("window", "With --screenshot: the whole window.");
  parser.addOptions({sample, screenshot, field, size, run, flow, window});
  if (!parser.parse(application.arguments())) return complain(parser.errorText(), bad_usage);
  if (parser.isSet("help")) parser.showHelp();
  if (parser.isSet("version")) parser.showVersion();
  if (parser.positionalArguments().size() > 1)
    return complain("more than one scan was named; Arris opens one.", bad_usage);

  std::optional<Field> wanted_field;
  if (parser.isSet(field)) {
    wanted_field = find_field(parser.value(field).toStdString());
    if (!wanted_field)
      return complain("--field " + parser.value(field) + " is not one of " + fields + ".",
                      bad_usage);
  }
  if (parser.value(flow) != "scan" && parser.value(flow) != "paper")
    return complain("--flow " + parser.value(flow) + " is neither scan nor paper.", bad_usage);
  const QStringList parts = parser.value(size).split('x');
  bool good_width = false, good_height = false;
  const int width = parts.value(0).toInt(&good_width);
  const int height = parts.value(1).toInt(&good_height);
  if (parts.size() != 2 || !good_width || !good_height || width < 16 || height < 16 ||
      width > 16384 || height > 16384)
    return complain("--size " + parser.value(size) + " is not WIDTHxHEIGHT in pixels.", bad_usage);

  set_theme(application, false);
  MainWindow main_window;
  Session& session = main_window.session();
  const QString picture = parser.value(screenshot);
  const bool shoot = parser.isSet(screenshot);
  if (shoot && parser.positionalArguments().isEmpty() && !parser.isSet(sample))
    return complain("--screenshot needs a scan to draw.", bad_usage);

  // After opening: the wanted field and steps, then the picture where one is wanted.
  QObject::connect(&session, &Session::opened, &main_window, [&] {
    if (wanted_field) main_window.set_field(*wanted_field);
    if (parser.isSet(run))
      QTimer::singleShot(0, &main_window, [&] {
        session.run(operations_of(parser.value(flow) == "paper" ? Flow::paper : Flow::scan));
      });
  });
  if (shoot) {
    QObject::disconnect(&session, &Session::failed, nullptr, nullptr);
    QObject::connect(&session, &Session::failed, &main_window, [](const QString& message) {
      QApplication::exit(complain(message, bad_input));
    });
    const auto shoot_now = [&, picture, width, height] {
      QString error;
      if (parser.isSet(window)) {
        if (!main_window.grab().save(picture)) error = picture + " could not be written.";
      } else {
        PictureOptions options;
        options.size = {width, height};
        main_window.save_picture(picture, options, &error);
      }
      session.close();  // nothing that the next start would have to offer
      QApplication::exit(error.isEmpty() ? 0 : complain(error, bad_input));
    };
    const auto save = [&, shoot_now] {
      if (wanted_field) main_window.set_field(*wanted_field);
      // Once everything has settled, and the field is there.
      auto* waiting = new QTimer(&main_window);
      QObject::connect(waiting, &QTimer::timeout, &main_window, [&, waiting, shoot_now] {
        if (main_window.fields().working()) return;
        waiting->stop();
        shoot_now();
      });
      waiting->start(300);
    };
    const QString last = parser.isSet(run) ? "find_partitions" : "open";
    QObject::connect(&session, &Session::done, &main_window, [last, save](const QString& name) {
      if (name == last) save();
    });
    main_window.resize(std::max(main_window.width(), 1000), std::max(main_window.height(), 700));
  }
  if (!shoot && !parser.isSet(run)) main_window.tour().offer();
  main_window.show();
  // What a crash left behind comes before what was asked for: it would be forgotten otherwise.
  if (!shoot && !parser.isSet(run) && main_window.offer_recovery()) {
  } else if (!parser.positionalArguments().isEmpty()) {
    main_window.open(parser.positionalArguments().first());
  } else if (parser.isSet(sample)) {
    main_window.open_sample();
  }
  return QApplication::exec();
}
