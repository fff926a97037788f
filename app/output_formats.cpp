#include "output_formats.hpp"

#include "failure.hpp"
#include "named_policies.hpp"
#include "policies.hpp"
#include "rank_partitioner.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/solver/mfem_format.hpp"
#include "dovetail/solver/openfoam_format.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/rank_msh_format.hpp"

#ifdef DOVETAIL_DRIVER_WITH_HDF5
#include "dovetail/files/hdf5_pieces.hpp"
#include "dovetail/solver/hdf5_format.hpp"
#endif

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

namespace dovetail::app {
namespace {

/// Of the spool: four 4-byte corners, and a 24-byte point for every fifth to sixth element.
constexpr double spool_bytes_per_element = 22;

/// By elements is done before any file is begun (`redistribute_by_elements`).
template <int D>
std::vector<any_redistributor<D>> redistributors() {
  const auto done_before = [](const distributed_simplicial_mesh<D>&, int) -> redistribution<D> {
    throw usage_error("the elements have not been redistributed yet");
  };
  return {{redistribution_by::pieces{.partitioner = partition::metis{}}, "by-pieces"},
          {done_before, by_elements},
          {redistribution_by::blocks{}, "none"}};
}

/// All of them: a new format is one more line.
template <int D>
std::vector<output_format<D>> known_formats(const mesh_options& options,
                                            const any_redistributor<D>& redistribute) {
  const double msh_bytes = options.order == 2 ? (D == 3 ? 140 : 130) : D == 3 ? 48 : 45;
  const double vtu_bytes = options.order == 2 ? 110 : D == 3 ? 50 : 45;
  [[maybe_unused]] const double hdf5_bytes = options.order == 2 ? 80 : D == 3 ? 24 : 25;
  std::vector<output_format<D>> known;
  known.push_back({"vtu", vtu_bytes, io::vtu_writer{.files = options.files}});
  known.push_back({"msh", msh_bytes, io::msh_writer{}});
  if constexpr (D == 3)
    known.push_back({"msh-partitioned", msh_bytes, io::partitioned_msh_writer{}});
#ifdef DOVETAIL_DRIVER_WITH_HDF5
  known.push_back({"hdf5", hdf5_bytes, io::hdf5_writer{.files = options.files}});
#endif
  const bool improves = improvement_of_ranks(options, D) != "none";
  const int meshes_in_spool = options.redistribute != by_elements ? 1 : improves ? 3 : 2;
  const auto add_by_ranks = [&](double bytes_per_element, auto format, bool has_ghosts = false) {
    const io::rank_writer<decltype(format), any_redistributor<D>> writer{
        options.ranks.value_or(1), format, redistribute, options.ghosts && has_ghosts};
    known.push_back({format.name(), bytes_per_element, writer, true, has_second_order<decltype(format)>,
                     has_ghosts, meshes_in_spool});
  };
  const double pvtu_bytes = options.order == 2 ? 150 : D == 3 ? 65 : 60;
  add_by_ranks(pvtu_bytes, io::pvtu_format{}, true);
  if constexpr (D == 3) {
    add_by_ranks(options.order == 2 ? 150 : 50, io::rank_msh_format{}, true);
    add_by_ranks(85.0, io::openfoam_format{});
    add_by_ranks(options.order == 2 ? 135.0 : 55.0, io::mfem_format{});
  }
#ifdef DOVETAIL_DRIVER_WITH_HDF5
  add_by_ranks(options.order == 2 ? (D == 3 ? 150.0 : 130.0) : D == 3 ? 65.0 : 55.0, io::xdmf_format{});
  add_by_ranks(options.order == 2 ? 170.0 : D == 3 ? 90.0 : 80.0, io::vtkhdf_format{}, true);
#endif
  return known;
}

template <int D>
std::vector<std::string> names_of_formats(bool by_ranks) {
  std::vector<std::string> names;
  for (const auto& format : known_formats<D>({}, redistribution_by::blocks{}))
    if (format.by_ranks == by_ranks)
      names.push_back(format.name);
  if (!by_ranks)
    names.push_back("none");
  return names;
}

/// The names of the formats by ranks that have something.
template <int D, class Has>
std::string formats_by_ranks(const Has& has) {
  std::vector<std::string> names;
  for (const auto& format : known_formats<D>({}, redistribution_by::blocks{}))
    if (format.by_ranks && has(format))
      names.push_back(format.name);
  return joined(names);
}

/// Files that say nothing of ranks have elements of either order.
template <int D>
void check_order(const mesh_options& options, const std::vector<output_format<D>>& formats) {
  if (options.order == 1)
    return;
  for (const auto& format : formats)
    if (!format.second_order)
      throw command_line_error("--order 2: the files of " + format.name +
                               " are of first order; with --ranks there are " +
                               formats_by_ranks<D>([](const auto& other) { return other.second_order; }));
}

template <int D>
void check_ranks(const mesh_options& options, const std::vector<output_format<D>>& formats) {
  const bool by_ranks =
      std::any_of(formats.begin(), formats.end(), [](const auto& format) { return format.by_ranks; });
  if (!options.improve_again.empty() && (D == 2 || options.redistribute != by_elements))
    throw command_line_error("--improve-again goes with tetrahedra and --redistribute by-elements");
  make_improving_strategy(options.improve_again);
  if (!options.rank_partitioner.empty() && options.redistribute != by_elements)
    throw command_line_error("--rank-partitioner goes with --redistribute by-elements");
  make_rank_partitioner(options.rank_partitioner, make_partitioner(options.partitioner),
                        options.partition_desk);
  if (!options.ranks) {
    if (by_ranks || options.ghosts || !options.redistribute.empty())
      throw command_line_error("--ranks is missing: for how many ranks the mesh is");
    return;
  }
  const std::string given = "--ranks: " + std::to_string(*options.ranks);
  if (*options.ranks < 1)
    throw command_line_error(given + " is less than 1");
  if (options.subdomains && *options.subdomains < *options.ranks && options.redistribute != by_elements)
    throw command_line_error(given + " are more than the " + std::to_string(*options.subdomains) +
                             " subdomains; a rank has one at least");
  const bool only_figures = formats.empty() && options.redistribute == by_elements;
  if (!by_ranks && !only_figures)
    throw command_line_error("--ranks goes with one of the formats " + joined(names_of_formats<D>(true)) +
                             ", or with none and --redistribute " + by_elements);
  if (options.ghosts && std::none_of(formats.begin(), formats.end(), [](const auto& f) { return f.ghosts; }))
    throw command_line_error("--ghosts: none of the formats has elements of other ranks; these have: " +
                             formats_by_ranks<D>([](const auto& other) { return other.ghosts; }));
}

/// Per element, of all formats together.
struct disk_use {
  double bytes_of_files = 0;
  int meshes_in_spool = 0; ///< beside files that are complete

