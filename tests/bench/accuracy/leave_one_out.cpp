#include "tests/bench/accuracy/leave_one_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "tests/bench/accuracy/changed.h"
#include "tests/bench/accuracy/score.h"

namespace arris::accuracy {

namespace {

constexpr std::array<double, 5> shares{0.8, 0.9, 1.0, 1.1, 1.25};
constexpr std::size_t as_it_is = 2;  // in shares

using FindWith = std::function<Result<Found>(const ScanPtr&, double share)>;

struct Constant {
  std::string name;
  bool of_lines;
  FindWith find;
};

template <class Number>
void scale(Number& value, double share) {
  if constexpr (std::is_integral_v<Number>)
    value = static_cast<Number>(std::llround(static_cast<double>(value) * share));
  else
    value = static_cast<Number>(static_cast<double>(value) * share);
}

Constant line_constant(std::string name,
                       void (*change)(LineEvidenceOptions&, LineChoiceOptions&, double)) {
  return {std::move(name), true, [change](const ScanPtr& scan, double share) {
            return changed_lines(
                scan, [&](LineEvidenceOptions& o, LineChoiceOptions& c) { change(o, c, share); });
          }};
}

Constant area_constant(std::string name, void (*change)(AreaTreeOptions&, double)) {
  return {std::move(name), false, [change](const ScanPtr& scan, double share) {
            return changed_areas(scan, [&](AreaTreeOptions& o) { change(o, share); });
          }};
}

/// What was tuned on parts with known truth; the rest follows from reasons or is no constant.
std::vector<Constant> tuned_constants() {
  using Evidence = LineEvidenceOptions;
  using Choice = LineChoiceOptions;
  using Areas = AreaTreeOptions;
  return {
      line_constant("threshold", [](Evidence& o, Choice&, double s) { scale(o.threshold, s); }),
      line_constant("clear", [](Evidence& o, Choice&, double s) { scale(o.clear, s); }),
      line_constant("first cut",
                    [](Evidence& o, Choice&, double s) { scale(o.regions.first_cut, s); }),
      line_constant("quantile",
                    [](Evidence& o, Choice&, double s) { scale(o.regions.quantile, s); }),
      line_constant("area", [](Evidence& o, Choice&, double s) { scale(o.regions.area, s); }),
      line_constant("thin", [](Evidence& o, Choice&, double s) { scale(o.regions.thin, s); }),
      line_constant("near", [](Evidence& o, Choice&, double s) { scale(o.regions.test.near, s); }),
      line_constant("far", [](Evidence& o, Choice&, double s) { scale(o.regions.test.far, s); }),
      line_constant("least ratio",
                    [](Evidence& o, Choice&, double s) { scale(o.regions.test.least_ratio, s); }),
      line_constant("least slit", [](Evidence&, Choice& c, double s) { scale(c.least_slit, s); }),
      line_constant("beside", [](Evidence&, Choice& c, double s) { scale(c.beside, s); }),
      line_constant("gap", [](Evidence&, Choice& c, double s) { scale(c.gap, s); }),
      line_constant("spur", [](Evidence&, Choice& c, double s) { scale(c.spur, s); }),
      area_constant("kink", [](Areas& o, double s) { scale(o.joining.kink, s); }),
      area_constant("rise", [](Areas& o, double s) { scale(o.joining.rise, s); }),
      area_constant("rise of border", [](Areas& o, double s) { scale(o.joining.rise_border, s); }),
      area_constant("free", [](Areas& o, double s) { scale(o.joining.free, s); }),
      area_constant("free rise", [](Areas& o, double s) { scale(o.joining.free_rise, s); }),
      area_constant("good", [](Areas& o, double s) { scale(o.growing.good, s); }),
      area_constant("admits", [](Areas& o, double s) { scale(o.growing.admits, s); }),
      area_constant("grain", [](Areas& o, double s) { scale(o.grain, s); }),
      area_constant("first cut of areas",
                    [](Areas& o, double s) { scale(o.smallest.first_cut, s); }),
      area_constant("band", [](Areas& o, double s) { scale(o.smallest.band, s); }),
      area_constant("length of border", [](Areas& o, double s) { scale(o.borders.length, s); }),
  };
}

std::size_t corrections_of(const Score& score, bool of_lines) {
  return of_lines ? score.lines.adds + score.lines.deletes + score.lines.merges
                  : score.partitions.connects + score.partitions.splits + score.partitions.restarts;
}

using Counts = std::array<std::size_t, shares.size()>;  // of one part, at each share

std::size_t sum_at(const std::vector<Counts>& counts, std::size_t share) {
  std::size_t sum = 0;
  for (const Counts& part : counts) sum += part[share];
  return sum;
}

/// The share with the fewest corrections over all parts but one, the nearest to 1 of these.
std::size_t chosen_without(const std::vector<Counts>& counts, std::size_t left_out) {
  std::size_t best = as_it_is;
  const auto others = [&](std::size_t k) { return sum_at(counts, k) - counts[left_out][k]; };
  const auto off = [](std::size_t k) { return std::abs(std::log(shares[k])); };
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (others(k) < others(best) || (others(k) == others(best) && off(k) < off(best))) best = k;
  return best;
}

}  // namespace

Result<Table> leave_one_out(const std::vector<Case>& cases, bool quiet) {
  const std::vector<Constant> constants = tuned_constants();
  std::vector<std::vector<Counts>> counts(constants.size());  // of each constant, by part
  for (const Case& item : cases) {
    const Result<Part> part = item.make();
    if (!part) return tl::unexpected<Error>(part.error());
    const Scorer scorer(*part);
    std::array<std::size_t, 2> default_counts{};
    bool tells = true;
    for (std::size_t k = 0; k < constants.size() && tells; ++k) {
      const Constant& constant = constants[k];
      if (!quiet) std::cerr << item.name << ", " << constant.name << "\n";
      Counts part_counts{};
      for (std::size_t s = 0; s < shares.size(); ++s) {
        std::size_t& known = default_counts[constant.of_lines ? 0 : 1];
        const bool is_known = k > 0 && constants[k - 1].of_lines == constant.of_lines;
        if (s == as_it_is && is_known) {
          part_counts[s] = known;
          continue;
        }
        const Result<Found> found = constant.find(part->scan, shares[s]);
        if (!found) return tl::unexpected<Error>(found.error());
        const Result<Score> score = scorer.score(*found);
        if (!score) return tl::unexpected<Error>(score.error());
        tells =
            constant.of_lines ? score->lines.has_corrections : score->partitions.has_corrections;
        if (!tells) break;
        part_counts[s] = corrections_of(*score, constant.of_lines);
        if (s == as_it_is) known = part_counts[s];
      }
      if (tells) counts[k].push_back(part_counts);
    }
  }
  std::vector<std::string> header{"constant", "of"};
  for (const double share : shares) {
    std::string text = std::to_string(share);
    header.push_back("x " + text.substr(0, 4));
  }
  header.push_back("left out");
  Table table(header);
  for (std::size_t k = 0; k < constants.size(); ++k) {
    std::vector<std::string> row{constants[k].name, constants[k].of_lines ? "lines" : "partitions"};
    for (std::size_t s = 0; s < shares.size(); ++s)
      row.push_back(std::to_string(sum_at(counts[k], s)));
    std::size_t left_out = 0;
    for (std::size_t p = 0; p < counts[k].size(); ++p)
      left_out += counts[k][p][chosen_without(counts[k], p)];
    row.push_back(std::to_string(left_out));
    table.add(std::move(row));
  }
  return table;
}

}  // namespace arris::accuracy
