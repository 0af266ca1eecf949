// arris: the window.

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

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
#include "ui/window/field_presenter.h"
#include "ui/window/log_file.h"
#include "ui/window/main_window.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/session.h"
#include "ui/window/theme.h"
#include "ui/window/tour_presenter.h"

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

/// What the command line asks for.
struct Wanted {
  QString scan;  ///< Empty: none is named.
  bool sample = false;
  bool run = false;
  Flow flow = Flow::scan;
  std::optional<Field> field;
  std::optional<LengthUnit> unit;
  QString picture, report;  ///< Written, and the program ends; empty: not.
  QString view;             ///< Of the picture, by its name; empty: as it is opened.
  bool whole_window = false;
  QSize size;  ///< Of the picture.

  bool ends() const { return !picture.isEmpty() || !report.isEmpty(); }
};

/// The command line of the window.
class WindowOptions {
 public:
  WindowOptions() {
    parser_.setApplicationDescription(
        "Segments scanned moulds: sharp lines, curvature, partitions.");
    told_ = {parser_.addHelpOption(), parser_.addVersionOption()};
    parser_.addPositionalArgument("SCAN", "Scan (STL, PLY, OBJ, OFF, 3MF) or session to open.",
                                  "[SCAN]");
    const QList<QCommandLineOption> own{sample_, screenshot_, field_,  size_,   run_,
                                        flow_,   unit_,       window_, report_, view_};
    told_ << own;
    parser_.addOptions(own);
    QCommandLineOption manual(manual_option);
    manual.setFlags(QCommandLineOption::HiddenFromHelp);
    parser_.addOption(manual);
  }

  /// Reads it. An exit code where nothing is to be opened.
  std::optional<int> read(const QStringList& arguments, Wanted& wanted) {
    if (!parser_.parse(arguments)) return complain(parser_.errorText(), bad_usage);
    if (parser_.isSet("help")) parser_.showHelp();
    if (parser_.isSet("version")) parser_.showVersion();
    if (parser_.isSet(manual_option))
      return std::fputs(window_manual(parser_, told_).c_str(), stdout) < 0 ? bad_input : 0;
    if (parser_.positionalArguments().size() > 1)
      return complain("more than one scan was named; Arris opens one.", bad_usage);
    wanted.scan = parser_.positionalArguments().value(0);
    wanted.sample = parser_.isSet(sample_);
    wanted.run = parser_.isSet(run_);
    wanted.picture = parser_.value(screenshot_);
    if (parser_.isSet(report_))
      wanted.report = QFileInfo(parser_.value(report_)).absoluteFilePath();
    wanted.view = parser_.value(view_);
    wanted.whole_window = parser_.isSet(window_);
    const QString fault = read_values(wanted);
    if (!fault.isEmpty()) return complain(fault, bad_usage);
    if (wanted.ends() && wanted.scan.isEmpty() && !wanted.sample)
      return complain("--screenshot and --report need a scan to draw.", bad_usage);
    return std::nullopt;
  }

 private:
  /// Those of a few values; what is wrong with one, as a sentence.
  QString read_values(Wanted& wanted) const {
    if (parser_.isSet(field_)) {
      wanted.field = find_field(parser_.value(field_).toStdString());
      if (!wanted.field)
        return "--field " + parser_.value(field_) + " is not one of " + field_names() + ".";
    }
    if (parser_.isSet(unit_)) {
      wanted.unit = find_length_unit(parser_.value(unit_).toStdString());
      if (!wanted.unit)
        return "--unit " + parser_.value(unit_) + " is not one of " +
               QString::fromStdString(length_unit_keys()) + ".";
    }
    const QString flow = parser_.value(flow_);
    if (flow != "scan" && flow != "paper") return "--flow " + flow + " is neither scan nor paper.";
    wanted.flow = flow == "paper" ? Flow::paper : Flow::scan;
    constexpr int least = 16, most = 16384;  // pixels
    const QStringList parts = parser_.value(size_).split('x');
    bool good_width = false, good_height = false;
    wanted.size = {parts.value(0).toInt(&good_width), parts.value(1).toInt(&good_height)};
    if (parts.size() != 2 || !good_width || !good_height ||
        wanted.size.expandedTo({least, least}).boundedTo({most, most}) != wanted.size)
      return "--size " + parser_.value(size_) + " is not WIDTHxHEIGHT in pixels.";
    return {};
  }

  QCommandLineParser parser_;
  QList<QCommandLineOption> told_;  // that the manual page lists
  const QCommandLineOption sample_{"sample", "Open the sample mould."};
  const QCommandLineOption screenshot_{"screenshot", "Open, draw, save the picture and exit.",
                                       "OUT.png"};
  const QCommandLineOption field_{"field", "Field to show: " + field_names() + ".", "F"};
  const QCommandLineOption size_{"size", "Size of the picture in pixels (1600x1200).", "WxH",
                                 "1600x1200"};
  const QCommandLineOption run_{"run", "Find sharp lines and partitions after opening."};
  const QCommandLineOption flow_{
      "flow",
      "With --run: scan, the scan as it is; or paper, simplified first and equilateralised (scan).",
      "FLOW", "scan"};
  const QCommandLineOption unit_{
      "unit",
      "What lengths of the scan are in: " + QString::fromStdString(length_unit_keys()) +
          "; left out: as the file says.",
      "U"};
  const QCommandLineOption report_{
      "report", "Open, write the report with its pictures there and exit.", "FOLDER"};
  const QCommandLineOption view_{"view", "With --screenshot: the view of this name.", "NAME"};
  const QCommandLineOption window_{"window", "With --screenshot: the whole window."};
};

