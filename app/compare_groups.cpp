#include "compare_groups.hpp"

#include <algorithm>

namespace dovetail::app {

meshing_policies meshing_of(const comparison_row& row) {
  return {row.policies.mesher, row.policies.improver};
}

std::vector<meshing_policies> distinct_meshings(const std::vector<comparison_row>& rows) {
  std::vector<meshing_policies> distinct;
  for (const auto& row : rows)
    if (std::find(distinct.begin(), distinct.end(), meshing_of(row)) == distinct.end())
      distinct.push_back(meshing_of(row));
  return distinct;
}

std::vector<comparison_row> first_of_each_meshing(const comparison& compared) {
  std::vector<comparison_row> firsts;
  for (const bool simplified : {true, false})
    for (const auto& row : compared.rows) {
      const bool known = std::any_of(firsts.begin(), firsts.end(), [&](const comparison_row& first) {
        return meshing_of(first) == meshing_of(row);
      });
      if (!row.failed() && row.policies.simplified == simplified && !known)
        firsts.push_back(row);
    }
  return firsts;
}

std::vector<simplification_pair> simplification_pairs(const comparison& compared) {
  std::vector<simplification_pair> pairs;
  for (const auto& with : compared.rows) {
    if (with.failed() || !with.policies.simplified)
      continue;
    combination plain = with.policies;
    plain.simplified = false;
    const auto without =
        std::find_if(compared.rows.begin(), compared.rows.end(),
                     [&](const comparison_row& row) { return !row.failed() && row.policies == plain; });
    const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const simplification_pair& pair) {
      return pair.with.policies.partitioner == with.policies.partitioner &&
             pair.with.policies.mesher == with.policies.mesher;
    });
    if (without != compared.rows.end() && !known)
      pairs.push_back({with, *without});
  }
  return pairs;
}

} // namespace dovetail::app