  template <int D>
  explicit disk_use(const std::vector<output_format<D>>& formats) {
    for (const auto& format : formats) {
      bytes_of_files += format.bytes_per_element;
      meshes_in_spool = std::max(meshes_in_spool, format.meshes_in_spool);
    }
  }
};

} // namespace

std::string improvement_of_ranks(const mesh_options& options, int dimension) {
  if (!options.improve_again.empty())
    return options.improve_again;
  const bool has_improved =
      dimension == 3 && options.redistribute == by_elements && options.improver != "none";
  return has_improved ? "pieces" : "none";
}

void prepare_formats() {
#ifdef DOVETAIL_DRIVER_WITH_HDF5
  io::let_hdf5_close_nothing_at_exit();
#endif
}

std::vector<std::string> format_names(int dimension, bool by_ranks) {
  return dimension == 3 ? names_of_formats<3>(by_ranks) : names_of_formats<2>(by_ranks);
}

std::vector<std::string> names_in_folder(const mesh_options& options) {
  using names = std::vector<std::string>;
  const std::pair<const char*, names> by_format[] = {
      {"vtu", {"mesh.pvtu", "mesh_#.vtu", "surface.vtp", "interfaces.vtp", "lines.vtp"}},
      {"msh", {"mesh.msh"}},
      {"msh-partitioned", {"mesh_partitioned.msh"}},
      {"hdf5", {"mesh_#.vtkhdf", "mesh.xdmf", "skeleton.vtkhdf"}},
      {"pvtu", {"ranks.pvtu", "ranks_#.vtu"}},
      {"msh-ranks", {"ranks_#.msh"}},
      {"openfoam",
       {"processor#", "processor#/*", "constant/polyMesh/*", "system/controlDict", "system/decomposeParDict",
        "system/fvSchemes", "system/fvSolution"}},
      {"mfem", {"mesh.#"}},
      {"xdmf", {"ranks.h5", "ranks.xdmf"}},
      {"vtkhdf", {"ranks.vtkhdf"}}};
  names all{"finished_run.txt", "written_by_dovetail", "unfinished", "unfinished/*", "failed", "failed/*"};
  if (options.spool.empty())
    all.insert(all.end(), {"spool", "spool/*"});
  names formats = options.formats;
  if (formats.empty())
    formats = {format_names(options.dimension == 2 ? 2 : 3, options.ranks.has_value()).front()};
  for (const auto& [format, of_format] : by_format)
    if (std::find(formats.begin(), formats.end(), format) != formats.end())
      all.insert(all.end(), of_format.begin(), of_format.end());
  return all;
}

std::vector<std::string> redistributor_names() {
  return names_of(redistributors<3>());
}

template <int D>
std::vector<output_format<D>> make_formats(const mesh_options& options) {
  return make_formats<D>(options, chosen(redistributors<D>(), options.redistribute, "--redistribute"));
}

template <int D>
std::vector<output_format<D>> make_formats(const mesh_options& options,
                                           const any_redistributor<D>& redistribute) {
  if (options.files < 0)
    throw command_line_error("--files: " + std::to_string(options.files) + " is negative");
  const auto known = known_formats<D>(options, redistribute);
  const auto add = [&](std::vector<output_format<D>>& formats, const std::string& name) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& format) { return format.name == name; });
    if (found == known.end())
      throw command_line_error("--format: there is no '" + name + "' for --dimension " + std::to_string(D) +
                               "; there are: " + joined(names_of_formats<D>(false)) + "; with --ranks also " +
                               joined(names_of_formats<D>(true)));
    formats.push_back(*found);
  };
  std::vector<output_format<D>> formats;
  for (const auto& name : options.formats)
    if (name != "none")
      add(formats, name);
  if (options.formats.empty())
    add(formats, format_names(D, options.ranks.has_value()).front());
  check_ranks<D>(options, formats);
  check_order<D>(options, formats);
  return formats;
}

