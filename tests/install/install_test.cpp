// What `cmake --install` leaves works from where it is put, and desktop, file manager and man(1)
// can read it. Their own checkers judge, where there are any on this machine.

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/document/history.h"
#include "core/document/operation.h"
#include "core/document/session_file.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace testing;
namespace fs = std::filesystem;

struct Ended {
  int code = -1;
  std::string text;  ///< Both outputs.
};

bool is_there(const std::string& tool) {
  return std::system(("command -v " + tool + " >/dev/null 2>&1").c_str()) == 0;
}

/// The first groups of all matches, sorted, each once: "a;b;".
std::string all_matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.insert((*it)[1]);
  std::string list;
  for (const std::string& one : found) list += one + ";";
  return list;
}

/// One prefix for all tests, whose name no build knows.
class Installed : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TempFolder>();
    const Ended done =
        run("env -u DESTDIR " ARRIS_CMAKE " --install '" ARRIS_BUILD_DIR "' --prefix '" + prefix() +
            "'");
    ASSERT_EQ(done.code, 0) << done.text;
  }
  static void TearDownTestSuite() { shared_.reset(); }

  static std::string prefix() { return shared_->file("a prefix"); }
  static std::string content(const std::string& name) { return shared_->read("a prefix/" + name); }
  static std::string data(const std::string& name) { return prefix() + "/share/" + name; }

  static Ended run(const std::string& command) {
    const int status =
        std::system(("cd / && { " + command + "; } > " + shared_->file("text") + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, shared_->read("text")};
  }
  /// An installed program in a bare environment, away from the sources.
  static Ended run_program(const std::string& program, const std::string& arguments) {
    return run("env -i PATH=/usr/bin:/bin HOME='" + shared_->path().string() +
               "' XDG_RUNTIME_DIR='" + shared_->path().string() + "' '" + prefix() + "/bin/" +
               program + "' " + arguments);
  }
  static std::string save(const std::string& name, const std::string& picture) {
    const std::string part = write_mesh(*shared_, "part.ply", stepped_plate(10.0, 20.0, 4.0, 1.0));
    History history;
    if (const auto opened = history.run(open_file(part)); !opened)
      throw std::logic_error(opened.error().message);
    SessionExtras extras;
    extras.picture = picture;
    const std::string file = shared_->file(name);
    if (const auto saved = save_session(file, history, extras); !saved)
      throw std::logic_error(saved.error().message);
    return file;
  }

  static std::unique_ptr<TempFolder> shared_;
};

std::unique_ptr<TempFolder> Installed::shared_;

// ---- programs ----

