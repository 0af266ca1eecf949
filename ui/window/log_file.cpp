#include "ui/window/log_file.h"

#include <algorithm>
#include <utility>

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>

namespace arris::ui {

namespace {

constexpr qsizetype most_of_a_line = 4000;

QtMessageHandler shown_before = nullptr;

/// One line in which everything from where a path begins to the last that can belong to one is
/// "<path>": names of folders may hold blanks.
QString without_path(const QString& line) {
  static const QRegularExpression begin(R"((?<![\w.<>])(?:file:/*|~)?/[^\s/])");
  static const QRegularExpression ends(
      R"(/|\.(?:stl|ply|obj|off|3mf|gz|arris|jsonl|png|jpg|part|key|lock|log|so|json)\b)",
      QRegularExpression::CaseInsensitiveOption);
  const qsizetype first = begin.match(line).capturedStart();
  if (first < 0) return line;
  qsizetype last = first;
  QString ending;
  for (auto match = ends.globalMatch(line, first); match.hasNext();) {
    const QRegularExpressionMatch end = match.next();
    last = end.capturedEnd();
    ending = end.captured() == "/" ? QString() : end.captured();
  }
  while (last < line.size() && !line[last].isSpace() &&
         !QStringLiteral("\"'“”<>|;,():").contains(line[last])) {
    const bool full_stop =
        line[last] == '.' && (last + 1 == line.size() || line[last + 1].isSpace());
    if (full_stop) break;
    ++last;
    ending.clear();
  }
  return line.left(first) + "<path>" + ending + line.mid(last);
}

void take_warning(QtMsgType type, const QMessageLogContext& context, const QString& text) {
  if (type != QtDebugMsg && type != QtInfoMsg) program_log().write("Qt: " + text);
  if (shown_before) shown_before(type, context, text);
}

}  // namespace

LogFile::LogFile(QString path, qint64 most_bytes, int kept)
    : path_(std::move(path)), most_bytes_(most_bytes), kept_(kept) {}

void LogFile::write(const QString& line) {
  const std::lock_guard lock(mutex_);
  QDir().mkpath(QFileInfo(path_).absolutePath());
  if (QFileInfo(path_).size() >= most_bytes_) put_aside();
  QFile file(path_);
  if (!file.open(QIODevice::WriteOnly | QIODevice::Append)) return;
  file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
  QString text = line.left(most_of_a_line);
  text.replace('\n', ' ');
  file.write((QDateTime::currentDateTimeUtc().toString(Qt::ISODate) + " " + text + "\n").toUtf8());
}

void LogFile::put_aside() {
  const auto older = [this](int k) { return k == 0 ? path_ : path_ + "." + QString::number(k); };
  QFile::remove(older(kept_));
  for (int k = kept_; k > 0; --k) QFile::rename(older(k - 1), older(k));
}

QStringList LogFile::last(int lines) const {
  const std::lock_guard lock(mutex_);
  QFile file(path_);
  if (!file.open(QIODevice::ReadOnly)) return {};
  constexpr qint64 most_read = 200000;
  if (file.size() > most_read) file.seek(file.size() - most_read);
  QStringList all = QString::fromUtf8(file.readAll()).split('\n', Qt::SkipEmptyParts);
  return all.mid(std::max<qsizetype>(0, all.size() - lines));
}

LogFile& program_log() {
  static LogFile log(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                     "/log/arris.log");
  return log;
}

void log_warnings() {
  if (!shown_before) shown_before = qInstallMessageHandler(take_warning);
}

QString without_paths(QString text, const QStringList& known) {
  QStringList longest_first = known;
  std::ranges::sort(longest_first, [](const QString& a, const QString& b) {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  });
  for (const QString& name : longest_first)
    if (!name.isEmpty())
      text.replace(name, name.contains('/') ? QStringLiteral("<path>") : QStringLiteral("<name>"));
  QStringList lines = text.split('\n');
  for (QString& line : lines) line = without_path(line);
  return lines.join('\n');
}

}  // namespace arris::ui
