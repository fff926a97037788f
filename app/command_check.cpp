#include "any_mesh_file.hpp"
#include "commands.hpp"
#include "failure.hpp"
#include "file_checksums.hpp"
#include "finished_run.hpp"
#include "mesh_files.hpp"
#include "run_figures.hpp"

#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/files/streamed_interfaces.hpp"
#include "dovetail/files/streamed_middles.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/parallel/serial.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

std::string faults_of(const simplicial_mesh<3>& mesh) {
  return check_validity(mesh).text();
}
/// Of a shell, which may be open and have sheets that meet; crossing triangles are faults of it too.
std::string faults_of(const simplicial_mesh<2>& mesh) {
  const validity found = check_validity(mesh, {.closed_boundary = false, .non_manifold_sides = true});
  if (!found.valid())
    return found.text();
  const auto pairs = crossing_triangles(mesh.points, mesh.elements, {}, parallel::serial{});
  if (pairs.empty())
    return {};
  return std::to_string(pairs.size()) + " x crossing triangles (" + std::to_string(pairs.front().first) +
         " and " + std::to_string(pairs.front().second) + (pairs.size() > 1 ? ", ...)" : ")");
}

/// How much a mesh has.
struct mesh_extent {
  int dimension;
  std::uint64_t elements;
  std::uint64_t vertices;
  std::uint64_t middles; ///< of edges, where elements are of second order
};

/// Of files whose tables of names have all materials or CAD faces: what is not in them, in words; empty where
/// all is.
std::string without_name(const io::loaded_mesh& mesh, const std::filesystem::path& file) {
  const bool is_surface = file.extension() == ".vtp";
  const auto& names = is_surface ? mesh.triangle_names : mesh.material_names;
  if (names.empty() || !(is_surface || file.extension() == ".pvtu"))
    return {};
  const auto& tags = is_of_triangles(mesh) ? mesh.triangle_tags : mesh.mesh.tags;
  const auto count = static_cast<local_id>(names.size());
  const auto wrong = std::find_if(
      tags.begin(), tags.end(), [&](local_id tag) { return tag >= count || tag < (is_surface ? no_id : 0); });
  if (wrong == tags.end())
    return {};
  return "element " + std::to_string(wrong - tags.begin()) + " is of the " +
         (is_surface ? "CAD face " : "material ") + std::to_string(*wrong) + ", and there are names of " +
         std::to_string(count);
}

int print_validity(const std::string& faults, const std::string& file, const mesh_extent& extent) {
  if (!faults.empty()) {
    complain(file + ": not a valid mesh: " + faults);
    return exit_failure;
  }
  std::string middles;
  if (extent.middles > 0)
    middles = ", of second order with " + std::to_string(extent.middles) + " middles of edges";
  std::printf("%s: a valid mesh of %llu %s and %llu vertices%s\n", file.c_str(),
              static_cast<unsigned long long>(extent.elements),
              extent.dimension == 3 ? "tetrahedra" : "triangles",
              static_cast<unsigned long long>(extent.vertices), middles.c_str());
  return exit_ok;
}

/// Of a mesh of several subdomains.
void print_at_interfaces(const std::optional<quality_at_interfaces>& found, int dimension) {
  if (found)
    std::printf("%s", at_interfaces_text(*found, dimension).c_str());
}

int print_quality(const quality_statistics& quality,
                  const std::optional<quality_at_interfaces>& at_interfaces, std::uint64_t points,
                  int dimension, const std::string& file, const stats_options& options) {
  std::printf("%s: %llu vertices\n%s", file.c_str(), static_cast<unsigned long long>(points),
              quality_text(quality, dimension).c_str());
  print_at_interfaces(at_interfaces, dimension);
  if (!options.report.empty())
    write_quality_report(quality, dimension, static_cast<std::int64_t>(points), {}, options.report,
                         at_interfaces);
  return exit_ok;
}

/// Of a mesh that is held whole: nothing where it has not several subdomains.
template <int D>
std::optional<quality_at_interfaces> found_at_interfaces(const simplicial_mesh<D>& mesh,
                                                         const std::vector<local_id>& subdomains) {
  if (subdomains.size() != mesh.elements.size())
    return std::nullopt;
  const io::read_piece<D> whole{mesh, {}, subdomains};
  io::streamed_interfaces<D> interfaces;
  interfaces.add(whole);
  if (!interfaces.has_several_subdomains())
    return std::nullopt;
  return io::measure_at_interfaces(whole, interfaces.points());
}

