#include "entire_scheme.hpp"
#include "experiment_column.hpp"
#include "experiment_results.hpp"
#include "paper_figures.hpp"
#include "run_figures.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/files/write_trace.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

using json = nlohmann::ordered_json;

/// A report as `mesh` writes it, of which no time is zero.
json example_report() {
  run_figures figures;
  figures.workers = 2;
  figures.elements = 280'000;
  figures.boundary_triangles = 3620;
  figures.background_elements = 15'000;
  figures.subdomains = 32;
  figures.merges = 3;
  figures.seconds = {.geometry = 1,
                     .background = 2,
                     .simplification = 3,
                     .partition = 4,
                     .skeleton = 5,
                     .intersection = 6,
                     .bisection = 50,
                     .meshing = 30,
                     .improvement = 10,
                     .redistribution = 0.5,
                     .first_pass = 1.5,
                     .between_passes = 0.25,
                     .second_pass = 2.5,
                     .writing_back = 0.125,
                     .output = 7,
                     .total = 68};
  figures.at_interfaces.touching.add(11.5);
  figures.at_interfaces.rest.add(40);
  figures.interfaces.min_face_angle_deg = figures.interfaces.min_dihedral_deg = 31;
  figures.coarse_interfaces = figures.interfaces;
  figures.quality.min_dihedrals.bins[5] = 1;
  figures.quality.min_dihedrals.bins[11] = 20;
  figures.quality.min_dihedrals.bins[23] = 300;
  const testing::scratch_folder folder("report");
  write_report(figures, folder / "report.json");
  std::ifstream file(folder / "report.json");
  return json::parse(file);
}

/// An experiment of which all runs have given the same.
experiment_result result_of(const experiment& what) {
  const json measured = example_report();
  json simulated = measured;
  simulated["workers"] = 32;
  experiment_result result{&what, {{"command", "dovetail experiment"}, {"scale", 100}}, {}};
  const auto result_of_run = [&](const experiment_run& run) {
    return run_result{&run, measured, simulated, {{"command", "dovetail mesh"}}};
  };
  for (const experiment_run& run : what.runs) {
    result.runs.push_back(result_of_run(run));
    for (const experiment_run& other : run.beside)
      add_beside(result.runs.back(), result_of_run(other));
  }
  return result;
}

const experiment& named(const std::string& name) {
  return *std::find_if(all_experiments().begin(), all_experiments().end(),
                       [&](const experiment& each) { return each.name == name; });
}

double value_in(const experiment_result& result, const std::string& row, std::size_t run,
                std::vector<double> row_values::*source) {
  const auto& rows = result.what->rows;
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.label == row; });
  REQUIRE(found != rows.end());
  return (values_of(*found, result).*source)[run];
}

template <class Items, class Label>
bool all_differ(const Items& items, Label label) {
  std::set<std::string> labels;
  for (const auto& item : items)
    labels.insert(label(item));
  return labels.size() == items.size() && !labels.contains("");
}

void check_run(const experiment_run& run) {
  INFO(run.label);
  CHECK(std::set<std::string>{"aircraft", "combustor", "orbiter"}.contains(run.model));
  CHECK(run.table.empty() == (run.elements > 0));
  if (run.table.empty())
    return;
  REQUIRE(paper_table(run.table).at("columns").contains(run.column));
  CHECK_NOTHROW(run_for(paper_table(run.table).at("columns").at(run.column), 100));
}

