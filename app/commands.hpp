/// @file
/// The driver's commands. Each returns the exit code, prints to the standard output, and throws on failure.
#pragma once

#include "compare_options.hpp"
#include "experiment_options.hpp"
#include "filling_options.hpp"
#include "options.hpp"
#include "simulate_options.hpp"
#include "view_options.hpp"

#include <string>
#include <vector>

namespace dovetail::app {

int run_mesh(const mesh_options& options);
/// On the error stream, and whether another run can go on; returns the exit code.
int say_stopped(const mesh_options& options);
int run_compare(const compare_options& options);
int run_plan(const plan_options& options);
int run_models();
int run_check(const check_options& options);
int run_stats(const stats_options& options);
int run_improve(const improve_options& options);
int run_fill(const filling_options& options);
int run_adapt(const adapt_options& options);
int run_simulate(const simulate_options& options);
int run_view(const view_options& options);
int run_experiment(const experiment_options& options);
/// What that may be asked for.
std::vector<std::string> experiment_names();
/// What they may write in their folder, as `matches` has names.
std::vector<std::string> names_of_experiment_files();

} // namespace dovetail::app
