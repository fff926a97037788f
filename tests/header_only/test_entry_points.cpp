#include "entry_points.hpp"

#include "files/scratch_folder.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("header-only: a box of CAD becomes a volume mesh, is written and read") {
  const testing::scratch_folder folder("header_only");
  testing::write_content(folder / "no.step", "no STEP file");
  CHECK_FALSE(is_occt_file(folder / "no.step"));
  CHECK_THROWS_AS(read_occt_model(folder / "no.step"), input_error);

  const auto model = occt_shape_from(BRepPrimAPI_MakeBox(1, 1, 1).Shape()).model;
  CHECK(occt_triangulation(model).mesh.elements.size() >= 12);
  generate_options options;
  options.subdomains = 2;
  const auto made = generate<3>(model, uniform_size(0.4),
                                parameters<>{}
                                    .with_mesher(mesher::tetgen{})
                                    .with_partitioner(partition::metis{})
                                    .with_improver(improvement::native::fine())
                                    .with_options(options));
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).valid());

  io::vtu_writer{}(made.mesh, folder);
  CHECK(io::mesh_hash(io::read_mesh(folder / "mesh.pvtu")) == io::mesh_hash(made.mesh));
  io::partitioned_msh_writer{}(made.mesh, folder);
  CHECK(io::mesh_hash(io::read_mesh(folder / "mesh_partitioned.msh")) == io::mesh_hash(made.mesh));
}

TEST_CASE("header-only: a plane domain becomes a mesh of triangles, is written and read") {
  const testing::scratch_folder folder("header_only_plane");
  testing::write_content(folder / "square.txt", "polygon\n0 0\n1 0\n1 1\n0 1\n");
  const plane_domain domain(read_polygons(folder / "square.txt"));
  generate_options options;
  options.subdomains = 2;
  const auto made = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options(options));
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).valid());
  io::vtu_writer{}(made.mesh, folder);
  CHECK(io::mesh_hash(io::read_mesh(folder / "mesh.pvtu")) == io::mesh_hash(made.mesh));
  io::msh_writer{}(made.mesh, folder);
}

TEST_CASE("header-only: sizes from a file, triangles from a file, a formula") {
  const testing::scratch_folder folder("header_only_inputs");
  testing::write_content(folder / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK(read_triangles(folder / "a.off").triangles.size() == 1);
  const implicit_model ball(implicit::sphere{}, {{-1.3, -1.3, -1.3}, {1.3, 1.3, 1.3}}, {.resolution = 8});
  CHECK_FALSE(ball.topology().faces.empty());
}
