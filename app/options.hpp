/// @file
/// What the command line asks for, as plain data.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/solver/adaptation_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

/// The model and its sizes: shared by `mesh` and `plan`.
struct model_options {
  std::string input;              ///< a CAD or triangle file; empty: a built-in model
  std::string model;              ///< name of a built-in model; empty: the default one, or the input
  std::string unit = "mm";        ///< unit that a STEP or IGES file is converted to
  std::optional<double> size;     ///< uniform, or the scale of the built-in model's sizes, or the largest
  std::string sizing;             ///< JSON file with a sizing field
  std::optional<double> elements; ///< the sizes are scaled until the prediction is this number
  /// Of automatic sizes: elements per turn, elements across walls, growth per length.
  std::optional<double> curvature, proximity, growth;
  std::optional<double> suppress;   ///< length up to which details of the model are; none: by the sizes
  bool keep_all = false;            ///< nothing is a detail
  std::optional<double> join;       ///< faces as near as that to each other are joined
  bool joined_for_crossing = false; ///< because surfaces crossed, and not because it was asked for
  bool crossing_is_told = false;    ///< surfaces that cross end the attempt: no detail is to blame yet

  /// Sizes are found by the model: nothing is said of them, or only how.
  bool has_automatic_sizes() const {
    return sizing.empty() && (curvature || proximity || growth || (!size && !input.empty()));
  }
};

struct mesh_options {
  model_options model;
  int dimension = 3; ///< of the elements: 3, or 2 for triangles on the surface
  std::optional<int> subdomains;
  std::optional<double> coarsening; ///< background size over size
  std::vector<std::string> only;    ///< subdomains that are meshed, as numbers or ranges; empty: all
  bool alone = false;               ///< boundaries are made around these alone: `choose_for_alone`
  std::string decomposition;        ///< how the domain becomes subdomains; empty: the default
  int workers = 0;                  ///< 0: as many as the machine has; on several ranks one each, of a group
                                    ///< no more than it has processors
  std::string mesher;
  std::string partitioner;
  std::string simplifier;
  std::optional<double> dihedral_angle; ///< of the simplifier, degrees; none: its own
  std::string improver;
  std::string executor;
  std::string background_mesher;
  std::string background_improver; ///< empty: the library's own
  std::string weights;             ///< of background elements: "predicted" (or empty), "equal"
  // "on" (or empty), "off".
  std::string super_element_bound, segment_matching, local_repartition;
  bool paper = false; ///< what is not chosen otherwise is as in the paper: `choose_as_paper`
  std::string surface_mesher;
  std::string out = "out";
  std::vector<std::string> formats;
  std::string report;
  std::string trace;        ///< file for what ran when and where; empty: none
  int files = 0;            ///< number of VTU or HDF5 files; 0: one per subdomain
  std::optional<int> ranks; ///< of the solver that the mesh is for
  std::string redistribute;
  std::string rank_partitioner; ///< of redistribution by elements; empty: the default
  std::string
      improve_again; ///< after redistribution by elements, what ranks have: the strategy; empty: the default
  bool ghosts = false; ///< of each rank, in formats that have them
  int order = 1;       ///< of the elements in the files: 1 or 2
  std::optional<int>
      rank_group;    ///< ranks of a machine that compute as one: at most; 0: all; none: the default
  std::string spool; ///< folder on a disk of each rank's own; empty: in `out`
  bool resume = false;
  bool force = false;
  bool quiet = false;
  std::optional<any_communicator> network = {}; ///< of the ranks, where there are several
  std::vector<int> group = {};   ///< the ranks that this one computes for, itself too; empty: no ranks
  int partition_desk = -1;       ///< the socket to that of this rank's relay; -1: no relay
  std::string command_line = {}; ///< which is the same for all of them
};

struct plan_options {
  mesh_options mesh;
  std::string report;
};

struct check_options {
  std::string mesh;   ///< empty: none
  std::string report; ///< of a run, whose files are to be checked; empty: none
};

struct stats_options {
  std::string mesh;
  std::string report;
};

struct improve_options {
  std::string input;
  std::string out;
  std::string preset;
  std::string report;
  bool quiet = false;
};

struct adapt_options {
  std::string input;
  std::string out;
  std::string sizes; ///< name of values at points in the input; empty: none
  std::optional<double> size;
  std::string sizing; ///< JSON file with a sizing field
  adaptation_options how;
  std::string model; ///< a file or the name of a built-in model; "none"; empty: that of the run, if known
  std::string unit = "mm"; ///< that a STEP or IGES file of the model is converted to
  mesh_options run;        ///< its policies and parts alone
  bool fields = false;     ///< whether values at points and in elements are carried over
  std::string report;
  bool quiet = false;
};

} // namespace dovetail::app
