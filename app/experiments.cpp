#include "experiment.hpp"
#include "experiments/fig10.hpp"
#include "experiments/fig16.hpp"
#include "experiments/rules.hpp"
#include "experiments/table2.hpp"
#include "experiments/table3.hpp"
#include "experiments/table4.hpp"
#include "experiments/table5.hpp"
#include "experiments/table6.hpp"
#include "experiments/table9.hpp"
#include "experiments/thresholds.hpp"

namespace dovetail::app {

const std::vector<experiment>& all_experiments() {
  using namespace experiments;
  static const std::vector<experiment> all = {table2(), table3(), table4(), table5(),     table6(),
                                              table9(), fig10(),  fig16(),  thresholds(), rules()};
  return all;
}

} // namespace dovetail::app
