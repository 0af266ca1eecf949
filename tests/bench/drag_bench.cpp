// How soon the picture follows a threshold that is dragged, in the real window. Not a test:
// figures.
//
//   arris_drag_bench SCAN|FACES [SECONDS]
//
// A number of faces makes the sample mould that fine. TV_IH on the normal jump, TV_IH on IHe (walk)
// and Kmax on Kabs (fronts) are dragged for SECONDS (5) each, a move every 8 ms as a mouse gives
// them: new pictures a second; the time from a move to the picture of its result; where the UI
// thread spends it for each picture, and what the operation alone takes.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include <QApplication>
#include <QSettings>
#include <QStandardPaths>
#include <QTest>
#include <QTimer>

#include "core/base/number_text.h"
#include "tests/support/documents.h"
#include "ui/panels/histogram_panel.h"
#include "ui/window/main_window.h"
#include "ui/window/session.h"

namespace arris::ui {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration spent) {
  return std::chrono::duration<double, std::milli>(spent).count();
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Takes the time of events by what they are for.
class TimedApplication : public QApplication {
 public:
  using QApplication::QApplication;
  struct Spent {
    double results = 0.0;  ///< Taking over what the worker found: presenters.
    double paint = 0.0;    ///< Of the view.
    double mouse = 0.0;    ///< Moves of the handle.
    double all = 0.0;
  };
  Spent spent;

  bool notify(QObject* receiver, QEvent* event) override {
    const QEvent::Type type = event->type();
    const bool outer = depth_ == 0;
    double* const counted = type == QEvent::MetaCall ? &spent.results
                            : type == QEvent::Paint && receiver->inherits("QOpenGLWidget")
                                ? &spent.paint
                            : type == QEvent::MouseMove && outer ? &spent.mouse
                                                                 : nullptr;
    if (!outer && !counted) return QApplication::notify(receiver, event);
    ++depth_;
    const auto begin = Clock::now();
    const bool done = QApplication::notify(receiver, event);
    const double time = milliseconds(Clock::now() - begin);
    --depth_;
    if (counted) *counted += time;
    if (outer) spent.all += time;
    return done;
  }

 private:
  int depth_ = 0;
};

/// The value of the threshold that a document was made with.
double value_in(const Document& document, bool lines) {
  const auto& step = lines ? document.step("find_sharp_lines") : document.step("find_partitions");
  if (!step) return -1.0;
  if (lines) return step->parameters["angle"];
  const auto& end = step->parameters["intervals"][0][1];
  return end.is_number() ? end.get<double>() : -1.0;
}

void drag(TimedApplication& application, MainWindow& window, const char* name, bool lines,
          double seconds) {
  HistogramPanel& histogram = window.histogram();
  Session& session = window.session();
  struct Move {
    Clock::time_point at;
    double value;
  };
  std::vector<Move> moves;
  std::size_t shown = 0;  // moves before this one are seen
  std::vector<double> delays, values;
  const auto dragged = QObject::connect(&histogram, &HistogramPanel::threshold_dragged, &window,
                                        [&](int, double value) {
                                          moves.push_back({Clock::now(), rounded(value, 4)});
                                        });
  double last = value_in(session.shown().document, lines);
  const auto swapped = QObject::connect(&window.view(), &MeshView::frameSwapped, &window, [&] {
    const double value = value_in(session.shown().document, lines);
    if (value == last) return;
    last = value;
    for (std::size_t k = shown; k < moves.size(); ++k)
      if (moves[k].value == value) {
        delays.push_back(milliseconds(Clock::now() - moves[k].at));
        values.push_back(value);
        shown = k + 1;
        break;
      }
  });
  const QPoint start = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, start);
  application.spent = {};
  const auto begin = Clock::now();
  int step = 0;
  QTimer mouse;
  mouse.setTimerType(Qt::PreciseTimer);
  QObject::connect(&mouse, &QTimer::timeout, &window, [&] {
    // To and fro over a fifth of the panel.
    const int width = histogram.width() / 5, round = ++step % (2 * width);
    QTest::mouseMove(&histogram, start + QPoint(round < width ? round : 2 * width - round, 0));
  });
  mouse.start(8);
  QTest::qWait(static_cast<int>(1000.0 * seconds));
  mouse.stop();
  const double whole = milliseconds(Clock::now() - begin) / 1000.0;
  const TimedApplication::Spent spent = application.spent;
  QTest::keyClick(&histogram, Qt::Key_Escape);
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, start);
  (void)QTest::qWaitFor([&] { return !session.is_previewing() && !session.busy(); }, 60000);
  QObject::disconnect(dragged);
  QObject::disconnect(swapped);

  // The operation alone, for some of the values seen.
  std::vector<double> alone;
  const std::string operation = lines ? "find_sharp_lines" : "find_partitions";
  for (std::size_t k = 0; k < values.size(); k += std::max<std::size_t>(1, values.size() / 8)) {
    nlohmann::json parameters = session.current_parameters(operation);
    if (lines)
      parameters["angle"] = values[k];
    else
      parameters["intervals"] = {{0.0, values[k]}, {values[k], nullptr}};
    const auto at = Clock::now();
    (void)apply(session.current().document, {operation, parameters});
    alone.push_back(milliseconds(Clock::now() - at));
  }
  const double pictures = std::max<double>(1.0, static_cast<double>(delays.size()));
  std::printf(
      "%-22s %5.1f pictures a second; move to picture %4.0f ms (median), %4.0f (p95); for each "
      "picture: taken over %.1f ms, drawn %.1f, mouse %.1f, all events %.1f; the operation alone "
      "%.1f ms\n",
      name, static_cast<double>(delays.size()) / whole, quantile(delays, 0.5),
      quantile(delays, 0.95), spent.results / pictures, spent.paint / pictures,
      spent.mouse / pictures, spent.all / pictures, quantile(alone, 0.5));
  std::fflush(stdout);
}

