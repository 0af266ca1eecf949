// arris: the window.

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string_view>

#include <QApplication>
#include <QCommandLineParser>
#include <QFileInfo>
#include <QIcon>
#include <QMessageBox>
#include <QTimer>

#include "app/window_manual.h"
#include "core/document/flow.h"
#include "ui/view/graphics.h"
#include "ui/window/about_dialog.h"
#include "ui/window/log_file.h"
#include "ui/window/main_window.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/theme.h"

namespace {

using namespace arris;
using namespace arris::ui;

constexpr int bad_input = 1;
constexpr int bad_usage = 2;
constexpr int no_graphics = 3;

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

/// What happens, for who has to find out later what went wrong.
void keep_log_of(Session& session) {
  QObject::connect(&session, &Session::opened, [&session] {
    const LoadReport& scan = session.current().document.scan->report;
    program_log().write(
        QString("opened %1: %2, %3 faces, %4 rows")
            .arg(QString::fromStdString(scan.file), QString::fromStdString(scan.format))
            .arg(scan.faces)
            .arg(session.history().entries().size()));
  });
  QObject::connect(&session, &Session::done, [&session](const QString& operation) {
    program_log().write(
        QString("%1: %2 s").arg(operation).arg(session.seconds_of(operation.toStdString())));
  });
  QObject::connect(&session, &Session::failed,
                   [](const QString& message) { program_log().write("told: " + message); });
}

constexpr const char* manual_option = "manual-page";  ///< For the build.

/// Asked for help, the version or the manual: that needs neither display nor graphics.
bool only_tells(int argc, char** argv) {
  return std::any_of(argv + std::min(argc, 1), argv + argc, [](const char* argument) {
    const std::string_view text = argument;
    return text == "--help" || text == "-h" || text == "--version" || text == "-v" ||
           (text.starts_with("--") && text.substr(2) == manual_option);
  });
}

}  // namespace