/// Of tetrahedra in several files. These are read twice: no element can be measured before all interfaces
/// are known, and nobody holds them all.
class interfaces_of_files {
public:
  /// One more piece, read for the first time.
  void add(const io::loaded_mesh& piece) { interfaces_.add(numbered(piece, pieces_++, subdomains_)); }
  /// Nothing where there are not several subdomains.
  std::optional<quality_at_interfaces> read_again(const std::filesystem::path& file) {
    if (!interfaces_.has_several_subdomains())
      return std::nullopt;
    const io::interface_points points = interfaces_.points();
    quality_at_interfaces found;
    local_id pieces = 0;
    const auto measure = [&](const io::loaded_mesh& corners) {
      found.merge(io::measure_at_interfaces(numbered(corners, pieces++, subdomains_), points));
    };
    for_each_piece_of_any(
        file, [&](const io::loaded_mesh& piece, const auto&) { with_corners(piece, measure); },
        io::element_order::any);
    return found;
  }

private:
  /// Where the files do not name subdomains, each piece is one.
  static io::read_piece<3> numbered(const io::loaded_mesh& piece, local_id number,
                                    std::vector<local_id>& subdomains) {
    if (piece.subdomains.size() == piece.mesh.elements.size())
      return {piece.mesh, piece.node_ids, piece.subdomains};
    subdomains.assign(piece.mesh.elements.size(), number);
    return {piece.mesh, piece.node_ids, subdomains};
  }

  io::streamed_interfaces<3> interfaces_;
  local_id pieces_ = 0;
  std::vector<local_id> subdomains_; ///< of a piece of a file that has none
};

/// How a mesh in these files is called: by the one that was given, or by the first and last where none stands
/// for all.
std::string name_of(const std::filesystem::path& given, const std::vector<std::filesystem::path>& files) {
  const bool by_number = !files.empty() && (files.front().extension() == ".msh" || // else those of MFEM
                                            files.front().extension().string().starts_with(".0"));
  if (files.size() < 2 || !by_number)
    return given.string();
  return files.front().string() + " to " + files.back().filename().string();
}

/// Of tetrahedra in several files, one in memory at a time. `files` receives these.
std::optional<int> check_streamed(const std::filesystem::path& file,
                                  std::vector<std::filesystem::path>& files) {
  io::streamed_validity found;
  io::streamed_middles<3> middles;
  std::string nameless;
  interfaces_of_files interfaces;
  numbers_of_pieces all;
  const auto add = [&](const io::loaded_mesh& piece, const std::filesystem::path& path) {
    with_corners(piece, [&](const io::loaded_mesh& corners) {
      found.add(corners, path.filename().string());
      interfaces.add(corners);
    });
    middles.add(piece, path.filename().string());
    if (nameless.empty() && !(nameless = without_name(piece, file)).empty())
      nameless = path.filename().string() + ": " + nameless;
    all.add(piece);
    files.push_back(path);
  };
  if (!for_each_piece_of_any(file, add, io::element_order::any))
    return std::nullopt;
  const std::string name = name_of(file, files);
  try {
    std::string faults = found.faults();
    if (faults.empty())
      faults = middles.faults();
    if (faults.empty())
      faults = nameless;
    const mesh_extent extent{3, found.elements(), found.points(), middles.points()};
    if (faults.empty())
      faults = all.elsewhere(extent.vertices + extent.middles);
    const int result = print_validity(faults, name, extent);
    if (result == exit_ok)
      print_at_interfaces(interfaces.read_again(file), 3);
    return result;
  } catch (const input_error& problem) {
    throw input_error(name + ": " + problem.what());
  }
}

/// What the figures are not of.
void warn_of_elsewhere(const std::string& file, const std::string& elsewhere) {
  if (!elsewhere.empty())
    std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), elsewhere.c_str());
}

