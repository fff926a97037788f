#include "command_line.hpp"

#include "command_files.hpp"
#include "command_text.hpp"
#include "commands.hpp"
#include "decomposition_options.hpp"
#include "failure.hpp"
#include "help_format.hpp"
#include "mpirun_rank.hpp"
#include "named_policies.hpp"
#include "output.hpp"
#include "output_claim.hpp"
#include "output_formats.hpp"
#include "policies.hpp"
#include "rank_partitioner.hpp"
#include "rank_supervision.hpp"
#include "run_setup.hpp"
#include "said_version.hpp"
#include "supervision.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::app {
namespace {

/// A variable of a script that is not set would otherwise mean the default.
void refuse_empty_values(CLI::App& command) {
  const CLI::Validator not_empty(
      [](std::string& value) {
        return value.empty() ? std::string("the value is empty text") : std::string();
      },
      "");
  const CLI::Validator a_number(
      [](std::string& value) {
        const bool is_other = std::isnan(std::strtod(value.c_str(), nullptr)) ||
                              value.find_first_of("xX") != value.npos; // NaN, or hexadecimal
        return is_other ? value + " is no decimal number" : std::string();
      },
      "");
  for (CLI::Option* option : command.get_options())
    if (option->get_items_expected_max() > 0) {
      option->check(not_empty);
      if (option->get_type_name().find("FLOAT") != std::string::npos) // NaN is in every range
        option->check(a_number);
    }
}

/// Command lines at the end of a command's help.
void add_examples(CLI::App& command, const std::vector<std::string>& lines) {
  std::string footer = "Examples:";
  for (const auto& line : lines)
    footer += "\n  " + line;
  command.footer(footer);
}

void add_model_options(CLI::App& command, model_options& options) {
  command.add_option(
      "INPUT", options.input,
      "CAD file (STEP, IGES, BREP), triangles (STL, OBJ, OFF, PLY) or, for --dimension 2, a plane domain "
      "(SVG, or TXT with polygons); none: the built-in aircraft");
  command.add_option("--model", options.model,
                     "Built-in model instead of a file: " + joined(builtin_model_names()));
  command
      .add_option("--unit", options.unit, "Unit of lengths from STEP and IGES files: as in the file, or mm")
      ->check(CLI::IsMember({"file", "mm"}))
      ->capture_default_str();
  auto* size =
      command.add_option("-s,--size", options.size,
                         "Target edge length, in the model's unit; with --curvature and --proximity the "
                         "largest one (default: by these two, for at most 2 million elements)");
  auto* sizing =
      command.add_option("--sizing", options.sizing, "JSON file with a sizing field (docs/sizing.md)")
          ->excludes(size);
  command
      .add_option("--elements", options.elements,
                  "About how many elements: the sizes are scaled until so many are predicted")
      ->excludes(size);
  command
      .add_option("--curvature", options.curvature,
                  "Elements per turn of a curved face; 0: any (default: 24)")
      ->excludes(sizing);
  command.add_option("--proximity", options.proximity, "Elements across a wall; 0: any (default: 2)")
      ->excludes(sizing);
  command
      .add_option("--growth", options.growth,
                  "Most that sizes by curvature and walls grow per length (default: 0.25)")
      ->excludes(sizing);
  auto* suppress = command.add_option("--suppress", options.suppress,
                                      "Length of edges that become vertices, and width of faces that become "
                                      "edges (default: a quarter of the size)");
  command.add_flag("--keep-all", options.keep_all, "Mesh all edges and faces, however short and narrow")
      ->excludes(suppress);
}

void add_join_option(CLI::App& command, model_options& options) {
  command.add_option("--join", options.join,
                     "Faces nearer than this length to each other are made one there (default: where the "
                     "surfaces of a CAD model cross, up to a ten-thousandth of its diagonal)");
}

void add_policy_options(CLI::App& command, mesh_options& options) {
  command.add_option("--mesher", options.mesher,
                     "Volume mesher: " + joined(mesher_names<3>()) +
                         "; of triangles: " + joined(mesher_names<2>()));
  command.add_option("--surface-mesher", options.surface_mesher,
                     "Mesher of the surface of --dimension 3: " + joined(surface_mesher_names()));
  command.add_option("--partitioner", options.partitioner,
                     "Graph partitioner: " + joined(partitioner_names()));
  command.add_option("--simplifier", options.simplifier,
                     "Rule for sides that may not become interfaces: " + joined(simplifier_names()));
  command.add_option(
      "--dihedral-angle", options.dihedral_angle,
      "Least angle that the simplifier lets interfaces include, where it has one, in degrees (default: 30; "
      "with --dimension 2 between lines, 50)");
  command.add_option("--improver", options.improver, "Mesh improver: " + joined(improver_names()));
  command.add_option("--executor", options.executor, "Where pieces are meshed: " + joined(executor_names()));
}

void add_run_options(CLI::App& command, mesh_options& options) {
  add_decomposition_options(command, options);
  add_policy_options(command, options);
  command.add_option("--background-mesher", options.background_mesher,
                     "Mesher of the coarse mesh that is decomposed: " + joined(background_mesher_names()));
  command.add_option("--background-improver", options.background_improver,
                     "Improver of the coarse mesh: " + joined(improver_names()) +
                         " (default: a sweep of native towards 28 degrees)");
}

/// What the paper does otherwise, one by one and at once.
void add_paper_options(CLI::App& command, mesh_options& options) {
  command
      .add_option("--weights", options.weights,
                  "What elements of the coarse mesh weigh: predicted elements (default), or 1 (equal)")
      ->check(CLI::IsMember({"predicted", "equal"}));
  const auto add_switch = [&](const char* name, std::string& choice, const char* what) {
    command.add_option(name, choice, std::string(what) + ": on (default), off")
        ->check(CLI::IsMember({"on", "off"}));
  };
  add_switch("--super-element-bound", options.super_element_bound,
             "Whether the simplification may contract only so many elements of the coarse mesh to one");
  add_switch("--segment-matching", options.segment_matching,
             "Whether lines are divided otherwise where an interface face has a small angle");
  add_switch("--local-repartition", options.local_repartition,
             "Whether interfaces are moved where remeshing makes an angle of theirs small");
  command.add_flag(
      "--paper", options.paper,
      "The method as printed: --partitioner metis --simplifier paper --background-improver none "
      "--weights equal, the three above off, and graphs of any size partitioned at once; what is "
      "given stays");
}

void add_order_option(CLI::App& command, mesh_options& options) {
  command
      .add_option("--order", options.order,
                  "Order of the elements: 1, or 2 with nodes in the middle of edges, on the CAD model")
      ->check(CLI::IsMember({1, 2}));
}

void add_output_options(CLI::App& command, mesh_options& options) {
  command.add_option("-o,--out", options.out, "Folder for the mesh")->capture_default_str();
  command
      .add_option("--format", options.formats,
                  "File formats, several allowed: " + joined(format_names(3, false)) +
                      "; for triangles: " + joined(format_names(2, false)) +
                      " (default: the first); with --ranks also: " + joined(format_names(3, true)) +
                      "; for triangles: " + joined(format_names(2, true)) + " (default: the first)")
      ->delimiter(',');
  command.add_option("--ranks", options.ranks, "Files for a parallel solver: number of its processes");
  command.add_option("--redistribute", options.redistribute,
                     "How the pieces come to ranks: " + joined(redistributor_names()));
  command.add_option(
      "--rank-partitioner", options.rank_partitioner,
      "Who partitions for --redistribute by-elements: --partitioner on rank 0 (gathered), or a "
      "library on all ranks of mpirun: " +
          joined(rank_partitioner_names()));
  command.add_flag(
      "--improve-again{pieces}", options.improve_again,
      "After --redistribute by-elements, how tetrahedra are improved once more: what each rank has "
      "(pieces), that and then its interfaces, or none: " +
          joined(improving_strategy_names()));
  command.add_flag("--ghosts", options.ghosts,
                   "Each rank also has the elements of others that touch its own (pvtu, vtkhdf, msh-ranks)");
  command.add_option("--files", options.files,
                     "Number of VTU or HDF5 files (0, the default: one per subdomain)");
  add_order_option(command, options);
  command.add_option("--report", options.report, "JSON file for figures about the run");
  command.add_option("--trace", options.trace,
                     "JSON file for what ran when and where: for ui.perfetto.dev and dovetail simulate");
  command.add_option("--rank-group", options.rank_group,
                     "Under mpirun: how many ranks of a machine compute in one process at most, with the "
                     "workers of all; 1: each by itself, 0, the default: all of them");
  command.add_option(
      "--spool", options.spool,
      "Folder for what a run keeps to go on from, on a disk of each leader of ranks (default: in --out)");
  command.add_flag("--resume", options.resume, "Go on with a run that was stopped or killed");
  command.add_flag("--force", options.force, "Mesh even if the prediction exceeds the disk");
  command.add_flag("--quiet", options.quiet, "No progress and no summary");
}

/// Which mean nothing without --png.
void add_picture_options(CLI::App& command, view_options& options, CLI::Option* png) {
  command
      .add_option("--view", options.view,
                  "From where the picture is taken: default, front, back, left, right, top, bottom, or "
                  "azimuth,elevation in degrees")
      ->needs(png)
      ->capture_default_str();
  command.add_option("--size", options.size, "Pixels of the picture, WxH")->needs(png)->capture_default_str();
  command
      .add_option("--colour", options.colour,
                  "What the picture's colours tell apart: group, piece, material, angle")
      ->check(CLI::IsMember({"group", "piece", "material", "angle"}))
      ->needs(png)
      ->capture_default_str();
  command
      .add_option("--cut", options.cut,
                  "Section: x, y, z or view, through the middle; or x=1.5 for its place. What is nearer to "
                  "the viewer is taken away")
      ->needs(png);
  command
      .add_option("--under", options.under,
                  "Only elements whose least angle is under so many degrees, in the model's outline")
      ->check(CLI::Range(0.0, 180.0))
      ->needs(png);
  command
      .add_option("--explode", options.explode,
                  "Pull pieces apart, by this fraction of their distance from the middle")
      ->check(CLI::Range(0.0, 10.0))
      ->needs(png)
      ->capture_default_str();
  command.add_flag("--no-edges", options.no_edges, "Elements without their edges")->needs(png);
}

/// The commands and what the command line said for each.
struct parser {
  CLI::App app{
      "Meshes CAD models in parallel with tetrahedra: decompose along clean interfaces, mesh the pieces."};
  mesh_options mesh;
  plan_options plan;
  check_options check;
  stats_options stats;
  view_options view;
  improve_options improve;
  filling_options fill;
  adapt_options adapt;
  compare_options compare;
  simulate_options simulate;
  experiment_options experiment;
  std::function<int()> chosen;
  std::function<std::string(bool)> stopped = stopped_line; ///< what it says then
  command_inputs inputs;
  command_outputs outputs;