/// Does with the window what the command line asks for: the wanted field, unit and steps once the
/// part is open, then the picture or the report.
class Starting {
 public:
  Starting(MainWindow& window, const Wanted& wanted)
      : window_(window), session_(window.session()), wanted_(wanted) {
    QObject::connect(&session_, &Session::opened, &window_, [this] { take_opened(); });
    QObject::connect(&session_, &Session::done, &window_, [this](const QString& name) {
      if (wanted_.ends() && name == last_) write_once_settled();
    });
    if (wanted_.ends()) fail_aloud();
  }

  void open() {
    const bool by_hand = !wanted_.ends() && !wanted_.run;
    if (by_hand) window_.tour().offer();
    window_.show();
    // What a crash left behind comes before what was asked for: it would be forgotten otherwise.
    if (by_hand && window_.offer_recovery()) return;
    if (!wanted_.scan.isEmpty())
      window_.open(wanted_.scan);
    else if (wanted_.sample)
      window_.open_sample();
  }

 private:
  /// Nobody is there to answer.
  void fail_aloud() {
    QObject::disconnect(&session_, &Session::failed, nullptr, nullptr);
    QObject::connect(&session_, &Session::failed, &window_, [](const QString& message) {
      QApplication::exit(complain(message, bad_input));
    });
    QObject::disconnect(&session_, &Session::scan_lost, nullptr, nullptr);
    QObject::connect(
        &session_, &Session::scan_lost, &window_, [](const QString& name, const QString& lost) {
          QApplication::exit(
              complain(name + " was made on " + lost + ", which is not there.", bad_input));
        });
    // Pictures of a report are as wide as the view between its panels.
    const QSize least = wanted_.report.isEmpty() ? QSize(1000, 700) : QSize(1600, 1000);
    window_.resize(window_.size().expandedTo(least));
  }

  void take_opened() {
    if (wanted_.field) window_.set_field(*wanted_.field);
    std::vector<Operation> operations;
    if (wanted_.unit && *wanted_.unit != length_unit_of(session_.current().document))
      operations.push_back({"set_unit", {{"unit", info_of(*wanted_.unit).key}}});
    if (wanted_.run)
      for (Operation& operation : operations_of(wanted_.flow))
        operations.push_back(std::move(operation));
    if (!operations.empty()) {
      last_ = QString::fromStdString(operations.back().name);
      QTimer::singleShot(0, &window_, [this, operations] { session_.run(operations); });
    } else if (wanted_.ends()) {
      write_once_settled();
    }
  }

  void write_once_settled() {
    if (wanted_.field) window_.set_field(*wanted_.field);
    constexpr int settles = 300;  // ms
    auto* waiting = new QTimer(&window_);
    QObject::connect(waiting, &QTimer::timeout, &window_, [this, waiting] {
      if (window_.fields().working()) return;
      waiting->stop();
      write();
    });
    waiting->start(settles);
  }

  void write() {
    if (!wanted_.report.isEmpty()) {
      ReportRequest request;
      request.folder = wanted_.report.toStdString();
      window_.reports().write(request, true, [this](const QString& error) { end(error); });
      return;
    }
    if (!wanted_.view.isEmpty()) {
      const auto place = window_.named_views().find(wanted_.view);
      if (!place) return end("there is no named view \"" + wanted_.view + "\" in this session.");
      window_.named_views().show(*place);
      window_.fields().wait_until_there();
    }
    QString error;
    if (wanted_.whole_window) {
      if (!window_.grab().save(wanted_.picture)) error = wanted_.picture + " could not be written.";
    } else {
      PictureOptions options;
      options.size = wanted_.size;
      window_.save_picture(wanted_.picture, options, &error);
    }
    end(error);
  }

  void end(const QString& error) {
    session_.close();  // nothing that the next start would have to offer
    QApplication::exit(error.isEmpty() ? 0 : complain(error, bad_input));
  }

  MainWindow& window_;
  Session& session_;
  Wanted wanted_;
  QString last_;  // operation before the picture
};

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

  Wanted wanted;
  if (const auto code = WindowOptions().read(application.arguments(), wanted)) return *code;
  set_theme(application, false);
  log_warnings();
  if (const QString why = why_nothing_can_be_drawn(); !why.isEmpty()) {
    program_log().write(why);
    complain(why, no_graphics);
    if (!wanted.ends()) QMessageBox::critical(nullptr, "Arris", why);
    return no_graphics;
  }
  program_log().write("started: " + made_of().join(", ") + "; " + graphics_text());
  MainWindow window;
  keep_log_of(window.session());
  Starting starting(window, wanted);
  starting.open();
  return QApplication::exec();
}