std::optional<int> measure_streamed(const std::filesystem::path& file, const stats_options& options) {
  quality_statistics quality;
  interfaces_of_files interfaces;
  io::number_ranges points, nodes;
  numbers_of_pieces all;
  std::vector<std::filesystem::path> files;
  const auto add_numbers = [](io::number_ranges& to, const io::loaded_mesh& piece) {
    for (const global_id id : piece.node_ids)
      to.add(id);
  };
  const auto add = [&](const io::loaded_mesh& piece, const std::filesystem::path& path) {
    with_corners(piece, [&](const io::loaded_mesh& corners) {
      quality.merge(measure_quality(corners.mesh), quality.elements);
      interfaces.add(corners);
      add_numbers(points, corners);
    });
    add_numbers(nodes, piece);
    all.add(piece);
    files.push_back(path);
  };
  if (!for_each_piece_of_any(file, add, io::element_order::any))
    return std::nullopt;
  const std::string name = name_of(file, files);
  warn_of_elsewhere(name, all.elsewhere(nodes.count()));
  return print_quality(quality, interfaces.read_again(file), points.count(), 3, name, options);
}

/// Of a mesh that was read at once.
struct found_middles {
  std::string faults;
  std::uint64_t points;
};

template <int D>
found_middles check_middles(const io::loaded_mesh& mesh) {
  io::streamed_middles<D> middles;
  middles.add(mesh, "");
  return {middles.faults(), middles.points()};
}

/// A mesh that was read at once.
template <int D>
struct whole_mesh {
  simplicial_mesh<D> mesh;
  std::vector<local_id> subdomains; ///< per element; empty where the file has none
  std::string name;
  std::string elsewhere; ///< what says that it is a part of another one
};

/// Calls `f` with that: tetrahedra, or triangles where there are none; of second order with their corners.
template <class F>
int with_mesh_of(const std::filesystem::path& file, io::loaded_mesh loaded, const F& f) {
  std::string name = name_of(file, loaded.files);
  std::string elsewhere = part_of_larger(loaded, file);
  if (io::detail::has_middles(loaded))
    loaded = io::corners_of(loaded);
  if (!is_of_triangles(loaded))
    return f(whole_mesh<3>{std::move(loaded.mesh), std::move(loaded.subdomains), std::move(name),
                           std::move(elsewhere)});
  auto subdomains = std::move(loaded.triangle_subdomains);
  return f(whole_mesh<2>{take_triangles(std::move(loaded)), std::move(subdomains), std::move(name),
                         std::move(elsewhere)});
}

/// Whether the files of a run are as it wrote them. `listed_in` names what lists them.
int check_files(const report_files& given, const std::string& listed_in) {
  if (const std::string faults = faults_of(given); !faults.empty()) {
    complain(listed_in + ": not as it was written: " + faults);
    return exit_failure;
  }
  const std::size_t count = given.files.size();
  std::printf("%s: %zu %s written\n", listed_in.c_str(), count,
              count == 1 ? "file is as it was" : "files are as they were");
  return exit_ok;
}

/// Says which meshes in a folder are not those of the run whose record is there: of other formats, an earlier
/// run has left them.
void tell_of_other_runs(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& meshes,
                        const std::vector<written_file>& of_run) {
  std::string others;
  for (const auto& mesh : meshes)
    if (std::none_of(of_run.begin(), of_run.end(), [&](const written_file& file) {
          return (folder / file.name).lexically_normal() == mesh.lexically_normal();
        }))
      others += (others.empty() ? "" : ", ") + mesh.filename().string();
  if (!others.empty())
    std::printf("%s: not of the run that finished_run.txt tells of: %s\n", folder.c_str(), others.c_str());
}

/// Whether what the record of a run lists is as it was written: of a folder all of it, of a mesh its files,
/// `read`. A mesh can be damaged and still be one. Nothing is said where there is no record of these.
int check_record(const std::filesystem::path& path, const std::vector<std::filesystem::path>& read) {
  std::error_code failure;
  const bool is_folder = std::filesystem::is_directory(path, failure);
  report_files run{is_folder ? path : path.parent_path(), {}};
  run.files = files_of_run_in(run.folder);
  const auto is_read = [&](const written_file& file) {
    const auto place = (run.folder / file.name).lexically_normal();
    return place == path.lexically_normal() || std::any_of(read.begin(), read.end(), [&](const auto& each) {
             return each.lexically_normal() == place;
           });
  };
  if (!is_folder)
    std::erase_if(run.files, [&](const written_file& file) { return !is_read(file); });
  return run.files.empty() ? exit_ok : check_files(run, path.string());
}