  parser() {
    app.name("dovetail");
    app.formatter(std::make_shared<help_format>());
    app.set_version_flag("--version", said_version());
    app.require_subcommand(1);
    app.footer("Exit codes:\n"
               "  0                           Done\n"
               "  1                           An error, or check found faults; a line on the error stream "
               "says what\n"
               "  2                           A wrong command line\n"
               "  130                         Stopped by a signal");
    app.option_defaults()->always_capture_default(false);
    add_mesh();
    add_plan();
    add_models();
    add_check();
    add_stats();
    add_view();
    add_improve();
    add_fill();
    add_adapt();
    add_compare();
    add_simulate();
    add_experiment();
    for (CLI::App* command : app.get_subcommands({}))
      refuse_empty_values(*command);
  }

  void add_mesh() {
    auto& command = *app.add_subcommand("mesh", "Mesh a CAD file or a built-in model");
    add_examples(command, {"dovetail mesh wing.step -s 5 -o wing",
                           "dovetail mesh wing.step --sizing sizes.json --mesher hxt -j 2 --report wing.json",
                           "dovetail mesh plate.svg --dimension 2 -s 0.1 --format vtu,msh"});
    add_model_options(command, mesh.model);
    add_join_option(command, mesh.model);
    add_run_options(command, mesh);
    command.add_option("--decomposition", mesh.decomposition,
                       "How subdomains come about, of a coarse mesh, by planes through the fine surface, or "
                       "of a fine mesh: " +
                           joined(decomposition_names()));
    command
        .add_option("--only", mesh.only,
                    "Subdomains of which alone the pieces are made, as in the whole mesh; from 0: 7,12-15")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_flag("--alone", mesh.alone,
                     "With --only: boundaries too are made around these alone, however large the mesh is; "
                     "--local-repartition is off then");
    add_paper_options(command, mesh);
    add_output_options(command, mesh);
    command.callback([this] {
      choose_as_paper(mesh);
      choose_for_alone(mesh);
      chosen = [this] { return run_mesh(mesh); };
      inputs = inputs_of_model(mesh.model);
      outputs = {.files = {{"--report", mesh.report}, {"--trace", mesh.trace}},
                 .folder = mesh.out,
                 .names_in_folder = names_in_folder(mesh),
                 .spool = spool_folder(mesh),
                 .has_own_spool = !mesh.spool.empty()};
    });
  }
  void add_plan() {
    auto& command = *app.add_subcommand("plan", "Predict elements, memory and time before any meshing");
    add_examples(command, {"dovetail plan wing.step -s 5"});
    add_model_options(command, plan.mesh.model);
    add_join_option(command, plan.mesh.model);
    add_run_options(command, plan.mesh);
    add_order_option(command, plan.mesh);
    command.add_option("--report", plan.report, "JSON file for the figures");
    command.callback([this] {
      chosen = [this] { return run_plan(plan); };
      inputs = inputs_of_model(plan.mesh.model);
      outputs.files = {{"--report", plan.report}};
    });
  }
  void add_simulate() {
    auto& command = *app.add_subcommand(
        "simulate", "Predict the time of a run on machines with more workers, from traces");
    add_examples(command, {"dovetail simulate wing.trace.json --workers 2,64,512",
                           "dovetail simulate small.json large.json --elements 1e9 --workers 32,512"});
    command
        .add_option("trace", simulate.traces,
                    "A trace that mesh --trace wrote; or two, of a smaller and a larger mesh of a model")
        ->required()
        ->expected(1, 2);
    command
        .add_option("--elements", simulate.elements,
                    "Elements of the mesh, by power laws through two traces (default: those of the trace)")
        ->check(CLI::Range(1.0, 1e13));
    command.add_option("--workers", simulate.workers, "Numbers of workers")
        ->delimiter(',')
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{10000000}))
        ->default_str("1,2,4, ..., 512");
    command
        .add_option("--workers-per-rank", simulate.machine.workers_per_rank,
                    "Workers of a process that computes, as of a machine's ranks together")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--cores", simulate.machine.cores, "Cores that they share (default: one each)")
        ->check(CLI::NonNegativeNumber);
    command
        .add_option("--turns-cost", simulate.machine.turns_cost,
                    "By what fraction each further rank on a core makes what all do longer")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    auto* nodes = command
                      .add_option("--cores-per-node", simulate.cores_per_node,
                                  "Workers on a node, to print the memory that it needs")
                      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000}));
    command
        .add_option("--memory-per-node", simulate.memory_per_node,
                    "GB of a node, to be told which numbers of workers need more")
        ->check(CLI::PositiveNumber)
        ->needs(nodes);
    command.add_option("--latency", simulate.machine.latency, "Seconds that a message takes")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("--bandwidth", simulate.machine.bandwidth, "Bytes per second of a link")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--request", simulate.machine.request_seconds, "Seconds of the manager per task")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.callback([this] { chosen = [this] { return run_simulate(simulate); }; });
  }
  void add_experiment() {
    auto& command = *app.add_subcommand(
        "experiment", "Run the experiments of the method's paper, and show its figures beside ours");
    add_examples(command,
                 {"dovetail experiment table2", "dovetail experiment table3 fig16 --scale 1000 -o small",
                  "dovetail experiment table4 --input wing.step"});
    command.add_option("NAME", experiment.names, "Experiments: " + joined(experiment_names()))->required();
    command.add_option("--input", experiment.input,
                       "CAD file or triangles to mesh in place of the built-in models, by sizes of its own");
    command.add_option("--scale", experiment.scale, "The paper's numbers of elements over those wanted")
        ->capture_default_str();
    command.add_option("-j,--workers", experiment.workers,
                       "Worker processes (default: the number of processors)");
    command.add_option("-o,--out", experiment.out, "Folder for tables, plots and what is kept of the runs")
        ->capture_default_str();
    command.add_flag("--quiet", experiment.quiet, "Nothing of the runs under way");
    command.callback([this] {
      chosen = [this] { return run_experiment(experiment); };
      stopped = stopped_experiment_line;
      inputs = {{"--input", experiment.input}};
      outputs.folder = experiment.out;
      outputs.names_in_folder = names_of_experiment_files();
    });
  }
  void add_models() {
    auto& command = *app.add_subcommand("models", "List the built-in models");
    command.callback([this] { chosen = run_models; });
  }
  void add_check() {
    auto& command = *app.add_subcommand(
        "check", "Check that a mesh is valid: files of any format that is written, or a folder");
    add_examples(command, {"dovetail check wing/mesh.pvtu", "dovetail check --report wing.json"});
    command.add_option("MESH", check.mesh, "Mesh file, or a folder with one or several");
    command.add_option("--report", check.report,
                       "Report of a run: check that its files are as it wrote them");
    command.callback([this] { chosen = [this] { return run_check(check); }; });
  }
  void add_stats() {
    auto& command = *app.add_subcommand("stats", "Print the quality of a mesh file");
    add_examples(command, {"dovetail stats wing/mesh.pvtu"});
    command.add_option("MESH", stats.mesh, "Mesh file")->required();
    command.add_option("--report", stats.report, "JSON file for the figures");
    command.callback([this] {
      chosen = [this] { return run_stats(stats); };
      inputs = inputs_of_mesh("MESH", stats.mesh);
      outputs.files = {{"--report", stats.report}};
    });
  }
  void add_view() {
    auto& command = *app.add_subcommand("view", "Show a mesh file: a page to turn and cut it, or a picture");
    add_examples(command, {"dovetail view wing/mesh.pvtu -o wing.html",
                           "dovetail view wing.msh --png wing.png --cut y --colour piece",
                           "dovetail view wing.msh --png worst.png --under 20 --view 30,20",
                           "dovetail view wing -o wing.html --report wing.json"});
    command
        .add_option("MESH", view.mesh,
                    "Mesh file (VTU, PVTU, VTP, MSH, HDF5, MFEM, OpenFOAM), or a folder with one")
        ->required();
    auto* out =
        command.add_option("-o,--out", view.out, "HTML file to write; a browser shows it without a network");
    command
        .add_option("--most", view.most,
                    "Most triangles in the HTML file; four for an element inside, and the worst come first")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{100'000'000}))
        ->needs(out)
        ->capture_default_str();
    auto* png = command.add_option("--png", view.png, "Picture to write (PNG); needs no display");
    command.add_option(
        "--report", view.report,
        "Report of the run that made the mesh: marks small interface angles and the thinnest wall");
    add_picture_options(command, view, png);
    command.callback([this] {
      chosen = [this] { return run_view(view); };
      inputs = inputs_of_view("MESH", view.mesh);
      inputs.push_back({"--report", view.report});
      outputs.files = {{"--out", view.out}, {"--png", view.png}};
    });
  }
  void add_improve() {
    auto& command = *app.add_subcommand("improve", "Improve the elements of a mesh file, boundary kept");
    add_examples(command, {"dovetail improve mesh.vtu -o better.vtu --preset finest"});
    command.add_option("IN", improve.input, "Mesh file")->required();
    command.add_option("-o,--out", improve.out, "Mesh file to write (VTU or MSH)")->required();
    command.add_option("--preset", improve.preset, "Improver: " + joined(improver_names()));
    command.add_option("--report", improve.report, "JSON file for the figures");
    command.add_flag("--quiet", improve.quiet, "No progress and no summary");
    command.callback([this] {
      chosen = [this] { return run_improve(improve); };
      inputs = inputs_of_mesh("IN", improve.input);
      outputs.files = {{"--out", improve.out}, {"--report", improve.report}};
    });
  }
  void add_fill() {
    auto& command =
        *app.add_subcommand("fill", "Mesh the inside of a closed surface of triangles, all of them kept");
    add_examples(command, {"dovetail fill wing.stl -o wing.vtu", "dovetail fill mesh.vtu -o wing.msh -s 0.5",
                           "dovetail fill wing.stl -o wing.vtu --growth 0.4 --void=0.5,0,1"});
    command
        .add_option("IN", fill.input,
                    "Triangles: STL, OBJ, OFF, PLY, or a mesh file with triangles (VTU, PVTU, VTP, MSH)")
        ->required();
    command.add_option("-o,--out", fill.out, "Mesh file to write (VTU or MSH)")->required();
    auto* size = command.add_option("-s,--size", fill.size,
                                    "Edge length inside (default: that of the triangles, growing inwards)");
    command.add_option("--sizing", fill.sizing, "JSON file with a sizing field (docs/sizing.md)")
        ->excludes(size);
    command.add_option("--growth", fill.growth,
                       "Most that edge lengths grow per length away from the triangles (default: 0.25)");
    command
        .add_option("--void", fill.voids,
                    "A point x,y,z of a region to leave empty; may be given several times")
        ->allow_extra_args(false);
    command.add_option("--mesher", fill.mesher, "Volume mesher: " + joined(mesher_names<3>()));
    command.add_option("--improver", fill.improver, "Mesh improver: " + joined(improver_names()));
    command.add_option("-j,--workers", fill.workers,
                       "Worker processes, for several regions (default: the number of processors)");
    command.add_option("--report", fill.report, "JSON file for the figures");
    command.add_flag("--quiet", fill.quiet, "No progress and no summary");
    command.callback([this] {
      chosen = [this] { return run_fill(fill); };
      inputs = inputs_of_mesh("IN", fill.input);
      const auto of_sizing = inputs_of_sizing(fill.sizing);
      inputs.insert(inputs.end(), of_sizing.begin(), of_sizing.end());
      outputs.files = {{"--out", fill.out}, {"--report", fill.report}};
    });
  }
  void add_adapt() {
    auto& command =
        *app.add_subcommand("adapt", "Mesh what a mesh file is a mesh of in other sizes, boundary kept");
    add_examples(command, {"dovetail adapt mesh.vtu --sizes h -o next.vtu",
                           "dovetail adapt mesh.vtu --sizes h --model part.step -o next.vtu",
                           "dovetail adapt mesh.msh -s 2 --feature-angle 30 -o next.msh -j 2"});
    command.add_option("MESH", adapt.input, "Mesh file of any format that is written, or a folder with one")
        ->required();
    command.add_option("-o,--out", adapt.out, "Mesh file to write (VTU or MSH)")->required();
    auto* sizes =
        command.add_option("--sizes", adapt.sizes,
                           "Values at the points of the mesh that are the new edge lengths: the name "
                           "of point data (VTU) or node data (MSH)");
    auto* size = command.add_option("-s,--size", adapt.size, "Edge length everywhere")->excludes(sizes);
    command.add_option("--sizing", adapt.sizing, "JSON file with a sizing field (docs/sizing.md)")
        ->excludes(sizes)
        ->excludes(size);
    command.add_option(
        "--model", adapt.model,
        "The model that the mesh is a mesh of: a CAD or triangle file, or the name of a built-in "
        "model. Without it the one that finished_run.txt beside the mesh names; none: the "
        "boundary of the mesh alone");
    command
        .add_option("--unit", adapt.unit,
                    "Unit of a STEP or IGES file of --model: mm, or file for the file's own")
        ->check(CLI::IsMember({"mm", "file"}))
        ->capture_default_str();
    command.add_option("--growth", adapt.how.growth, "Most that --sizes may grow per length")
        ->capture_default_str();
    command
        .add_option("--feature-angle", adapt.how.feature_angle_deg,
                    "Edges at which the boundary turns by more degrees stay where they are")
        ->check(CLI::Range(0.0, 180.0))
        ->capture_default_str();
    command.add_flag(
        "--fields", adapt.fields,
        "Carry the values at points and in elements over to the new mesh, a VTU file; in elements "
        "the integral is kept");
    add_part_options(command, adapt.run);
    add_policy_options(command, adapt.run);
    command.add_option("--report", adapt.report, "JSON file for the figures");
    command.add_flag("--quiet", adapt.quiet, "No progress and no summary");
    command.callback([this] {
      chosen = [this] { return run_adapt(adapt); };
      inputs = inputs_of_mesh("MESH", adapt.input);
      const auto of_sizing = inputs_of_sizing(adapt.sizing);
      inputs.insert(inputs.end(), of_sizing.begin(), of_sizing.end());
      outputs.files = {{"--out", adapt.out}, {"--report", adapt.report}};
    });
  }
  void add_compare() {
    auto& command =
        *app.add_subcommand("compare", "Run combinations of policies on one model: table and page");
    add_examples(command,
                 {"dovetail compare wing.step -s 5 --partitioners metis,scotch --simplifiers paper,none"});
    add_model_options(command, compare.model);
    add_compare_options(command, compare);
    command.callback([this] {
      chosen = [this] { return run_compare(compare); };
      inputs = inputs_of_model(compare.model);
      outputs.folder = compare.out;
      outputs.names_in_folder = {"compare.csv", "compare.html", "written_by_dovetail"};
    });
  }
};