int run(TimedApplication& application, std::string scan, double seconds) {
  const testing::TempFolder folder;
  if (!std::filesystem::exists(scan)) {
    const double faces = std::atof(scan.c_str());
    if (!(faces >= 1000.0)) return 2;
    scan = testing::write_mesh(folder, "mould.ply", testing::mould_of(faces));
  }
  MainWindow window;
  window.resize(1440, 900);
  window.show();
  (void)QTest::qWaitForWindowExposed(&window);
  Session& session = window.session();
  window.open(QString::fromStdString(scan));
  const auto settled = [&](const std::function<bool(const Document&)>& reached) {
    const bool there = QTest::qWaitFor(
        [&] { return reached(session.current().document) && !session.busy(); }, 600000);
    QTest::qWait(500);  // what comes after by itself
    return there;
  };
  if (!settled([](const Document& d) { return !d.empty(); })) return 1;
  std::printf("%zu faces\n", session.current().document.mesh->face_count());
  const auto find = [&](const Operation& lines, const Operation& partitions) {
    session.run({lines, partitions});
    return settled([&](const Document& d) {
      const auto& step = d.step("find_partitions");
      return step && !step->out_of_date &&
             step->parameters["method"] == partitions.parameters["method"];
    });
  };
  if (!find({"find_sharp_lines", {{"method", "normal_jump"}}},
            {"find_partitions", {{"method", "surfaces"}}}))
    return 1;
  window.set_field(Field::normal_jump);
  QTest::qWait(500);
  drag(application, window, "TV_IH, normal jump", true, seconds);
  if (!find({"find_sharp_lines", {{"method", "walk"}}},
            {"find_partitions", {{"method", "fronts"}}}))
    return 1;
  window.set_field(Field::ihe);
  QTest::qWait(500);
  drag(application, window, "TV_IH, IHe (walk)", true, seconds);
  window.set_field(Field::kabs);
  QTest::qWait(500);
  drag(application, window, "Kmax, Kabs (fronts)", false, seconds);
  session.mark_saved();
  window.close();
  return 0;
}

}  // namespace
}  // namespace arris::ui

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  for (const auto& [name, value] :
       {std::pair{"QT_QPA_PLATFORM", "xcb"}, std::pair{"QT_XCB_GL_INTEGRATION", "xcb_glx"}})
    if (!qEnvironmentVariableIsSet(name)) qputenv(name, value);
  QStandardPaths::setTestModeEnabled(true);
  QApplication::setOrganizationName("arris-bench");
  QSettings().clear();
  arris::ui::TimedApplication application(argc, argv);
  return arris::ui::run(application, argv[1], argc > 2 ? std::atof(argv[2]) : 5.0);
}