int main(int argc, char** argv) {
  prefer_glx();
  if (only_tells(argc, argv)) qputenv("QT_QPA_PLATFORM", "offscreen");
  if (const QString why = why_no_display(); !why.isEmpty()) return complain(why, no_graphics);
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QApplication application(argc, argv);
  QApplication::setApplicationName("arris");
  QApplication::setOrganizationName("arris");
  QApplication::setApplicationDisplayName("Arris");
  QApplication::setApplicationVersion(ARRIS_VERSION);
  QApplication::setDesktopFileName("org.arris.Arris");
  QApplication::setWindowIcon(QIcon(":/org.arris.Arris.png"));
  QLocale::setDefault(QLocale::c());

  QCommandLineParser parser;
  parser.setApplicationDescription("Segments scanned moulds: sharp lines, curvature, partitions.");
  QList<QCommandLineOption> told{parser.addHelpOption(), parser.addVersionOption()};
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
  const QCommandLineOption unit(
      "unit",
      "What lengths of the scan are in: " + QString::fromStdString(length_unit_keys()) +
          "; left out: as the file says.",
      "U");
  const QCommandLineOption report(
      "report", "Open, write the report with its pictures there and exit.", "FOLDER");
  const QCommandLineOption view("view", "With --screenshot: the view of this name.", "NAME");
  const QCommandLineOption window("window", "With --screenshot: the whole window.");
  QCommandLineOption manual(manual_option);
  manual.setFlags(QCommandLineOption::HiddenFromHelp);
  told << sample << screenshot << field << size << run << flow << unit << window << report << view;
  parser.addOptions(told.sliced(2));
  parser.addOption(manual);
  if (!parser.parse(application.arguments())) return complain(parser.errorText(), bad_usage);
  if (parser.isSet("help")) parser.showHelp();
  if (parser.isSet("version")) parser.showVersion();
  if (parser.isSet(manual))
    return std::fputs(window_manual(parser, told).c_str(), stdout) < 0 ? bad_input : 0;
  if (parser.positionalArguments().size() > 1)
    return complain("more than one scan was named; Arris opens one.", bad_usage);

  std::optional<Field> wanted_field;
  if (parser.isSet(field)) {
    wanted_field = find_field(parser.value(field).toStdString());
    if (!wanted_field)
      return complain("--field " + parser.value(field) + " is not one of " + fields + ".",
                      bad_usage);
  }
  std::optional<LengthUnit> wanted_unit;
  if (parser.isSet(unit)) {
    wanted_unit = find_length_unit(parser.value(unit).toStdString());
    if (!wanted_unit)
      return complain("--unit " + parser.value(unit) + " is not one of " +
                          QString::fromStdString(length_unit_keys()) + ".",
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
  const QString picture = parser.value(screenshot);
  const bool write_report = parser.isSet(report);
  const bool shoot = parser.isSet(screenshot) || write_report;  // then exit
  log_warnings();
  if (const QString why = why_nothing_can_be_drawn(); !why.isEmpty()) {
    program_log().write(why);
    complain(why, no_graphics);
    if (!shoot) QMessageBox::critical(nullptr, "Arris", why);
    return no_graphics;
  }
  program_log().write("started: " + made_of().join(", ") + "; " + graphics_text());
  MainWindow main_window;
  Session& session = main_window.session();
  keep_log_of(session);
  if (shoot && parser.positionalArguments().isEmpty() && !parser.isSet(sample))
    return complain("--screenshot and --report need a scan to draw.", bad_usage);

  // After opening: the wanted field, unit and steps, then the picture where one is wanted.
  const auto last = std::make_shared<QString>();  // operation before the picture
  const auto save = std::make_shared<std::function<void()>>();
  QObject::connect(&session, &Session::opened, &main_window, [&, last, save] {
    if (wanted_field) main_window.set_field(*wanted_field);
    std::vector<Operation> operations;
    if (wanted_unit && *wanted_unit != length_unit_of(session.current().document))
      operations.push_back({"set_unit", {{"unit", info_of(*wanted_unit).key}}});
    if (parser.isSet(run))
      for (Operation& operation :
           operations_of(parser.value(flow) == "paper" ? Flow::paper : Flow::scan))
        operations.push_back(std::move(operation));
    if (operations.empty()) {
      if (*save) (*save)();
      return;
    }
    *last = QString::fromStdString(operations.back().name);
    QTimer::singleShot(0, &main_window, [&session, operations] { session.run(operations); });
  });
  if (shoot) {
    QObject::disconnect(&session, &Session::failed, nullptr, nullptr);
    QObject::connect(&session, &Session::failed, &main_window, [](const QString& message) {
      QApplication::exit(complain(message, bad_input));
    });
    QObject::disconnect(&session, &Session::scan_lost, nullptr, nullptr);
    QObject::connect(
        &session, &Session::scan_lost, &main_window, [](const QString& name, const QString& lost) {
          QApplication::exit(
              complain(name + " was made on " + lost + ", which is not there.", bad_input));
        });
    const auto end = [&session](const QString& error) {
      session.close();  // nothing that the next start would have to offer
      QApplication::exit(error.isEmpty() ? 0 : complain(error, bad_input));
    };
    const auto shoot_now = [&, end, picture, width, height] {
      QString error;
      if (write_report) {
        ReportRequest request;
        request.folder = QFileInfo(parser.value(report)).absoluteFilePath().toStdString();
        main_window.reports().write(request, true, end);
        return;
      }
      if (parser.isSet(view)) {
        const QString name = parser.value(view);
        const auto place = main_window.named_views().find(name);
        if (!place) return end("there is no named view \"" + name + "\" in this session.");
        main_window.named_views().show(*place);
        main_window.fields().wait_until_there();
      }
      if (parser.isSet(window)) {
        if (!main_window.grab().save(picture)) error = picture + " could not be written.";
      } else {
        PictureOptions options;
        options.size = {width, height};
        main_window.save_picture(picture, options, &error);
      }
      end(error);
    };
    *save = [&, shoot_now] {
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
    QObject::connect(&session, &Session::done, &main_window, [last, save](const QString& name) {
      if (name == *last) (*save)();
    });
    // Pictures of a report are as wide as the view between its panels.
    const QSize least = write_report ? QSize(1600, 1000) : QSize(1000, 700);
    main_window.resize(main_window.size().expandedTo(least));
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
