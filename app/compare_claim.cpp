#include "compare_claim.hpp"

#include "markup.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace dovetail::app {
namespace {

using row_figure = std::function<double(const comparison_row&)>;

/// From the smallest to the largest that is known; empty: none is.
std::string range_of(const std::vector<double>& values, int decimals) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double value : values)
    if (!std::isnan(value)) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  if (least > most)
    return {};
  const std::string from = fixed(least, decimals), to = fixed(most, decimals);
  return from == to ? from : from + " to " + to;
}

using side_of_pair = const comparison_row* simplified_pair::*;

std::string range_of(const std::vector<simplified_pair>& pairs, side_of_pair side, const row_figure& of,
                     int decimals) {
  std::vector<double> values;
  for (const simplified_pair& pair : pairs)
    values.push_back(of(*(pair.*side)));
  return range_of(values, decimals);
}

std::string sentence_on_angles(const std::vector<simplified_pair>& pairs, const std::string& mesh,
                               interface_row comparison_row::*of_mesh) {
  const row_figure smallest = [&](const comparison_row& row) { // that there is, or NaN
    return std::fmin((row.*of_mesh).min_face_angle, (row.*of_mesh).min_dihedral);
  };
  const row_figure under = [&](const comparison_row& row) {
    return static_cast<double>((row.*of_mesh).under_threshold);
  };
  const std::string with = range_of(pairs, &simplified_pair::with, smallest, 1);
  const std::string without = range_of(pairs, &simplified_pair::without, smallest, 1);
  if (with.empty() || without.empty())
    return "There are no interfaces in the " + mesh + ".";
  const auto better = std::count_if(pairs.begin(), pairs.end(), [&](const simplified_pair& pair) {
    return smallest(*pair.with) > smallest(*pair.without);
  });
  return "In the " + mesh + ", the smallest interface angle is " + with +
         " degrees with simplification and " + without + " without; it is larger with it in " +
         std::to_string(better) + " of " + std::to_string(pairs.size()) +
         " decompositions. Angles under the threshold: " + range_of(pairs, &simplified_pair::with, under, 0) +
         " with, " + range_of(pairs, &simplified_pair::without, under, 0) + " without.";
}

} // namespace

std::vector<simplified_pair> pairs_of(const comparison& compared) {
  std::vector<simplified_pair> pairs;
  for (const comparison_row& row : compared.rows) {
    const combination& by = row.policies;
    if (row.failed() || !by.is_simplified())
      continue;
    const auto other = std::find_if(compared.rows.begin(), compared.rows.end(), [&](const comparison_row& r) {
      return !r.failed() && !r.policies.is_simplified() && name_of(r.policies) == name_of(by);
    });
    const std::string name =
        by.partitioner + " + " + by.mesher + (by.simplifier == "paper" ? "" : ", " + by.simplifier);
    const bool is_new =
        std::none_of(pairs.begin(), pairs.end(), [&](const simplified_pair& p) { return p.name == name; });
    if (other != compared.rows.end() && is_new)
      pairs.push_back({name, &row, &*other});
  }
  return pairs;
}

std::vector<std::string> answers_of(const comparison& compared, const std::vector<simplified_pair>& pairs) {
  std::vector<std::string> answers{sentence_on_angles(pairs, "background mesh", &comparison_row::coarse),
                                   sentence_on_angles(pairs, "finished mesh", &comparison_row::fine)};
  std::vector<double> changes;
  for (const simplified_pair& pair : pairs)
    changes.push_back(pair.without->coarse.faces > 0
                          ? 100 * static_cast<double>(pair.with->coarse.faces) /
                                    static_cast<double>(pair.without->coarse.faces) -
                                100
                          : std::nan(""));
  if (const std::string cut = range_of(changes, 1); !cut.empty())
    answers.push_back("The cut, in " + std::string(compared.dimension == 3 ? "faces" : "edges") +
                      " of the background mesh, changes by " + cut + " percent.");
  const row_figure imbalance = [](const comparison_row& row) { return row.imbalance; };
  answers.push_back("The imbalance, largest subdomain over the average in elements, is " +
                    range_of(pairs, &simplified_pair::with, imbalance, 3) + " with and " +
                    range_of(pairs, &simplified_pair::without, imbalance, 3) + " without.");
  return answers;
}

} // namespace dovetail::app
