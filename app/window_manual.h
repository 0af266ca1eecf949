#pragma once

#include <string>

#include <QCommandLineParser>

namespace arris {

/// arris(1), from what the command line knows of itself. `options` are those that the parser was
/// given: it does not tell them.
std::string window_manual(const QCommandLineParser& parser,
                          const QList<QCommandLineOption>& options);

}  // namespace arris
