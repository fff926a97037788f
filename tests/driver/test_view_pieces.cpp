#include "view_pieces.hpp"

#include "any_mesh_file.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/files/write_msh.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/solver/mfem_format.hpp"
#include "dovetail/solver/openfoam_format.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/rank_msh_format.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"
#include "support/refusal.hpp"
#include "view_memory.hpp"
#include "view_meshes.hpp"
#include "view_picture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

using dovetail::testing::coarse_cubes_in_eight;
using dovetail::testing::scratch_folder;

constexpr std::int64_t all = 1'000'000; ///< triangles of a page that has everything

/// The files of a mesh in pieces: a VTU file for each or for some of them, without groups, or files of ranks,
/// which have some.
void write(const std::string& how, const std::filesystem::path& folder) {
  if (how == "mfem")
    io::rank_writer<io::mfem_format>{.ranks = 3}(coarse_cubes_in_eight.distributed(), folder);
  else if (how == "openfoam")
    io::rank_writer<io::openfoam_format>{.ranks = 3}(coarse_cubes_in_eight.distributed(), folder);
  else if (how == "msh")
    io::rank_writer<io::rank_msh_format>{.ranks = 3, .format = {.binary = false}}(
        coarse_cubes_in_eight.distributed(), folder);
  else
    io::vtu_writer{.files = how == "vtu" ? 0 : 3}(coarse_cubes_in_eight.distributed(), folder);
  std::filesystem::remove(folder / "surface.vtp");
}

view_scene whole_of(const std::filesystem::path& folder) {
  return scene_of(read_any_mesh(find_any_mesh(folder)));
}

/// Where the corners of some simplices are, in their order.
template <class Simplices>
std::vector<vec3> places(const view_scene& scene, const Simplices& simplices) {
  std::vector<vec3> at;
  for (const auto& vertices : simplices)
    for (const local_id v : vertices)
      at.push_back(scene.points[v]);
  return at;
}

/// What is said of the elements behind the triangles.
template <class T>
std::vector<T> behind(const view_scene& scene, const std::vector<T>& of_elements) {
  std::vector<T> said;
  for (const local_id e : scene.element_of)
    said.push_back(of_elements.at(e));
  return said;
}

std::vector<std::array<local_id, 2>> ends(const view_scene& scene) {
  std::vector<std::array<local_id, 2>> all_ends;
  for (const outline_edge& edge : scene.outline)
    all_ends.push_back(edge.ends);
  return all_ends;
}

TEST_CASE("read piece by piece, a mesh has the scene of the whole") {
  for (const std::string how : {"vtu", "vtu of several", "msh", "mfem", "openfoam"}) {
    INFO(how);
    const scratch_folder folder("view_pieces");
    write(how, folder);
    const view_scene whole = whole_of(folder);
    const auto read = view_pieces::read(find_any_mesh(folder), all);
    REQUIRE(read);
    const view_scene& scene = read->scene;
    CHECK(read->elsewhere.empty());
    CHECK(scene.count == whole.count);
    CHECK(scene.vertices == whole.vertices);
    CHECK(scene.least_angle == whole.least_angle);
    CHECK(scene.box.lower == whole.box.lower);
    CHECK(scene.box.upper == whole.box.upper);
    CHECK(scene.outer == whole.outer);
    CHECK(scene.outer == 6 * 6 * 6 * 2);
    CHECK(places(scene, scene.triangles) == places(whole, whole.triangles));
    CHECK(scene.groups.names == whole.groups.names);
    CHECK(scene.groups.of == whole.groups.of);
    CHECK(scene.pieces.names == whole.pieces.names);
    CHECK(scene.materials.names == whole.materials.names);
    CHECK(behind(scene, scene.pieces.of) == behind(whole, whole.pieces.of));
    CHECK(behind(scene, scene.materials.of) == behind(whole, whole.materials.of));
    CHECK(behind(scene, scene.angles) == behind(whole, whole.angles));
    CHECK(places(scene, ends(scene)) == places(whole, ends(whole)));
    CHECK(scene.centres == whole.centres);
    CHECK(places(scene, scene.tetrahedra) == places(whole, whole.tetrahedra));
    CHECK(std::equal(whole.pieces.of.begin(), whole.pieces.of.end(), scene.pieces.of.begin()));
  }
}

/// The groups of outer triangles by their corners.
std::map<std::vector<std::array<double, 3>>, std::string> groups_by_place(const view_scene& scene) {
  std::map<std::vector<std::array<double, 3>>, std::string> groups;
  for (std::size_t t = 0; t < scene.outer; ++t) {
    std::vector<std::array<double, 3>> place;
    for (const vec3 p : corners(span_of(scene.points), scene.triangles[t]))
      place.push_back({p.x, p.y, p.z});
    std::sort(place.begin(), place.end());
    groups[place] = scene.groups.names.at(static_cast<std::size_t>(scene.groups.of[t]));
  }
  return groups;
}