TEST_F(Installed, CommandLineWorksFromThePrefix) {
  const Ended version = run_program("arris-cli", "--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.text, "arris-cli " ARRIS_VERSION "\n");
  const std::string sample = shared_->file("sample.ply");
  EXPECT_EQ(run_program("arris-cli", "sample -o " + sample).code, 0);
  const Ended segmented =
      run_program("arris-cli", "segment " + sample + " -o " + shared_->file("results"));
  EXPECT_EQ(segmented.code, 0) << segmented.text;
  EXPECT_TRUE(fs::exists(shared_->file("results/lines.obj")));
}

#ifdef ARRIS_INSTALLS_WINDOW
TEST_F(Installed, WindowStartsFromThePrefix) {
  const Ended version = run_program("arris", "--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.text, "arris " ARRIS_VERSION "\n");
}
#endif

TEST_F(Installed, ProgramsDoNotKnowWhereTheyWereBuilt) {
#ifndef NDEBUG
  GTEST_SKIP() << "asserts name their source";
#endif
  for (const auto& program : fs::directory_iterator(prefix() + "/bin")) {
    const std::string bytes = content("bin/" + program.path().filename().string());
    ASSERT_GT(bytes.size(), 100'000u);
    EXPECT_EQ(bytes.find(ARRIS_SOURCE_DIR), std::string::npos) << program.path();
    EXPECT_EQ(bytes.find(ARRIS_BUILD_DIR), std::string::npos) << program.path();
  }
}

// ---- thumbnails ----

TEST_F(Installed, ThumbnailIsThePictureThatTheSessionHolds) {
  const std::string png = content("share/icons/hicolor/256x256/apps/org.arris.Arris.png");
  const std::string session = save("with picture.arris", png), out = shared_->file("thumbnail.png");
  const Ended done = run_program("arris-cli", "thumbnail '" + session + "' -o " + out);
  EXPECT_EQ(done.code, 0) << done.text;
  EXPECT_EQ(done.text, "");
  EXPECT_EQ(shared_->read("thumbnail.png"), png);
}

TEST_F(Installed, NoThumbnailWithoutAPicture) {
  const std::string out = shared_->file("none.png");
  for (const std::string& file : {save("bare.arris", ""), save("odd.arris", "GIF89a"),
                                  shared_->write("no session.arris", "solid part")}) {
    const Ended done = run_program("arris-cli", "thumbnail '" + file + "' -o " + out);
    EXPECT_EQ(done.code, 1);
    EXPECT_NE(done.text.find(file), std::string::npos) << done.text;
    EXPECT_FALSE(fs::exists(out));
  }
}

// ---- desktop ----

#ifdef ARRIS_INSTALLS_WINDOW

constexpr const char* entry = "share/applications/org.arris.Arris.desktop";
constexpr const char* types = "share/mime/packages/org.arris.Arris.xml";

TEST_F(Installed, DesktopEntryIsValid) {
  if (!is_there("desktop-file-validate")) GTEST_SKIP() << "no desktop-file-validate here";
  const Ended judged = run("desktop-file-validate '" + prefix() + "/" + entry + "'");
  EXPECT_EQ(judged.code, 0);
  EXPECT_EQ(judged.text, "");
}

TEST_F(Installed, MetainfoIsValid) {
  if (!is_there("appstreamcli")) GTEST_SKIP() << "no appstreamcli here";
  const Ended judged =
      run("appstreamcli validate --no-net '" + data("metainfo/org.arris.Arris.metainfo.xml") + "'");
  EXPECT_EQ(judged.code, 0) << judged.text;
}

TEST_F(Installed, WhatIsOpenedIsTheSameEverywhere) {
  const std::string known = all_matches(content(types), std::regex("mime-type type=\"([^\"]+)\""));
  EXPECT_EQ(all_matches(content(types), std::regex("glob pattern=\"([^\"]+)\"")),
            "*.3mf;*.arris;*.obj;*.off;*.ply;*.stl;");
  std::smatch line;
  const std::string desktop = content(entry);
  ASSERT_TRUE(std::regex_search(desktop, line, std::regex("MimeType=(.*)\n")));
  EXPECT_EQ(all_matches(line[1], std::regex("([^;]+);")), known);
  EXPECT_EQ(all_matches(content("share/metainfo/org.arris.Arris.metainfo.xml"),
                        std::regex("<mediatype>([^<]+)<")),
            known);
}

TEST_F(Installed, SessionIsKnownByItsContent) {
  if (!is_there("update-mime-database") || !is_there("gio"))
    GTEST_SKIP() << "no update-mime-database or no gio here";
  const Ended made = run("update-mime-database '" + data("mime") + "'");
  ASSERT_EQ(made.code, 0) << made.text;
  const std::string plain = shared_->file("renamed");
  fs::rename(save("to rename.arris", ""), plain);
  for (const std::string& file : {plain, save("named.arris", "")}) {
    const Ended told =
        run("XDG_DATA_DIRS='" + data("") + "' gio info -a standard::content-type '" + file + "'");
    EXPECT_NE(told.text.find("content-type: application/x-arris-session"), std::string::npos)
        << told.text;
  }
}

#endif

// ---- manual ----

TEST_F(Installed, ManualPagesRenderWithoutWarnings) {
  if (!is_there("man")) GTEST_SKIP() << "no man here";
  int pages = 0;
  for (const auto& page : fs::directory_iterator(data("man/man1"))) {
    const std::string file = "'" + page.path().string() + "'";
    const Ended warned =
        run("LC_ALL=C.UTF-8 MANROFFSEQ= man --warnings -l " + file + " >/dev/null");
    EXPECT_EQ(warned.code, 0);
    EXPECT_EQ(warned.text, "") << page.path();
    EXPECT_GT(run("LC_ALL=C.UTF-8 man -l " + file).text.size(), 500u);
    ++pages;
  }
  EXPECT_EQ(pages, std::distance(fs::directory_iterator(prefix() + "/bin"), {}));
}

TEST_F(Installed, ManualTellsEveryCommandAndOption) {
  const std::string page = content("share/man/man1/arris-cli.1");
  const std::string help = run_program("arris-cli", "--help").text;
  const std::size_t list = help.find("Subcommands:\n");
  ASSERT_NE(list, std::string::npos) << help;
  const std::string commands = all_matches(help.substr(list), std::regex("\n  ([a-z-]+) "));
  EXPECT_NE(commands.find("segment;"), std::string::npos) << commands;
  for (std::size_t start = 0; start < commands.size();) {
    const std::size_t end = commands.find(';', start);
    const std::string command = commands.substr(start, end - start);
    const std::string escaped = std::regex_replace(command, std::regex("-"), "\\-");
    const std::size_t place = page.find(".SS \"" + escaped + "\"\n");
    EXPECT_NE(place, std::string::npos) << command;
    start = end + 1;
  }
  for (const char* option : {"\\-\\-sharp\\-angle", "\\-\\-flow", "\\-o,\\-\\-output"})
    EXPECT_NE(page.find(option), std::string::npos) << option;
}

TEST_F(Installed, ManualTellsEveryOperation) {
  const std::string page = content("share/man/man1/arris-cli.1");
  for (const OperationKind& kind : operation_table()) {
    const std::size_t place = page.find(".SS \"" + std::string(kind.name) + "\"\n");
    EXPECT_NE(place, std::string::npos) << kind.name;
  }
}

// The manual is made from the operation table, which says what stands for what is left out.
TEST_F(Installed, TheManualTellsEveryParameterOfEveryOperation) {
  const std::string page = content("share/man/man1/arris-cli.1");
  for (const OperationKind& kind : operation_table()) {
    // The last of that name: a command may have it, too.
    const std::size_t begin = page.rfind(".SS \"" + std::string(kind.name) + "\"\n");
    ASSERT_NE(begin, std::string::npos) << kind.name;
    const std::string section = page.substr(begin, page.find("\n.S", begin + 1) - begin);
    for (const Parameter& parameter : kind.parameters)
      EXPECT_NE(section.find(std::string(parameter.name)), std::string::npos)
          << kind.name << " " << parameter.name;
  }
}

}  // namespace
}  // namespace arris
