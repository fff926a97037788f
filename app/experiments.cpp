#include "experiment.hpp"
#include "experiments/fig10.hpp"
#include "experiments/fig13.hpp"
#include "experiments/fig14.hpp"
#include "experiments/fig15.hpp"
#include "experiments/fig16.hpp"
#include "experiments/interfaces.hpp"
#include "experiments/rules.hpp"
#include "experiments/table10.hpp"
#include "experiments/table2.hpp"
#include "experiments/table3.hpp"
#include "experiments/table4.hpp"
#include "experiments/table5.hpp"
#include "experiments/table6.hpp"
#include "experiments/table7.hpp"
#include "experiments/table8.hpp"
#include "experiments/table9.hpp"
#include "experiments/thresholds.hpp"

namespace dovetail::app {

const std::vector<experiment>& all_experiments() {
  using namespace experiments;
  static const std::vector<experiment> all = {
      table2(), table3(), table4(), table5(), table6(), table7(),     table8(), table9(),    table10(),
      fig10(),  fig13(),  fig14(),  fig15(),  fig16(),  thresholds(), rules(),  interfaces()};
  return all;
}

} // namespace dovetail::app