TEST_CASE("VTU files have the groups of the surface beside them, as MSH files of the mesh have their own") {
  const scratch_folder folder("view_pieces"), other("view_pieces_msh");
  auto mesh = coarse_cubes_in_eight.distributed();
  mesh.group_names = {"inlet", "", "walls & more", "", "walls & more"};
  io::vtu_writer{}(mesh, folder);
  io::rank_writer<io::rank_msh_format>{.ranks = 3}(mesh, other);
  const view_scene scene = view_pieces::read(folder / "mesh.pvtu", all)->scene;
  const auto groups = groups_by_place(scene);
  CHECK(groups.size() == 6 * 6 * 6 * 2);
  CHECK(groups == groups_by_place(view_pieces::read(io::find_mesh_file(other), all)->scene));
  CHECK(scene.groups.names.size() == 10); // nine and what is between pieces
  CHECK(scene.groups.names[0] == "inlet");
  CHECK(scene.groups.names[1] == "walls & more"); // as CAD face 1 is inside
  CHECK(scene.groups.names.back() == "between pieces");
}

TEST_CASE("a file beside the mesh that is not its surface, or damaged, gives no groups") {
  const scratch_folder folder("view_pieces");
  io::vtu_writer{}(coarse_cubes_in_eight.distributed(), folder);
  const std::string surface = dovetail::testing::file_content(folder / "surface.vtp");
  const auto names_with = [&](const std::string& content) {
    dovetail::testing::write_content(folder / "surface.vtp", content);
    return view_pieces::read(folder / "mesh.pvtu", all)->scene.groups.names;
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string content = surface;
    const std::size_t at = content.find(from);
    REQUIRE(at != std::string::npos);
    return content.replace(at, from.size(), to);
  };
  CHECK(names_with(surface).size() == 4);
  std::filesystem::remove(folder / "surface.vtp");
  const auto without = view_pieces::read(folder / "mesh.pvtu", all)->scene.groups.names;
  CHECK(without.size() == 3); // by material, and between pieces
  CHECK(names_with(changed("\"patch\"", "\"match\"")) == without);
  CHECK(names_with(changed("\"patch_names\"", "\"match_names\"")) == without);
  CHECK(names_with(changed("\"GlobalNodeIds\" ", "\"GlobalNodeIdx\" ")) == without);
  CHECK(names_with(surface.substr(0, surface.size() / 2)) == without);
  CHECK(names_with("") == without);
  std::string moved = surface;
  moved[moved.find("\n_") + 2 + 8] ^= 1; // of the first coordinate
  CHECK(names_with(moved) == without);
  auto finer = coarse_cubes_in_eight;
  finer.cells = 8;
  const scratch_folder other("view_pieces_finer");
  io::vtu_writer{}(finer.distributed(), other);
  CHECK(names_with(dovetail::testing::file_content(other / "surface.vtp")) == without);
  std::string index = dovetail::testing::file_content(folder / "mesh.pvtu"); // of a part of the mesh
  const std::string first = "<Piece Source=\"mesh_0000.vtu\"/>";
  dovetail::testing::write_content(folder / "mesh.pvtu", index.erase(index.find(first), first.size()));
  CHECK(names_with(surface) == without);
}

TEST_CASE("what is between files but not between pieces is seen where it has a group") {
  for (const bool grouped : {false, true}) {
    const scratch_folder folder("view_pieces");
    std::string index = "<?xml version=\"1.0\"?><VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>";
    for (local_id part = 0; part < 2; ++part) { // a row of two cubes, each in a file of its own
      io::loaded_mesh cube = testing::row_of_cubes(1);
      for (std::size_t v = 0; v < cube.mesh.points.size(); ++v) {
        cube.mesh.points[v].x += part;
        cube.node_ids.push_back(static_cast<global_id>(v) + 4 * part);
      }
      cube.subdomains.assign(cube.mesh.elements.size(), 0);
      if (grouped && part == 1) { // one file alone has it
        cube.triangles = {{0, 1, 3}};
        cube.triangle_tags = {5};
      }
      const std::string name = "part_" + std::to_string(part) + ".vtu";
      io::write_vtu(cube, folder / name);
      index += "<Piece Source=\"" + name + "\"/>";
    }
    dovetail::testing::write_content(folder / "mesh.pvtu", index + "</PUnstructuredGrid></VTKFile>");
    const auto read = view_pieces::read(folder / "mesh.pvtu", all);
    REQUIRE(read);
    CHECK(read->scene.outer == 20);
    CHECK(read->scene.triangles.size() == (grouped ? 22 : 20));
    CHECK(read->scene.vertices == 12);
    CHECK(places(read->scene, read->scene.triangles) ==
          places(whole_of(folder / "mesh.pvtu"), whole_of(folder / "mesh.pvtu").triangles));
  }
}

