// How evenly long work reports, how soon it stops when it is told to, and what memory it takes at
// most. Not a test: figures.
//
//   arris_progress_bench SCAN|FACES [CANCELS]
//
// A number of faces makes the sample mould that fine, and with CANCELS -1 leaves it as mould.ply
// here instead. For each operation: seconds, the longest spell
// without a report and where it lies, the peak memory of the process so far, and the longest time
// that CANCELS (8) requests to stop, spread over the work, took to be heard.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/process.h"
#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

namespace arris {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;

double seconds(Clock::duration spent) { return std::chrono::duration<double>(spent).count(); }

struct Spell {
  double seconds = 0.0, from = 0.0, to = 0.0;
  std::string before, after;
};

/// Notes the spells between reports.
class Listener {
 public:
  Context context(std::stop_token stop = {}) {
    last_ = Clock::now();
    return Context(
        [this](double fraction, std::string_view what) {
          const std::lock_guard lock(mutex_);
          note(fraction, std::string(what));
        },
        stop);
  }
  void end() { note(1.0, "end"); }
  std::vector<Spell> longest(std::size_t count) {
    std::sort(spells_.begin(), spells_.end(),
              [](const Spell& a, const Spell& b) { return a.seconds > b.seconds; });
    spells_.resize(std::min(count, spells_.size()));
    return spells_;
  }

 private:
  void note(double fraction, std::string what) {
    const Clock::time_point now = Clock::now();
    spells_.push_back({seconds(now - last_), fraction_, fraction, what_, what});
    last_ = now;
    fraction_ = fraction;
    what_ = std::move(what);
  }
  std::mutex mutex_;
  Clock::time_point last_;
  double fraction_ = 0.0;
  std::string what_ = "start";
  std::vector<Spell> spells_;
};

Document measured(const Document& document, const Operation& operation, int cancels) {
  Listener listener;
  const auto begin = Clock::now();
  const Context context = listener.context();
  Document result = value_of(apply(document, operation, context));
  listener.end();
  const double whole = seconds(Clock::now() - begin);
  const double peak = 1e-9 * static_cast<double>(peak_memory());
  double slowest = 0.0, slowest_at = 0.0;
  for (int k = 0; k < cancels; ++k) {
    const double at = (k + 0.5) / cancels;
    std::stop_source stop;
    std::atomic<bool> over = false;
    Clock::time_point asked;
    std::thread other([&] {
      const auto until = Clock::now() + std::chrono::duration<double>(whole * at);
      while (Clock::now() < until && !over)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      asked = Clock::now();
      stop.request_stop();
    });
    // Evidence that is shared would be there the second time.
    Document fresh = document;
    if (fresh.mesh) {
      fresh.evidence = std::make_shared<const SharedLineEvidence>(fresh.mesh, fresh.curvatures);
      fresh.opened.evidence = fresh.evidence;
      if (operation.name == "find_partitions") fresh.areas = nullptr;
    }
    const bool cancelled = !apply(fresh, operation, Context(nullptr, stop.get_token()));
    const auto heard = Clock::now();
    over = true;
    other.join();
    if (cancelled && seconds(heard - asked) > slowest) {
      slowest = seconds(heard - asked);
      slowest_at = at;
    }
  }
  std::printf("%-20s %7.2f s  peak %.2f GB  cancel %.3f s (at %2.0f %%)\n", operation.name.c_str(),
              whole, peak, slowest, 100.0 * slowest_at);
  for (const Spell& spell : listener.longest(6))
    if (spell.seconds > 0.02 * whole)
      std::printf("    %.3f s = %4.1f %% from %.3f \"%s\" to %.3f \"%s\"\n", spell.seconds,
                  100.0 * spell.seconds / whole, spell.from, spell.before.c_str(), spell.to,
                  spell.after.c_str());
  std::fflush(stdout);
  return result;
}

int run(std::string scan, int cancels) {
  const TempFolder folder;
  if (!std::filesystem::exists(scan)) {
    const double faces = std::atof(scan.c_str());
    if (!(faces >= 1000.0)) return 2;
    scan = write_mesh(folder, "mould.ply", mould_of(faces));
    if (cancels < 0) {
      std::filesystem::copy_file(scan, "mould.ply");
      return 0;
    }
  }
  Document document = measured(Document{}, {"open", {{"file", scan}}}, cancels);
  std::printf("%zu faces\n", document.mesh->face_count());
  const Document opened = document;
  document = measured(document, {"find_sharp_lines", {}}, cancels);
  document = measured(document, {"find_partitions", {}}, cancels);
  document = measured(opened, {"simplify", {}}, cancels);
  document = measured(document, {"find_sharp_lines", {{"method", "walk"}}}, cancels);
  document = measured(document, {"equilateralize", {}}, cancels);
  document = measured(document, {"find_partitions", {{"method", "fronts"}}}, cancels);
  return 0;
}

}  // namespace
}  // namespace arris

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  return arris::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 8);
}
