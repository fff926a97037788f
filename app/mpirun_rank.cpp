#include "mpirun_rank.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

/// Returns null where a variable is not set.
using environment = std::function<const char*(const char*)>;

environment of_this_process() {
  return [](const char* name) { return std::getenv(name); }; // NOLINT(concurrency-mt-unsafe)
}

environment of_process(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/environ");
  std::map<std::string, std::string> values;
  for (std::string variable; std::getline(file, variable, '\0');) {
    const std::size_t sign = variable.find('=');
    if (sign != std::string::npos)
      values.emplace(variable.substr(0, sign), variable.substr(sign + 1));
  }
  return [values = std::move(values)](const char* name) -> const char* {
    const auto found = values.find(name);
    return found == values.end() ? nullptr : found->second.c_str();
  };
}

struct number_names {
  const char* rank;
  const char* size;
};
constexpr std::array<number_names, 3> names_in_run{{{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                                    {"PMI_RANK", "PMI_SIZE"},
                                                    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}}};
constexpr std::array<number_names, 2> names_on_machine{
    {{"OMPI_COMM_WORLD_LOCAL_RANK", "OMPI_COMM_WORLD_LOCAL_SIZE"}, {"MPI_LOCALRANKID", "MPI_LOCALNRANKS"}}};

/// Rank and size by the first names that are there.
std::optional<std::pair<int, int>> numbers_in(const environment& variables,
                                              std::span<const number_names> names) {
  for (const number_names& starter : names) {
    const char* rank = variables(starter.rank);
    const char* size = variables(starter.size);
    if (rank != nullptr && size != nullptr)
      return std::pair(std::atoi(rank), std::atoi(size));
  }
  return {};
}

/// One starter may have several runs.
std::string run_in(const environment& variables) {
  std::string run;
  for (const char* name : {"PMIX_NAMESPACE", "PMI_JOBID", "SLURM_STEP_ID"})
    if (const char* value = variables(name))
      run += std::string(name) + "=" + value + " ";
  return run;
}

} // namespace

mpirun_rank rank_of_mpirun() {
  const auto [rank, size] = numbers_in(of_this_process(), names_in_run).value_or(std::pair(0, 1));
  return {rank, size};
}

place_on_machine place_of_mpirun() {
  const auto [rank, size] = numbers_in(of_this_process(), names_on_machine).value_or(std::pair(0, 0));
  return {rank, size};
}

std::optional<mpirun_rank> rank_of_mpirun(pid_t process) {
  const environment theirs = of_process(process);
  const auto found = numbers_in(theirs, names_in_run);
  if (!found || run_in(theirs) != run_in(of_this_process()))
    return {};
  return mpirun_rank{found->first, found->second};
}

} // namespace dovetail::app