TEST_CASE("of the elements there are those of a page: the worst of the whole mesh, and spread ones") {
  const scratch_folder folder("view_pieces");
  write("vtu", folder);
  const view_scene whole = whole_of(folder);
  for (const std::int64_t inside : {0, 1, 10, 101, 1000}) {
    const std::int64_t most = static_cast<std::int64_t>(whole.triangles.size()) + 4 * inside + 3;
    const auto read = view_pieces::read(io::find_mesh_file(folder), most);
    REQUIRE(read);
    const view_scene& scene = read->scene;
    const view_part part = part_that_fits(scene, most), part_of_whole = part_that_fits(whole, most);
    REQUIRE(part.elements.size() == part_of_whole.elements.size());
    CHECK(part.elements.size() >= static_cast<std::size_t>(inside));
    CHECK(part.triangles == part_of_whole.triangles);
    CHECK(text_of_left_out(scene, part) == text_of_left_out(whole, part_of_whole));
    CHECK(complete_under(scene, part) == complete_under(whole, part_of_whole));
    CHECK(scene.elements_elsewhere() == whole.count - part.elements.size());
    const std::size_t worst = view_part::worst_of(part.elements.size());
    std::set<std::vector<double>> different;
    for (std::size_t k = 0; k < part.elements.size(); ++k) {
      const auto at = static_cast<std::size_t>(part.elements[k]);
      if (k < worst)
        CHECK(scene.angles[at] == whole.angles[part_of_whole.elements[k]]);
      std::vector<double> place;
      for (const vec3 p : corners(span_of(scene.points), scene.tetrahedra[at]))
        place.insert(place.end(), {p.x, p.y, p.z});
      different.insert(place);
    }
    CHECK(different.size() == part.elements.size());
  }
}

TEST_CASE("pictures are those of the whole mesh, with all elements in sections and under an angle") {
  for (const std::string how : {"vtu", "msh"}) {
    const scratch_folder folder("view_pieces");
    write(how, folder);
    const view_scene whole = whole_of(folder);
    auto read = view_pieces::read(io::find_mesh_file(folder), 0);
    REQUIRE(read);
    CHECK(read->scene.tetrahedra.empty());
    view_wishes wishes;
    wishes.width = wishes.height = 150;
    const auto check = [&](const std::string& what) {
      INFO(how << ", " << what);
      if (wishes.cut || wishes.under)
        read->take_elements(wishes.explode, 100'000, [&](float angle, const std::array<vec3, 4>& corners) {
          return is_drawn(wishes, angle, corners);
        });
      const raster_image expected = picture_of_view(whole, wishes),
                         image = picture_of_view(read->scene, wishes);
      CHECK(std::equal(image.data(), image.data() + 150 * 150, expected.data()));
    };
    check("surface");
    wishes.cut = view_plane{{1, 0, 0}, 0.37};
    check("section");
    CHECK(read->scene.tetrahedra.size() > 100);
    CHECK(read->scene.tetrahedra.size() < whole.tetrahedra.size() / 2);
    wishes.explode = 0.5;
    wishes.cut->place = 0.15; // in another layer of cells than where pieces are together
    wishes.colours = view_colours::piece;
    check("section of pieces apart");
    wishes.under = whole.least_angle + 15;
    check("under an angle");
    CHECK(elements_under(read->scene, *wishes.under) == elements_under(whole, *wishes.under));
    CHECK(elements_under(whole, *wishes.under) > 0);
    wishes.cut = std::nullopt;
    wishes.under = 0;
    check("nothing");
    CHECK(read->scene.tetrahedra.empty());
  }
}

TEST_CASE("of more elements than can be drawn there are the worst ones, in their order") {
  const scratch_folder folder("view_pieces");
  write("vtu", folder);
  const view_scene whole = whole_of(folder);
  auto read = view_pieces::read(io::find_mesh_file(folder), 0);
  REQUIRE(read);
  const auto all_of_them = [](float, const std::array<vec3, 4>&) { return true; };
  for (const std::size_t most : {1, 10, 700}) {
    CHECK(read->take_elements(0, most, all_of_them) == whole.count);
    REQUIRE(read->scene.tetrahedra.size() == most);
    const double under = angle_of_worst(whole, 180, most);
    CHECK(elements_under(whole, under) <= most);
    CHECK(elements_under(read->scene, under) == elements_under(whole, under));
    CHECK(std::all_of(read->scene.angles.begin(),
                      read->scene.angles.begin() + static_cast<std::ptrdiff_t>(most),
                      [&](float angle) { return angle <= under; }));
    CHECK(angle_of_worst(read->scene, 170, most) == 170);
  }
  const auto at = places(read->scene, read->scene.tetrahedra), at_whole = places(whole, whole.tetrahedra);
  auto from = at_whole.begin();
  for (const vec3 p : at) // each is found behind the one before
    REQUIRE((from = std::find(from, at_whole.end(), p)) != at_whole.end());
}

