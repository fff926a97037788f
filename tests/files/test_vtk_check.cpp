// VTK itself reads what the VTU writer writes (scripts/check_mesh.py says what it found), and the VTU reader
// reads what VTK writes.
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/files/zlib.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "files/scratch_folder.hpp"
#include "files/script_outcome.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

using namespace dovetail;
using testing::cubes_in_eight;

namespace {

const std::string python = "/usr/bin/python3";

testing::script_outcome check(const std::filesystem::path& folder) {
  return testing::run_script(DOVETAIL_SCRIPTS "/check_mesh.py '" + folder.string() + "'", folder);
}

bool has_vtk() {
  if (std::system((python + " -c 'import vtkmodules.vtkIOXML, numpy' > /dev/null 2>&1").c_str()) == 0)
    return true;
  MESSAGE("skipped: python3-vtk9 is not installed");
  return false;
}

} // namespace

TEST_CASE("VTK reads a valid mesh, for any number of files") {
  if (!has_vtk())
    return;
  for (const int files : {0, 1, 3, 100}) {
    const testing::scratch_folder folder("vtk_check");
    io::vtu_writer{.files = files}(cubes_in_eight.distributed(), folder);
    const auto found = check(folder);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.find("\"elements\": 3072") != std::string::npos);
    CHECK(found.log.find("\"vertices\": 729") != std::string::npos);
    CHECK(found.log.find("\"subdomains\": 8") != std::string::npos);
    CHECK(found.log.find("\"solid \\\"1\\\" <&>\"") != std::string::npos);
    CHECK(found.log.find("\"side walls\": 4.0") != std::string::npos);
    CHECK(found.log.find("\"euler_characteristic\": 2") != std::string::npos);
  }
}

TEST_CASE("the check finds a crack, an inverted element and a wrong surface") {
  if (!has_vtk())
    return;
  const auto spoil = [](auto change) {
    auto mesh = cubes_in_eight.distributed();
    mesh.load = [load = mesh.load, change](local_id p) {
      auto piece = load(p);
      if (p == 1)
        change(piece);
      return piece;
    };
    const testing::scratch_folder folder("vtk_spoilt");
    io::vtu_writer{}(mesh, folder);
    return check(folder);
  };
  const auto inverted =
      spoil([](mesh_piece& piece) { std::swap(piece.mesh.elements[9][0], piece.mesh.elements[9][1]); });
  CHECK(inverted.status != 0);
  CHECK(inverted.log.find("without positive volume") != std::string::npos);
  const auto cracked = spoil([](mesh_piece& piece) { piece.mesh.elements[9] = piece.mesh.elements[8]; });
  CHECK(cracked.status != 0);
  CHECK(cracked.log.find("surface.vtp is not the boundary") != std::string::npos);
}

TEST_CASE("everything that VTK's writer can write is read: text, base64, raw, zlib, both byte orders") {
  if (!has_vtk())
    return;
  const testing::scratch_folder folder("vtk_variants");
  const auto mesh = cubes_in_eight.whole();
  std::vector<double> sizes;
  for (const auto& p : mesh.points)
    sizes.push_back(0.1 + p.x * p.y);
  io::loaded_mesh with_fields;
  with_fields.mesh = mesh;
  with_fields.point_scalars = {{"size", sizes}};
  with_fields.point_fields = {{"place", {}, 3}};
  for (const auto& p : mesh.points)
    with_fields.point_fields[0].values.insert(with_fields.point_fields[0].values.end(), {p.x, p.y, p.z});
  with_fields.element_fields = {{"number", {}}};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    with_fields.element_fields[0].values.push_back(static_cast<double>(e));
  io::write_vtu(with_fields, folder / "mesh.vtu");
  const auto variants = folder / "variants";
  std::filesystem::create_directory(variants);
  REQUIRE(std::system((python + " " DOVETAIL_TESTS "/write_vtk_variants.py '" +
                       (folder / "mesh.vtu").string() + "' '" + variants.string() + "' > /dev/null 2>&1")
                          .c_str()) == 0);
  std::size_t read_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(variants)) {
    if (entry.path().filename() == "lz4") {
      CHECK_THROWS_WITH_AS(io::read_mesh(entry.path(), io::zlib_expand),
                           doctest::Contains("vtkLZ4DataCompressor"), input_error);
      continue;
    }
    CAPTURE(entry.path().string());
    const auto read = io::read_mesh(entry.path(), io::zlib_expand, true);
    ++read_files;
    CHECK(read.mesh.elements == mesh.elements);
    CHECK(read.mesh.tags == mesh.tags);
    REQUIRE(read.scalars("size") != nullptr);
    REQUIRE(read.point_fields.size() == 1);
    REQUIRE(read.point_fields[0].values.size() == 3 * mesh.points.size());
    REQUIRE(read.element_fields.size() == 1);
    CHECK(read.element_fields[0].values == with_fields.element_fields[0].values);
    if (entry.path().filename().string().starts_with("Ascii")) {
      REQUIRE(read.mesh.points.size() == mesh.points.size());
      for (std::size_t v = 0; v < mesh.points.size(); ++v)
        CHECK(distance(read.mesh.points[v], mesh.points[v]) < 1e-6);
    } else {
      CHECK(read.mesh.points == mesh.points);
      CHECK(*read.scalars("size") == sizes);
      CHECK(read.point_fields[0].values == with_fields.point_fields[0].values);
    }
  }
  CHECK(read_files == 2 + 3 * 2 * 2 * 2);
}