template <int D>
double bytes_per_element(const std::vector<output_format<D>>& formats) {
  const disk_use use(formats);
  if (use.meshes_in_spool == 0) // it shrinks while the last format grows
    return std::max(use.bytes_of_files, spool_bytes_per_element);
  return use.bytes_of_files + use.meshes_in_spool * spool_bytes_per_element;
}

template <int D>
double elements_with_room(const std::vector<output_format<D>>& formats, const std::filesystem::path& folder,
                          const std::filesystem::path& own_spool) {
  const auto with_room = [](const std::filesystem::path& place, double bytes) {
    std::error_code failure;
    const auto space = std::filesystem::space(place, failure);
    return failure ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available) / bytes;
  };
  if (own_spool.empty())
    return with_room(folder, bytes_per_element(formats));
  const disk_use use(formats);
  return std::min(with_room(folder, use.bytes_of_files),
                  with_room(own_spool, std::max(1, use.meshes_in_spool) * spool_bytes_per_element));
}

template std::vector<output_format<2>> make_formats<2>(const mesh_options&);
template std::vector<output_format<3>> make_formats<3>(const mesh_options&);
template std::vector<output_format<2>> make_formats<2>(const mesh_options&, const any_redistributor<2>&);
template std::vector<output_format<3>> make_formats<3>(const mesh_options&, const any_redistributor<3>&);
template double bytes_per_element<2>(const std::vector<output_format<2>>&);
template double bytes_per_element<3>(const std::vector<output_format<3>>&);
template double elements_with_room<2>(const std::vector<output_format<2>>&, const std::filesystem::path&,
                                      const std::filesystem::path&);
template double elements_with_room<3>(const std::vector<output_format<3>>&, const std::filesystem::path&,
                                      const std::filesystem::path&);

} // namespace dovetail::app
