#pragma once

#include <mutex>

#include <QString>
#include <QStringList>

namespace arris::ui {

/// A text file of lines, each with its time, that is put aside once it is large: NAME, and before
/// it NAME.1, NAME.2, ... of which the last few are kept. What cannot be written is no fault.
class LogFile {
 public:
  explicit LogFile(QString path, qint64 most_bytes = 1 << 20, int kept = 3);

  void write(const QString& line);
  const QString& path() const { return path_; }
  /// The last lines, oldest first.
  QStringList last(int lines) const;

 private:
  void put_aside();

  QString path_;
  qint64 most_bytes_;
  int kept_;
  mutable std::mutex mutex_;  // Qt warns on any thread
};

/// The log of this program, in the user's state folder; made when it is first asked for.
LogFile& program_log();
/// From here on Qt's warnings go there, too.
void log_warnings();

/// The text without what is private: each of `known` ("bracket.ply") is told as "<name>", and every
/// path that is in it as "<path>", with its ending; rather a word too many than one too few.
QString without_paths(QString text, const QStringList& known = {});

}  // namespace arris::ui
