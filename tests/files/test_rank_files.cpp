// Files of parallel solvers: each rank its own, read by somebody else's reader (check_rank_files.py).
#include "files/bent_edges.hpp"
#include "files/scratch_folder.hpp"
#include "files/script_outcome.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/mfem_format.hpp"
#include "dovetail/solver/openfoam_format.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/rank_files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

using namespace dovetail;
using testing::cubes_in_27;

namespace {

testing::script_outcome check(const std::string& format, const std::filesystem::path& folder, int ranks) {
  return testing::run_script(DOVETAIL_TESTS "/check_rank_files.py " + format + " '" + folder.string() + "' " +
                                 std::to_string(ranks),
                             folder);
}

bool has_python_module(const std::string& name) {
  if (std::system(("/usr/bin/python3 -c 'import numpy, " + name + "' > /dev/null 2>&1").c_str()) == 0)
    return true;
  MESSAGE("skipped: Python has no " << name);
  return false;
}

/// The volume that checkMesh finds.
double volume_in(const std::string& log) {
  const std::string before = "Total volume = ";
  const auto at = log.find(before);
  return at == std::string::npos ? 0 : std::stod(log.substr(at + before.size()));
}

} // namespace

TEST_CASE("PVTU: VTK reads what each rank has, copies marked, with and without ghosts") {
  if (!has_python_module("vtkmodules.vtkIOXML"))
    return;
  for (const int ranks : {1, 4}) {
    const testing::scratch_folder folder("ranks_pvtu");
    const auto summary = io::rank_writer<io::pvtu_format>{.ranks = ranks}(cubes_in_27.distributed(), folder);
    CHECK(summary.get("elements") == 1296);
    CHECK(summary.get("files") == ranks + 1);
    CHECK(summary.find("redistribution").get("ranks") == ranks);
    CHECK(summary.files.back() == "ranks.pvtu");
    const auto found = check("pvtu", folder, ranks);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.starts_with("1296 elements, 343 vertices, 432 boundary sides, measure 1.000000000"));
    CHECK((found.log.find(" 0 copies, 0 ghosts") != std::string::npos) == (ranks == 1));
  }
  const testing::scratch_folder folder("ranks_pvtu");
  io::rank_writer<io::pvtu_format>{.ranks = 3, .ghosts = true}(cubes_in_27.distributed(), folder);
  const auto found = check("pvtu", folder, 3);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.find(" 0 ghosts") == std::string::npos);
  auto spoilt = testing::file_content(folder / "ranks_0001.vtu");
  spoilt[spoilt.size() - 29] = 0; // the last element is no ghost any more
  testing::write_content(folder / "ranks_0001.vtu", spoilt);
  CHECK(check("pvtu", folder, 3).status != 0);
}

TEST_CASE("PVTU of triangles") {
  if (!has_python_module("vtkmodules.vtkIOXML"))
    return;
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z M1 1 h0.5 v0.5 h-0.5 Z"));
  const auto result = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 7}));
  const testing::scratch_folder folder("ranks_triangles");
  for (const auto& mesh : {result.mesh, testing::with_bent_edges(result.mesh)}) {
    io::rank_writer<io::pvtu_format>{.ranks = 3}(mesh, folder);
    const auto found = check("pvtu", folder, 3);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.find("measure 5.750000000") != std::string::npos);
    const auto nodes = " " + std::to_string(io::number_nodes(mesh).points()) + " vertices";
    CHECK(found.log.find(nodes) != std::string::npos);
  }
}

TEST_CASE("PVTU of second order: VTK reads nodes in the middle of edges, with and without ghosts") {
  if (!has_python_module("vtkmodules.vtkIOXML"))
    return;
  const auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  for (const bool ghosts : {false, true}) {
    const testing::scratch_folder folder("ranks_quadratic");
    io::rank_writer<io::pvtu_format>{.ranks = 4, .ghosts = ghosts}(mesh, folder);
    const auto found = check("pvtu", folder, 4);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.starts_with("1296 elements, 2197 vertices, 432 boundary sides, measure 1.000000000"));
    CHECK((found.log.find(" 0 ghosts") == std::string::npos) == ghosts);
  }
}