TEST_CASE("every experiment names figures that the paper's columns and reports have") {
  CHECK(all_differ(all_experiments(), [](const experiment& each) { return each.name; }));
  for (const experiment& each : all_experiments()) {
    INFO(each.name);
    CHECK_FALSE(each.title.empty());
    CHECK(all_differ(each.runs, [](const experiment_run& run) { return run.label; }));
    CHECK(all_differ(each.rows, [](const experiment_row& row) { return row.label; }));
    for (const experiment_run& run : each.runs) {
      check_run(run);
      std::for_each(run.beside.begin(), run.beside.end(), check_run);
    }
    const experiment_result result = result_of(each);
    for (const experiment_row& row : each.rows) {
      INFO(row.label);
      CHECK_FALSE((row.paper.sum.empty() && row.ours.sum.empty()));
      const row_values values = values_of(row, result);
      const auto is_there = [](double value) { return std::isfinite(value); };
      if (!row.paper.sum.empty())
        for (std::size_t k = 0; k < each.runs.size(); ++k)
          CHECK(std::isfinite(values.paper[k]) == !each.runs[k].table.empty());
      if (!row.ours.sum.empty()) {
        const auto shown =
            static_cast<std::ptrdiff_t>(row.only_of.empty() ? each.runs.size() : row.only_of.size());
        CHECK(std::count_if(values.measured.begin(), values.measured.end(), is_there) ==
              (row.over_first ? 0 : shown)); // all are made by two workers
        CHECK(std::count_if(values.simulated.begin(), values.simulated.end(), is_there) == shown);
      }
    }
    const auto has_row = [&](const std::string& label) {
      return std::any_of(each.rows.begin(), each.rows.end(),
                         [&](const auto& row) { return row.label == label; });
    };
    for (const experiment_plot& plot : each.plots) {
      CHECK(has_row(plot.horizontal));
      CHECK(std::all_of(plot.vertical.begin(), plot.vertical.end(), has_row));
      for (const std::string& label : plot.runs)
        CHECK(std::any_of(each.runs.begin(), each.runs.end(),
                          [&](const auto& run) { return run.label == label; }));
    }
  }
}

double sum_in(const json& column, const std::vector<std::string>& keys) {
  double sum = 0;
  for (const std::string& key : keys)
    sum += column.value(key, 0.0);
  return sum;
}

/// How much longer Algorithm 2 takes, as the paper prints it.
void check_gap(const json& second, const char* scheme, const json& first) {
  const double gap = 100 * (second.at(scheme).get<double>() / first.at("scheme").get<double>() - 1);
  CHECK(std::abs(second.at("gap").get<double>() - gap) < 0.1);
}

TEST_CASE("the paper's figures agree with one another, also from table to table") {
  for (const json& column : paper_table("table4").at("columns"))
    CHECK(sum_in(column, {"background_seconds", "simplification", "intersection", "remeshing"}) ==
          doctest::Approx(column.at("decomposition").get<double>()).epsilon(1e-3));
  for (const json& column : paper_table("table5").at("columns")) {
    CHECK(sum_in(column, {"from_0", "from_6"}) == column.at("bad").get<double>());
    CHECK(sum_in(column, {"from_0", "from_6", "from_12", "from_18"}) == column.at("low").get<double>());
  }
  for (const auto& [second, first] : {std::pair("table7", "table2"), std::pair("table8", "table3")})
    for (const auto& [label, column] : paper_table(second).at("columns").items())
      check_gap(column, "scheme", paper_table(first).at("columns").at(label));
  for (const json& column : paper_table("table9").at("columns")) {
    check_gap(column, "scheme_2", column);
    CHECK(sum_in(column, {"surface_meshing_2", "decomposition_2", "other_2"}) ==
          doctest::Approx(column.at("scheme_2").get<double>()).epsilon(1e-3));
    CHECK(column.at("elements").get<double>() / column.at("scheme_2").get<double>() /
              column.at("cores").get<double>() / column.at("speed_2").get<double>() ==
          doctest::Approx(1).epsilon(0.25));
  }
}

TEST_CASE("the figures of each of the paper's columns agree with one another") {
  CHECK_THROWS_AS(paper_table("table1"), usage_error);
  for (const auto& [name, table] : paper_figures().at("tables").items()) {
    CHECK_FALSE(table.at("place").get<std::string>().empty());
    for (const auto& [label, column] : table.at("columns").items()) {
      const std::string place = name + ", " + label;
      INFO(place);
      if (column.contains("speed"))
        CHECK(column.at("elements").get<double>() / column.at("scheme").get<double>() /
                  column.at("cores").get<double>() / column.at("speed").get<double>() ==
              doctest::Approx(1).epsilon(0.25)); // elements are rounded: "1B"
      const double steps =
          sum_in(column, {"surface_meshing", "decomposition", "generation", "repartitioning", "improvement",
                          "other", "first_pass", "collection", "second_pass"});
      if (column.contains("scheme") && name != "table6") // which prints one of the steps
        CHECK(steps == doctest::Approx(column.at("scheme").get<double>()).epsilon(1e-3));
    }
  }
}