/// Where the options of the command that was given are told.
std::string help_for(const CLI::App& app, int argc, char** argv) {
  std::string command;
  for (const auto* known : app.get_subcommands({}))
    if (argc > 1 && known->get_name() == argv[1])
      command = known->get_name() + " ";
  return "see dovetail " + command + "--help";
}

/// CLI11 only says that a command is required when the one given is none.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-' || !app.get_subcommands().empty())
    return {};
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({}))
    known.push_back(command->get_name());
  return "there is no command '" + std::string(argv[1]) + "'; there are: " + joined(known);
}

} // namespace

int run_command_line(int argc, char** argv) {
  prepare_formats();
  const mpirun_rank process = rank_of_mpirun();
  const bool shared = process.size > 1 && argc > 1 && std::string_view(argv[1]) == "mesh";
  const bool speaks = !shared || process.rank == 0; // or all would say the same
  parser line;
  const std::string help = help_for(line.app, argc, argv);
  const auto refuse = [&](const std::string& text) {
    if (!speaks)
      return exit_ok; // or mpirun would end the one that speaks
    complain(text + " (" + help + ")");
    return exit_usage;
  };
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::Success& request) { // --help, --version
    return speaks ? run_guarded([&] { return line.app.exit(request); }, help) : exit_ok;
  } catch (const CLI::RequiredError& problem) {
    return refuse(unknown_command(line.app, argc, argv).value_or(problem.what()));
  } catch (const CLI::ParseError& problem) {
    return refuse(problem.what());
  }
  std::vector<std::string> words(argv, argv + argc);
  words.front() = "dovetail";
  line.compare.command_line = line.experiment.command_line = line.mesh.command_line = command_text(words);
  try {
    require_distinct(line.inputs, line.outputs);
  } catch (const command_line_error& problem) {
    return refuse(problem.what());
  }
  const unfinished_output unfinished(line.outputs);
  std::optional<output_claim> claim;
  std::exception_ptr refused; // another run may be writing what would be cleaned up
  try {
    claim.emplace(line.outputs, !shared || process.rank == 0);
  } catch (...) {
    refused = std::current_exception();
  }
  const auto clean_up = [&] { return refused == nullptr && unfinished.remove(); };
  const auto chosen = [&] {
    return run_guarded(
        [&] {
          if (refused != nullptr)
            std::rethrow_exception(refused);
          return line.chosen();
        },
        help);
  };
  if (!shared)
    return refused != nullptr ? chosen() : run_supervised(chosen, clean_up, line.stopped);
  const auto on_ranks = [&] {
    return run_on_ranks(
        {line.mesh.command_line, largest_rank_group(line.mesh), [&] { return say_stopped(line.mesh); }},
        [&](const relayed_rank& rank) {
          line.mesh.network = rank.network;
          line.mesh.group = rank.group;
          line.mesh.partition_desk = rank.partition_desk;
          return chosen();
        },
        {.of_rank =
             [&] {
               if (refused == nullptr)
                 unfinished.remove_of_rank();
             },
         .of_all = clean_up});
  };
  return run_guarded(on_ranks, help);
}

} // namespace dovetail::app