TEST_CASE("OpenFOAM: checkMesh finds the processors' meshes right, and faces in another order wrong") {
  if (std::system("command -v checkMesh mpirun > /dev/null 2>&1") != 0) {
    MESSAGE("skipped: OpenFOAM is not installed");
    return;
  }
  const testing::scratch_folder folder("ranks_openfoam");
  io::rank_writer<io::openfoam_format>{.ranks = 3}(cubes_in_27.distributed(), folder);
  auto found = check("openfoam", folder, 3);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(volume_in(found.log) == doctest::Approx(1));
  for (const char* line :
       {"cells:            1296", "boundary patches: 3", "Number of regions: 1", "side_walls          288",
        "Upper triangular ordering OK", "solid__0_____       432"})
    CHECK_MESSAGE(found.log.find(line) != std::string::npos, line);

  const auto faces = folder / "processor2/constant/polyMesh/faces"; // its last patch is one of a processor
  auto text = testing::file_content(faces);
  const auto last = text.rfind("3(");
  const auto before = text.rfind("3(", last - 1);
  const auto end = text.find('\n', last);
  testing::write_content(faces, text.substr(0, before) + text.substr(last, end + 1 - last) +
                                    text.substr(before, last - before) + text.substr(end + 1));
  CHECK(check("openfoam", folder, 3).status != 0);
}

TEST_CASE(
    "OpenFOAM: one rank has a case that is not decomposed, and no other number of ranks leaves a trace") {
  const testing::scratch_folder folder("ranks_openfoam_whole");
  const auto has = [&](const char* name) { return std::filesystem::exists(folder / name); };
  const auto write = [&](int ranks) {
    return io::rank_writer<io::openfoam_format>{.ranks = ranks}(cubes_in_27.distributed(), folder);
  };
  write(1);
  CHECK(has("constant/polyMesh/points"));
  write(3);
  CHECK_FALSE(has("constant/polyMesh"));
  CHECK(has("processor2/constant/polyMesh/points"));
  CHECK(testing::file_content(folder / "system/decomposeParDict").find("Subdomains 3;") != std::string::npos);
  testing::write_content(folder / "processor0/constant/polyMesh/cellProcAddressing", "of another mesh");
  testing::write_content(folder / "processor2/constant/polyMesh/cellProcAddressing", "of another mesh");
  write(2); // the number of folders says for how many processors the case is
  CHECK_FALSE(has("processor0/constant/polyMesh/cellProcAddressing"));
  CHECK_FALSE(has("processor2"));
  const auto summary = write(1);
  CHECK(summary.files.size() == 10);
  CHECK_FALSE(has("processor0"));
  CHECK(testing::file_content(folder / "system/decomposeParDict").find("Subdomains 1;") != std::string::npos);
  if (std::system("command -v checkMesh > /dev/null 2>&1") != 0) {
    MESSAGE("skipped: OpenFOAM is not installed");
    return;
  }
  const auto found = check("openfoam", folder, 1);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(volume_in(found.log) == doctest::Approx(1));
  for (const char* line : {"cells:            1296", "boundary patches: 3", "solid__0_____       432"})
    CHECK_MESSAGE(found.log.find(line) != std::string::npos, line);
}

TEST_CASE("OpenFOAM: dictionaries of others are kept, with those of dovetail beside them") {
  const testing::scratch_folder folder("ranks_openfoam_kept");
  std::filesystem::create_directories(folder / "system");
  testing::write_content(folder / "system/controlDict", "application simpleFoam;\n");
  const auto summary = io::rank_writer<io::openfoam_format>{.ranks = 2}(cubes_in_27.distributed(), folder);
  CHECK(testing::file_content(folder / "system/controlDict") == "application simpleFoam;\n");
  CHECK(std::filesystem::exists(folder / "system/fvSchemes"));
  CHECK(testing::file_count(folder / "system") == 4);
  CHECK(summary.files.size() == 15);
  CHECK(summary.get("files") == 15);
}

TEST_CASE("MFEM: ranks agree about what each group of them shares, sides are there once") {
  if (!has_python_module("os")) // but NumPy
    return;
  const testing::scratch_folder folder("ranks_mfem");
  const auto summary = io::rank_writer<io::mfem_format>{.ranks = 5}(cubes_in_27.distributed(), folder);
  CHECK(summary.files.back() == "mesh.000004");
  const auto found = check("mfem", folder, 5);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.starts_with("1296 elements, 343 vertices, 432 boundary sides, measure 1.000000000"));
  // Bottom, two faces between solids, top, and the walls around.
  CHECK(found.log.find("attribute: {1: 72, 2: 72, 3: 72, 4: 72, 5: 288} materials: [1, 2, 3]") !=
        std::string::npos);
  CHECK(testing::file_content(folder / "mesh.000000").find("# element attribute 2: solid \"1\" <&>\n") !=
        std::string::npos);

  auto spoilt = testing::file_content(folder / "mesh.000001");
  const auto edges = spoilt.find("\n", spoilt.find("shared_edges")) + 1;
  const auto gap = spoilt.find(' ', edges), end = spoilt.find('\n', edges);
  testing::write_content(folder / "mesh.000001", spoilt.substr(0, edges) +
                                                     spoilt.substr(gap + 1, end - gap - 1) + " " +
                                                     spoilt.substr(edges, gap - edges) + spoilt.substr(end));
  CHECK(check("mfem", folder, 5).status != 0); // an edge from its other end
}