TEST_CASE("rows are sums, over products of sums, of what the paper and reports say") {
  const experiment_result two = result_of(named("table2"));
  CHECK(value_in(two, "Entire scheme", 0, &row_values::paper) == 102.5);
  CHECK(value_in(two, "Entire scheme", 0, &row_values::measured) == 114.875);
  CHECK(value_in(two, "Domain decomposition", 0, &row_values::measured) == 70);
  CHECK(value_in(two, "Relative speed", 0, &row_values::measured) == doctest::Approx(280'000 / 114.875 / 2));
  CHECK(value_in(two, "Relative speed", 0, &row_values::simulated) ==
        doctest::Approx(280'000 / 114.875 / 32));
  const experiment_result four = result_of(named("table4"));
  CHECK(value_in(four, "Subdomains before any is merged", 1, &row_values::paper) == 320);
  CHECK(value_in(four, "Subdomains before any is merged", 1, &row_values::measured) == 35);
  const experiment_result five = result_of(named("table5"));
  CHECK(value_in(five, "Tetrahedra from 6 to 12 degrees", 1, &row_values::measured) == 20);
  CHECK(value_in(five, "Tetrahedra under 24 degrees (low quality)", 1, &row_values::measured) == 321);
  const experiment_result ten = result_of(named("fig10"));
  CHECK(value_in(ten, "Mesh generation", 0, &row_values::paper) == doctest::Approx(28e6 / 6.8 / 32));
  const experiment_result sixteen = result_of(named("fig16"));
  CHECK(value_in(sixteen, "Speedup of mesh improvement", 3, &row_values::paper) ==
        doctest::Approx(1753.1 / 211.1));
  experiment_result seven = result_of(named("table7"));
  CHECK(value_in(seven, "Algorithm 1: entire scheme", 3, &row_values::paper) == 2648.7);
  CHECK(value_in(seven, "Algorithm 2: entire scheme", 3, &row_values::paper) == 3548.1);
  CHECK(value_in(seven, "Algorithm 2: surface meshing", 0, &row_values::measured) == 13);
  CHECK(value_in(seven, "Algorithm 2: entire scheme", 0, &row_values::measured) == 114.875);
  CHECK(value_in(seven, "Algorithm 2: relative speed", 0, &row_values::simulated) ==
        doctest::Approx(280'000 / 114.875 / 32));
  CHECK(value_in(seven, "Performance gap", 0, &row_values::paper) == 27.4);
  seven.runs[0].measured["Algorithm 2"]["seconds"]["bisection"] = 50 + 114.875;
  CHECK(value_in(seven, "Performance gap", 0, &row_values::measured) == doctest::Approx(100));
  const experiment_result nine = result_of(named("table9"));
  CHECK(value_in(nine, "Algorithm 2: domain decomposition", 4, &row_values::paper) == 1604.5);
  const experiment_result table_ten = result_of(named("table10"));
  CHECK(value_in(table_ten, "Entire improvement", 0, &row_values::measured) == doctest::Approx(4.875));
  CHECK(value_in(table_ten, "Improvement of Algorithm 1", 1, &row_values::paper) == 211.1);
  const experiment_result fourteen = result_of(named("fig14"));
  CHECK(value_in(fourteen, "Speedup of Algorithm 1", 3, &row_values::paper) ==
        doctest::Approx(6.56).epsilon(1e-3));
  CHECK(value_in(fourteen, "Speedup of Algorithm 2", 3, &row_values::paper) ==
        doctest::Approx(2.34).epsilon(1e-2));
  CHECK(std::isnan(value_of({{"/nowhere"}}, {{"here", 1}})));
  CHECK(std::isnan(value_of({{"/here"}}, json())));
  CHECK(std::isnan(value_of({{"/here"}}, {{"here", nullptr}})));
}

TEST_CASE("a run has the paper's elements and background over the scale, and its ten subdomains per worker") {
  const auto column = [](const std::string& table, const std::string& label) {
    return paper_table(table).at("columns").at(label);
  };
  const wanted_run full = run_for(column("table4", "16"), 1);
  CHECK(full.elements == 412e6);
  CHECK(full.subdomains == 160);
  CHECK(full.workers == 16);
  CHECK(std::pow(full.coarsening, 3) == doctest::Approx(412. / 1.5));
  const wanted_run small = run_for(column("table4", "128"), 100);
  CHECK(small.elements == 4.12e6);
  CHECK(small.background == 29'000);
  CHECK(small.subdomains == 768); // of 824 with 5000 elements, six for each worker
  CHECK(run_for(column("table2", "F16-I"), 1e6).subdomains == 1);
  const wanted_run whole = run_for(column("table5", "F16-I, 1"), 100);
  CHECK(whole.subdomains == 1);
  CHECK(whole.coarsening == 1);
  CHECK_THROWS_AS(run_for(json{{"elements", 5}}, 100), usage_error);
}

TEST_CASE("a simulation takes the place of a report's times and workers") {
  execution_trace trace{.workers = 2, .elements = 280'000, .seconds = 30, .stages = {}, .batches = {}};
  trace.stages = {{"geometry", 0, 1},  {"planning", 1, 2},   {"background volume", 2, 4},
                  {"partition", 4, 7}, {"matching", 7, 8},   {"skeleton", 8, 10},
                  {"meshing", 10, 26}, {"finishing", 26, 30}};
  batch_span meshing{"meshing", 10, 26};
  for (std::size_t task = 0; task < 4; ++task)
    meshing.tasks.push_back({task, static_cast<int>(task % 2), task < 2 ? 0. : 8., 8, 0});
  trace.batches = {meshing};
  const testing::scratch_folder folder("trace");
  io::write_trace(trace, folder / "trace.json");
  const json report = example_report();
  const json simulated = simulated_report(report, folder / "trace.json", 4);
  CHECK(simulated.at("workers") == 4);
  CHECK(simulated.at("elements") == report.at("elements"));
  const auto seconds = [&](const char* part) { return simulated.at("seconds").at(part).get<double>(); };
  CHECK(seconds("geometry") == doctest::Approx(1));
  CHECK(seconds("background") == doctest::Approx(3));
  CHECK(seconds("partition") == doctest::Approx(3));
  CHECK(seconds("skeleton") == doctest::Approx(3));
  CHECK(seconds("simplification") == 0);
  CHECK(seconds("meshing") ==
        doctest::Approx(6).epsilon(1e-3)); // four tasks by four workers: 8, a quarter improving
  CHECK(seconds("improvement") == doctest::Approx(2).epsilon(1e-3));
  CHECK(seconds("output") == doctest::Approx(4));
  CHECK(seconds("total") == doctest::Approx(22).epsilon(1e-3));
  double scheme = 0;
  for (const std::string& part : scheme_parts())
    scheme += seconds(part.c_str());
  CHECK(scheme == doctest::Approx(22 - 1 - 4).epsilon(1e-3));
}

TEST_CASE("the entire scheme has every part of a run but reading, scaling of sizes and finishing") {
  std::vector<std::string> parts = scheme_parts();
  parts.insert(parts.end(), {"geometry", "scaling", "output", "total"});
  std::vector<std::string> reported;
  const json report = example_report();
  for (const auto& [part, seconds] : report.at("seconds").items())
    reported.push_back(part);
  CHECK(std::set(parts.begin(), parts.end()) == std::set(reported.begin(), reported.end()));
  CHECK(parts.size() == reported.size());
}

TEST_CASE("every stage of a trace belongs to a part of a run") {
  const std::map<std::string, std::vector<std::string>> stages{
      {"geometry", {"geometry", "reading"}},
      {"background", {"planning", "background surface", "coarse surface", "background volume"}},
      {"simplification", {"simplification"}},
      {"partition", {"partition"}},
      {"skeleton", {"lines", "matching", "skeleton"}},
      {"intersection", {"intersection"}},
      {"bisection", {"recursive bisection"}},
      {"fine_partition", {"fine partition"}},
      {"meshing", {"meshing", "meshing again"}},
      {"redistribution",
       {"redistributing elements", "simplifying pieces", "cutting pieces", "moving elements"}},
      {"first_pass", {"improving pieces", "first pass"}},
      {"between_passes", {"collection", "redistribution"}},
      {"second_pass", {"second pass"}},
      {"writing_back", {"writing back"}},
      {"output", {"second order", "finishing", "reading back", "what nobody knows"}}};
  for (const auto& [part, names] : stages)
    for (const std::string& name : names) {
      INFO(name);
      CHECK(part_of_stage(name) == part);
    }
}

TEST_CASE("runs by the same workers are no speedup, those by others are") {
  experiment_result sixteen = result_of(named("fig16"));
  const std::string row = "Speedup of mesh improvement";
  CHECK(std::isnan(value_in(sixteen, row, 0, &row_values::measured)));
  CHECK(value_in(sixteen, row, 3, &row_values::simulated) == 1);
  sixteen.runs[3].measured["workers"] = 4;
  sixteen.runs[3].measured["seconds"]["improvement"] = 5;
  CHECK(value_in(sixteen, row, 3, &row_values::measured) == 2);
}

TEST_CASE("a table of a model of one's own says so") {
  experiment_result six = result_of(named("table6"));
  CHECK(markdown_text(six).find("Every run is of") == std::string::npos);
  six.origin["input"] = "wing.step";
  CHECK(markdown_text(six).find("Every run is of `wing.step`") != std::string::npos);
}

TEST_CASE("a step that a method has not is blank, and one that took no time is zero") {
  experiment_result ten = result_of(named("table10"));
  ten.runs[0].measured["seconds"]["writing_back"] = 0.0;
  CHECK(markdown_text(ten).find("| Writing back (s) | - | 0.00 | 0.12 | - | - | - |") != std::string::npos);
  CHECK(markdown_text(ten).find("| Largest piece over the mean | - | - | - | - | 0.00 | 0.00 |") !=
        std::string::npos);
  for (const char* line : {"Writing back,s,Ito,measured,0", "Writing back,s,Loehner,measured,",
                           "Writing back,s,Loehner,simulated,"})
    CHECK(csv_text(ten).find(std::string("\ntable10,") + line + '\n') != std::string::npos);
  CHECK(csv_text(ten).find("Writing back,s,Loehner,paper") == std::string::npos);
  ten.seconds = 12.5;
  CHECK(json::parse(json_text(ten)).at("seconds") == 12.5);
  const json rows = json::parse(json_text(ten)).at("rows");
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [](const json& each) { return each.at("label") == "Writing back"; });
  CHECK(row->at("measured") == json{0.0, nullptr});
}

TEST_CASE("failures are counted and named, and one of our own method is an error") {
  experiment_result seven = result_of(named("table7"));
  const auto fail = [](run_result& run, const std::string& message) {
    run.measured = run.simulated = json();
    run.record["failure"] = message;
  };
  int number = 0;
  for (run_result& run : seven.runs) {
    run.name = "ours " + std::to_string(++number);
    run.beside.front().name = "bisection " + std::to_string(number);
  }
  CHECK(failures_of({seven}).text.empty());
  CHECK_FALSE(failures_of({seven}).is_error);
  fail(seven.runs[1].beside.front(), "no plane, none");
  fail(seven.runs[3].beside.front(), "too small");
  const failure_summary of_others = failures_of({seven, seven}); // the same runs, shown twice
  CHECK(of_others.text == "2 of 8 runs failed: bisection 2: no plane, none; bisection 4: too small");
  CHECK_FALSE(of_others.is_error);
  CHECK(csv_text(seven).find("\ntable7,failure,,\"F16-II, Algorithm 2\",measured,\"no plane, none\"\n") !=
        std::string::npos);
  CHECK(json::parse(json_text(seven)).at("runs").at(1).at("beside").at(0).at("failure") == "no plane, none");
  fail(seven.runs[0], "out of memory");
  CHECK(failures_of({seven}).is_error);
  CHECK(failures_of({seven}).text.ends_with("; ours 1: out of memory"));

  experiment_result variants = result_of(named("rules"));
  for (run_result& run : variants.runs) {
    run.name = run.run->label;
    fail(run, "no such file");
  }
  CHECK(failures_of({variants}).is_error); // nothing is left to show
  variants.runs[0].record.erase("failure");
  CHECK_FALSE(failures_of({variants}).is_error);
}

TEST_CASE("a row of means is over the seeds that a run was made with, and those that failed are none") {
  experiment_result result = result_of(named("interfaces"));
  constexpr std::size_t in_pieces = 1; // before it, the model in one piece
  const auto set = [&](run_result& run, double degrees) {
    run.measured["at_interfaces"]["touching"]["min_dihedral_deg"] = degrees;
  };
  run_result& run = result.runs[in_pieces];
  REQUIRE(run.beside.size() == 4);
  set(run, 1);
  for (const auto& [seed, degrees] : {std::pair(0, 2.0), {1, 6.0}, {2, 3.0}, {3, 8.0}})
    set(run.beside[static_cast<std::size_t>(seed)], degrees);
  const std::string row = "Smallest angle there";
  CHECK(value_in(result, row, in_pieces, &row_values::measured) == doctest::Approx(4));
  CHECK(value_in(result, row, in_pieces, &row_values::margin) == doctest::Approx(3.620).epsilon(1e-3));
  CHECK(std::isnan(value_in(result, row, 0, &row_values::margin))); // of one run
  CHECK(markdown_text(result).find("| 4.0 ± 3.6 |") != std::string::npos);
  CHECK(csv_text(result).find(",\"aircraft, raw, no repair, no rule\",margin,3.61") != std::string::npos);
  CHECK(json::parse(json_text(result)).at("rows").at(3).at("margin").at(in_pieces).is_number());
  run.beside.back().measured = json();
  CHECK(value_in(result, row, in_pieces, &row_values::measured) == doctest::Approx(3));
  CHECK(value_in(result, row, in_pieces, &row_values::margin) == doctest::Approx(3.437).epsilon(1e-3));
}

std::vector<std::string> lines_of_table(const std::string& markdown) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < markdown.size();) {
    const std::size_t end = markdown.find('\n', at);
    if (markdown[at] == '|')
      lines.push_back(markdown.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

TEST_CASE("tables have the paper's columns, ours beside them, and say what failed") {
  for (const experiment& each : all_experiments()) {
    const experiment_result result = result_of(each);
    const auto lines = lines_of_table(markdown_text(result));
    std::size_t columns = 0;
    for (const experiment_run& run : each.runs)
      columns += run.table.empty() ? 1 : 3; // one of ours has neither the paper's nor a simulation
    const std::size_t rows = each.rows.size();
    CHECK(lines.size() == 2 + (each.run_per_line ? columns : rows));
    for (const std::string& line : lines)
      CHECK(static_cast<std::size_t>(std::count(line.begin(), line.end(), '|')) ==
            2 + (each.run_per_line ? rows : columns));
    CHECK(json::parse(json_text(result)).at("rows").size() == rows);
  }
  experiment_result result = result_of(named("table2"));
  CHECK(markdown_text(result).find("| Entire scheme (s) | 102.50 | 114.88 | 114.88 |") != std::string::npos);
  CHECK(markdown_text(result).find("| Mesh repartitioning (s) | 2.40 | - | - |") != std::string::npos);
  CHECK(csv_text(result).find("\ntable2,Entire scheme,s,F16-II,paper,341\n") != std::string::npos);
  CHECK(csv_text(result).find("repartitioning,s,F16-II,measured") == std::string::npos);
  result.runs[1].measured = result.runs[1].simulated = json();
  result.runs[1].record["failure"] = "exit code 1";
  const std::string text = markdown_text(result);
  CHECK(text.find("| F16-II: paper | failed | F16-III: paper |") != std::string::npos);
  CHECK(text.find("`dovetail mesh`, failed: exit code 1") != std::string::npos);
  CHECK(json::parse(json_text(result)).at("rows").at(0).at("measured").at(1).is_null());
}

} // namespace
} // namespace dovetail::app