/// `files` receives those that have the mesh.
int check_file(const std::filesystem::path& file, std::vector<std::filesystem::path>& files) {
  if (const auto result = check_streamed(file, files))
    return *result;
  io::loaded_mesh loaded = read_any_mesh(file, io::element_order::any);
  files = loaded.files;
  const found_middles middles = is_of_triangles(loaded) ? check_middles<2>(loaded) : check_middles<3>(loaded);
  const std::string nameless = without_name(loaded, file);
  return with_mesh_of(file, std::move(loaded), [&]<int D>(const whole_mesh<D>& read) {
    const simplicial_mesh<D>& mesh = read.mesh;
    std::string faults = faults_of(mesh);
    for (const std::string& others : {middles.faults, nameless, read.elsewhere})
      if (faults.empty())
        faults = others;
    const int result =
        print_validity(faults, read.name, {D, mesh.elements.size(), mesh.points.size(), middles.points});
    if (result == exit_ok)
      print_at_interfaces(found_at_interfaces(mesh, read.subdomains), D);
    return result;
  });
}

/// Whether a report lists one of these files. O(n log n) in the files.
bool is_of_run(const std::vector<std::filesystem::path>& files, const report_files& run) {
  std::error_code failure;
  std::set<std::filesystem::path> places;
  for (const auto& file : files)
    places.insert(std::filesystem::weakly_canonical(file, failure));
  return std::any_of(run.files.begin(), run.files.end(), [&](const written_file& listed) {
    return places.contains(std::filesystem::weakly_canonical(run.folder / listed.name, failure));
  });
}

/// Of a folder, each mesh in it. `read` receives the files that were.
int check_mesh(const std::filesystem::path& path, std::vector<std::filesystem::path>& read) {
  std::error_code failure;
  if (!std::filesystem::is_directory(path, failure)) {
    const int result = check_file(path, read);
    read.push_back(path);
    return result == exit_ok ? check_record(path, read) : result;
  }
  const auto all = all_meshes_in(path);
  if (all.empty())
    io::find_mesh_file(path); // says what is there instead
  int result = exit_ok;
  for (const auto& file : all) {
    if (std::find(read.begin(), read.end(), file) != read.end())
      continue;
    std::vector<std::filesystem::path> files;
    if (const int of_file = check_file(file, files); of_file != exit_ok)
      result = of_file;
    read.push_back(file);
    read.insert(read.end(), files.begin(), files.end());
  }
  if (const auto of_run = files_of_run_in(path); !of_run.empty())
    tell_of_other_runs(path, all, of_run);
  return result == exit_ok ? check_record(path, {}) : result;
}

} // namespace

int run_check(const check_options& options) {
  if (options.mesh.empty() && options.report.empty())
    throw command_line_error("check: give a mesh file, or --report with the report of a run, or both");
  std::vector<std::filesystem::path> read;
  if (options.report.empty())
    return check_mesh(options.mesh, read);
  const report_files run = files_of_report(options.report);
  const int files = check_files(run, options.report);
  if (options.mesh.empty())
    return files;
  const int mesh = check_mesh(options.mesh, read);
  if (mesh == exit_ok && !is_of_run(read, run)) {
    complain(options.report + ": of another run: it lists none of the files of " + options.mesh);
    return exit_failure;
  }
  return files == exit_ok ? mesh : files;
}

int run_stats(const stats_options& options) {
  const std::filesystem::path file = find_any_mesh(options.mesh);
  if (const auto result = measure_streamed(file, options))
    return *result;
  return with_mesh_of(
      file, read_any_mesh(file, io::element_order::any), [&]<int D>(const whole_mesh<D>& read) {
        warn_of_elsewhere(read.name, read.elsewhere);
        return print_quality(measure_quality(read.mesh), found_at_interfaces(read.mesh, read.subdomains),
                             read.mesh.points.size(), D, read.name, options);
      });
}

} // namespace dovetail::app