TEST_CASE("what is in one file, or has no numbers, is not read in pieces") {
  const scratch_folder folder("view_pieces");
  io::write_msh(testing::row_of_cubes(2), folder / "mesh.msh");
  CHECK_FALSE(view_pieces::read(folder / "mesh.msh", all));
}

TEST_CASE("a file that takes more memory than there is has a warning") {
  CHECK(text_of_memory(1'000'000, 8e9).empty());
  CHECK(text_of_memory(5'000'000'000, 0).empty()); // where it is not known
  CHECK(text_of_memory(5'000'000'000, 8e9).find(" and this machine has 8 GB; ") != std::string::npos);
  CHECK(memory_of_machine() > 1e8);
}

TEST_CASE("a part of a larger mesh is said to be one; files that do not belong together are refused") {
  const scratch_folder folder("view_pieces");
  write("vtu", folder);
  std::string index = dovetail::testing::file_content(folder / "mesh.pvtu");
  const auto at = index.find("<Piece Source=\"mesh_0000.vtu\"/>");
  REQUIRE(at != std::string::npos);
  dovetail::testing::write_content(folder / "mesh.pvtu",
                                   index.erase(at, std::string("<Piece Source=\"mesh_0000.vtu\"/>").size()));
  const auto read = view_pieces::read(folder / "mesh.pvtu", all);
  REQUIRE(read);
  CHECK(read->elsewhere.ends_with("this is a part of a larger mesh"));
  // Points of the skeleton come first in a file, some of them shared with others: they are put elsewhere.
  write("vtu", folder);
  std::string piece = dovetail::testing::file_content(folder / "mesh_0001.vtu");
  const std::size_t data = piece.find("\n_") + 2 + 8;
  std::fill_n(piece.begin() + static_cast<std::ptrdiff_t>(data), 60 * sizeof(vec3), '\0');
  dovetail::testing::write_content(folder / "mesh_0001.vtu", piece);
  const std::string said = dovetail::testing::refusal_of<input_error>(
      [&] { return view_pieces::read(folder / "mesh.pvtu", all); });
  CHECK(said.starts_with((folder / "mesh.pvtu").string() + ": two points have the global number"));
}

/// The angles of what a sample of these angles keeps.
std::vector<float> kept_of(const std::vector<float>& angles, std::size_t most, std::size_t room) {
  element_sample sample(most);
  for (const float angle : angles)
    sample.add(angle, [&] { return lone_element{{}, {}, 0, 0, angle, 0}; });
  CHECK(sample.seen() == angles.size());
  CHECK(sample.held() <= 3 * most);
  std::vector<float> kept;
  for (const lone_element& element : sample.take(room))
    kept.push_back(element.angle);
  return kept;
}

TEST_CASE("a sample has the worst ones and spread ones, of however many") {
  for (const int count : {1, 9, 10, 11, 20, 21, 100, 1000}) {
    std::vector<float> angles;
    for (int k = 0; k < count; ++k) // each once, the small ones anywhere
      angles.push_back(static_cast<float>(k * 337 % 1009));
    std::vector<float> sorted = angles;
    std::sort(sorted.begin(), sorted.end());
    for (const std::size_t room : {std::size_t{10}, std::size_t{7}, std::size_t{1}, std::size_t{0}}) {
      const auto kept = kept_of(angles, 10, room);
      REQUIRE(kept.size() == std::min<std::size_t>(room, angles.size()));
      CHECK(std::set<float>(kept.begin(), kept.end()).size() == kept.size());
      if (angles.size() <= room) {
        CHECK(kept == angles);
        continue;
      }
      const std::size_t worst = view_part::worst_of(room);
      CHECK(std::equal(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(worst), sorted.begin()));
      std::vector<std::ptrdiff_t> order;
      for (std::size_t k = worst; k < kept.size(); ++k)
        order.push_back(std::find(angles.begin(), angles.end(), kept[k]) - angles.begin());
      CHECK(std::is_sorted(order.begin(), order.end()));
      if (count == 1000 && room == 10) { // from one end to the other
        CHECK(order.front() < 300);
        CHECK(order.back() > 600);
      }
    }
  }
  CHECK(kept_of({3, 3, 3, 3, 3}, 2, 2).size() == 2);
}

} // namespace
} // namespace dovetail::app
