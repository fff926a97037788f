// HDF5 files of parallel solvers: h5py and VTK read them (check_rank_files.py).
#include "io/scratch_folder.hpp"
#include "io/stacked_cubes.hpp"

#include "dovetail/io/hdf5_format.hpp"
#include "dovetail/io/rank_files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

/// The script's exit status (0: one mesh) and what it printed.
std::pair<int, std::string> check(const std::string& format, const std::filesystem::path& folder, int ranks) {
  const auto log = folder / "check.txt";
  const int status =
      std::system(("/usr/bin/python3 " DOVETAIL_TESTS "/check_rank_files.py " + format + " '" +
                   folder.string() + "' " + std::to_string(ranks) + " > '" + log.string() + "' 2>&1")
                      .c_str());
  return {status, testing::file_content(log)};
}

bool has_python_module(const std::string& name) {
  if (std::system(("/usr/bin/python3 -c 'import numpy, " + name + "' > /dev/null 2>&1").c_str()) == 0)
    return true;
  MESSAGE("skipped: Python has no " << name);
  return false;
}

const testing::stacked_cubes cubes{.cells = 6, .cuts = 3, .solids = 3, .jitter = 0.3};
const std::string one_mesh = "1296 elements, 343 vertices, 432 boundary sides, measure 1.000000000, ";

} // namespace

TEST_CASE("plain arrays with an XDMF file: h5py reads one mesh") {
  if (!has_python_module("h5py"))
    return;
  const testing::scratch_folder folder("ranks_xdmf");
  const auto summary = io::rank_writer<io::xdmf_format>{.ranks = 4}(cubes.distributed(), folder);
  CHECK(summary.get("files") == 2);
  const auto [status, log] = check("xdmf", folder, 4);
  INFO(log);
  CHECK(status == 0);
  CHECK(log.find(one_mesh) != std::string::npos);
  CHECK(log.find("'side walls': 288") != std::string::npos);
  CHECK(log.find("regions: ['solid \"0\" <&>', ") != std::string::npos);
  auto spoilt = testing::file_content(folder / "ranks.xdmf");
  spoilt.replace(spoilt.find("343 3"), 5, "342 3");
  testing::write_content(folder / "ranks.xdmf", spoilt);
  CHECK(check("xdmf", folder, 4).first != 0);
}

TEST_CASE("VTKHDF: VTK reads one mesh, with ghosts") {
  if (!has_python_module("vtkmodules.vtkIOHDF"))
    return;
  const testing::scratch_folder folder("ranks_vtkhdf");
  io::rank_writer<io::vtkhdf_format>{.ranks = 3, .ghosts = true}(cubes.distributed(), folder);
  const auto [status, log] = check("vtkhdf", folder, 3);
  INFO(log);
  CHECK(status == 0);
  CHECK(log.starts_with(one_mesh));
  CHECK(log.find(" 0 ghosts") == std::string::npos);
  CHECK(check("vtkhdf", folder, 4).first != 0); // there is no rank 3
}

TEST_CASE("a file that cannot be written is named, and HDF5 prints nothing") {
  const testing::scratch_folder folder("ranks_hdf5");
  const auto mesh = cubes.distributed();
  const io::rank_source<3> source{mesh, io::number_by_ranks(mesh, std::vector<local_id>(27, 0), 1)};
  CHECK_THROWS_WITH_AS(io::vtkhdf_format{}.write_all<3>(source, {folder / "none" / "ranks.vtkhdf"}),
                       doctest::Contains("ranks.vtkhdf: HDF5"), io_error);
}