TEST_CASE("MFEM of second order: nodes are those of H1_3D_P2, with ghosts asked for or not") {
  if (!has_python_module("os")) // but NumPy
    return;
  const testing::scratch_folder folder("ranks_mfem_quadratic"), with_ghosts("ranks_mfem_ghosts");
  const auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  io::rank_writer<io::mfem_format>{.ranks = 5}(mesh, folder);
  const auto found = check("mfem", folder, 5);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.starts_with("1296 elements, 2197 vertices, 432 boundary sides, measure 1.000000000"));
  CHECK(found.log.find("attribute: {1: 72, 2: 72, 3: 72, 4: 72, 5: 288}") != std::string::npos);
  io::rank_writer<io::mfem_format>{.ranks = 5, .ghosts = true}(mesh, with_ghosts);
  const auto file = testing::file_content(folder / "mesh.000003");
  CHECK(file == testing::file_content(with_ghosts / "mesh.000003"));

  const auto end = file.find("\n\nmfem_serial_mesh_end"); // the last two nodes are exchanged
  const auto last = file.rfind('\n', end - 1), before = file.rfind('\n', last - 1);
  testing::write_content(folder / "mesh.000003", file.substr(0, before) + file.substr(last, end - last) +
                                                     file.substr(before, last - before) + file.substr(end));
  CHECK(check("mfem", folder, 5).status != 0);
}

TEST_CASE("workers write the files of ranks in the finishing pass, beside others; pieces stay") {
  auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  bool released = false;
  mesh.release = [&released](local_id, const piece_note&) { released = true; };
  const testing::scratch_folder folder("ranks_finishing"), alone("ranks_alone");
  const io::rank_writer<io::pvtu_format> by_ranks{.ranks = 4};
  by_ranks(mesh, alone);
  for (const auto& executor :
       {any_executor(parallel::serial{}), any_executor(parallel::processes{.worker_count = 2})}) {
    const auto finished =
        io::finish_mesh<3>(mesh, {io::vtu_writer{}, by_ranks}, folder, executor, {.release = true});
    CHECK_FALSE(released); // the ranks load them again
    CHECK(finished.hash == io::mesh_hash(mesh));
    for (const auto& name : {"ranks.pvtu", "ranks_0000.vtu", "ranks_0003.vtu"})
      CHECK(testing::file_content(folder / name) == testing::file_content(alone / name));
    CHECK(std::filesystem::exists(folder / "mesh.pvtu"));
    CHECK_FALSE(std::filesystem::exists(folder / "unfinished"));
    CHECK(io::finish_mesh<3>(mesh, {by_ranks}, folder, executor).hash == finished.hash);
  }
}

TEST_CASE("files of more ranks do not stay behind; a mesh that does not fit leaves none") {
  const testing::scratch_folder folder("ranks_fewer");
  io::rank_writer<io::pvtu_format>{.ranks = 5}(cubes_in_27.distributed(), folder);
  io::rank_writer<io::pvtu_format>{.ranks = 2}(cubes_in_27.distributed(), folder);
  CHECK(testing::file_count(folder) == 3);
  for (const int ranks : {4, 2}) // the number of folders says for how many processors the case is
    io::rank_writer<io::openfoam_format>{.ranks = ranks}(cubes_in_27.distributed(), folder);
  CHECK(std::filesystem::exists(folder / "processor1/constant/polyMesh/points"));
  CHECK_FALSE(std::filesystem::exists(folder / "processor2"));
  const testing::scratch_folder other("ranks_wrong");
  CHECK_THROWS_AS(io::rank_writer<io::pvtu_format>{.ranks = 28}(cubes_in_27.distributed(), other),
                  partition_error);
  const auto quadratic = testing::with_bent_edges(cubes_in_27.distributed());
  CHECK_THROWS_WITH_AS(io::rank_writer<io::openfoam_format>{.ranks = 2}(quadratic, other),
                       doctest::Contains("openfoam are of first order"), usage_error);
  const auto cracked = cubes_in_27.spoilt(20, [](mesh_piece& piece) { piece.skeleton_points[0] = 1 << 20; });
  CHECK_THROWS_AS(io::rank_writer<io::pvtu_format>{.ranks = 2}(cracked, other), mesh_error);
  CHECK(testing::file_count(other) == 0);
}
