#include "commands.hpp"
#include "failure.hpp"

#include "dovetail/experiments/builtin_models.hpp"

#include <cstdio>

namespace dovetail::app {

int run_models() {
  for (const auto& info : builtin_models())
    std::printf("%-12s %s\n", std::string(info.name).c_str(), std::string(info.description).c_str());
  return exit_ok;
}

} // namespace dovetail::app
