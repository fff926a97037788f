// What MFEM's and OpenFOAM's files say is what was written, and what ranks say of each other must fit.
#include "files/read_back.hpp"
#include "files/scratch_folder.hpp"
#include "files/second_order_verdict.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/core/sequence.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/solver/mfem_format.hpp"
#include "dovetail/solver/mfem_reader.hpp"
#include "dovetail/solver/openfoam_format.hpp"
#include "dovetail/solver/openfoam_reader.hpp"
#include "dovetail/solver/rank_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::cubes_in_27;
using testing::text_lines;

namespace {

/// What `dovetail check` finds.
template <class ForEach>
std::string faults_of(const ForEach& for_each) {
  io::streamed_validity found;
  for_each([&](const io::loaded_mesh& piece, const std::filesystem::path& file) {
    found.add(piece, file.string());
  });
  return found.faults();
}

/// Of one rank no elements are told apart.
void expect_ranks(const io::loaded_mesh& read, int ranks) {
  auto subdomains = read.subdomains;
  CHECK(subdomains.size() == (ranks == 1 ? 0 : read.mesh.elements.size()));
  sort_unique(subdomains);
  CHECK(subdomains.size() == (ranks == 1 ? 0 : static_cast<std::size_t>(ranks)));
}

void expect_cubes(const io::loaded_mesh& read) {
  const auto whole = cubes_in_27.whole();
  CHECK(read.mesh.points.size() == whole.points.size());
  CHECK(testing::by_places(read.mesh.points, read.mesh.elements, read.mesh.tags) ==
        testing::by_places(whole.points, whole.elements, whole.tags));
}

} // namespace

TEST_CASE("MFEM: what is read is what was written, of one rank and of several") {
  for (const int ranks : {1, 4}) {
    CAPTURE(ranks);
    const testing::scratch_folder folder("mfem_read");
    io::rank_writer<io::mfem_format>{.ranks = ranks}(cubes_in_27.distributed(), folder);
    const auto read = io::read_mfem(folder / "mesh.000000");
    expect_cubes(read);
    expect_ranks(read, ranks);
    CHECK(read.files.size() == static_cast<std::size_t>(ranks));
    CHECK(read.triangles.size() == 432 + 2 * 72); // and interfaces between solids
    CHECK(read.material_names.size() == 3);
    CHECK(read.material_names[1].second == "solid \"1\" <&>");
    const auto roof = std::find_if(read.triangle_names.begin(), read.triangle_names.end(),
                                   [](const auto& name) { return name.second == "roof"; });
    REQUIRE(roof != read.triangle_names.end());
    CHECK(std::count(read.triangle_tags.begin(), read.triangle_tags.end(), roof->first) == 72);
    CHECK(faults_of([&](const auto& f) {
            io::for_each_mfem_piece(folder / (ranks == 1 ? "mesh.000000" : "mesh.000002"), f);
          }) == "");
  }
}

TEST_CASE("MFEM: a file with one thing changed is refused, in words that name it") {
  const testing::scratch_folder folder("mfem_near");
  io::rank_writer<io::mfem_format>{.ranks = 4}(cubes_in_27.distributed(), folder / "a/b");
  const auto file = folder / "a/b/mesh.000001", lowest = folder / "a/b/mesh.000000";
  const auto read = [&] { io::read_mfem(file); };
  const auto refuse = [&](const std::string& expected, const std::function<void(text_lines&)>& change) {
    testing::expect_refusal(file, expected, change, read);
  };
  const auto set = [](const std::string& heading, std::size_t after, const std::string& line) {
    return [=](text_lines& text) { text.lines[text.find(heading) + after] = line; };
  };
  refuse("mesh.000001: line 1: it does not begin with 'MFEM mesh v1.2'", set("MFEM", 0, "MFEM mesh v1.0"));
  refuse("a mesh of dimension 2", set("dimension", 1, "2"));
  refuse("2000000000 entries are announced", set("elements", 1, "2000000000"));
  refuse("the count -1 is out of range", set("elements", 1, "-1"));
  refuse("the attribute 0 is not from 1 to 3", set("elements", 2, "0 4 0 1 2 3"));
  refuse("the attribute 4 is not from 1 to 3", set("elements", 2, "4 4 0 1 2 3"));
  refuse("an element of type 5; only tetrahedra", set("elements", 2, "1 5 0 1 2 3"));
  refuse("element 0 has the vertex 99999", set("elements", 2, "1 4 0 1 2 99999"));
  refuse("there is no vertex -1", set("elements", 2, "1 4 0 1 2 -1"));
  refuse("boundary element 0 has the vertex 99999", set("boundary", 2, "1 2 0 1 99999"));
  refuse("a coordinate of vertex 0 is not finite", set("vertices", 3, "nan 0 0"));
  refuse("vertices have three coordinates, not '2'", set("vertices", 2, "2"));
  refuse("a number is expected", set("vertices", 3, "zero 0 0"));
  refuse("a number is expected", set("elements", 1, "x"));
  refuse("'mfem_serial_mesh_end' is expected, not 'communication", [](text_lines& text) {
    text.lines.erase(text.lines.begin() + static_cast<std::ptrdiff_t>(text.find("mfem_serial_mesh_end")));
  });
  refuse("has rank 4, and there are 4 files", [](text_lines& text) {
    auto& line = text.lines[text.find("number_of_groups") + 4];
    line = line.substr(0, line.rfind(' ')) + " 4";
  });
  refuse("group 0 is not rank 1 alone", set("# number of entities", 1, "1 0"));
  refuse("has not two or more ranks in growing order", set("# number of entities", 2, "2 1 0"));
  refuse("group 1 does not have rank 1", set("# number of entities", 2, "2 0 2"));
  refuse("group 0, that of the rank alone, is missing", set("number_of_groups", 0, "number_of_groups 0"));
  refuse("fewer vertices are shared than the total says", [](text_lines& text) {
    auto& line = text.lines[text.find("total_shared_vertices")];
    line = "total_shared_vertices " + std::to_string(std::stoi(line.substr(line.find(' '))) + 1);
  });
  refuse("more vertices are shared than the total says", [](text_lines& text) {
    text.lines[text.find("total_shared_vertices")] = "total_shared_vertices 1";
  });

  // Of what the first group, of ranks 0 and 1, shares.
  const auto group = [](const text_lines& text, const std::string& what) {
    return text.find(what, text.find("# group 1"));
  };
  const auto swap_lines = [&](const std::string& what) {
    return [=](text_lines& text) {
      const auto at = group(text, what);
      std::swap(text.lines[at + 1], text.lines[at + 2]);
    };
  };
  refuse("is not where rank 0 has it", swap_lines("shared_vertices"));
  refuse("shared edge 0 of the group of ranks 0 1", swap_lines("shared_edges"));
  refuse("shared face 0 of the group of ranks 0 1", swap_lines("shared_faces"));
  refuse("shared face 0 of the group of ranks 0 1", [&](text_lines& text) { // begins with another vertex
    auto& line = text.lines[group(text, "shared_faces") + 1];
    const std::string vertices = line.substr(2);
    line = "2 " + vertices.substr(vertices.find(' ') + 1) + " " + vertices.substr(0, vertices.find(' '));
  });
  refuse("shared twice", [&](text_lines& text) {
    const auto at = group(text, "shared_vertices");
    text.lines[at + 2] = text.lines[at + 1];
  });
  const auto drop = [&](const std::string& kind) {
    return [=](text_lines& text) {
      for (const std::size_t at : {text.find("total_shared_" + kind), group(text, "shared_" + kind)}) {
        auto& line = text.lines[at];
        const auto space = line.find(' ');
        line = line.substr(0, space + 1) + std::to_string(std::stoi(line.substr(space)) - 1);
      }
      text.lines.erase(text.lines.begin() + static_cast<std::ptrdiff_t>(group(text, "shared_" + kind) + 1));
    };
  };
  for (const std::string kind : {"vertices", "edges", "faces"})
    refuse(" " + kind + " here, and ", drop(kind));
  refuse("mesh.000001: boundary element 0 is turned inwards", [](text_lines& text) {
    auto& line = text.lines[text.find("boundary") + 2]; // attribute 2 a b c
    const auto b = line.rfind(' ', line.rfind(' ') - 1);
    line = line.substr(0, b) + line.substr(line.rfind(' ')) + line.substr(b, line.rfind(' ') - b);
  });
  refuse("boundary element 0 is no side of an element", [](text_lines& text) {
    auto& line = text.lines[text.find("boundary") + 2];
    line = line.substr(0, line.rfind(' ')) +
           line.substr(line.find(' ', 2), line.find(' ', 4) - line.find(' ', 2));
  });
  refuse("is also one of rank 1", [](text_lines& text) {
    const auto at = text.find("boundary");
    text.lines[at + 3] = text.lines[at + 2];
  });

  // Both ranks say the same, which is wrong.
  const auto refuse_in_both = [&](const std::string& expected,
                                  const std::function<void(text_lines&)>& change) {
    text_lines other(lowest);
    const std::string before = testing::file_content(lowest);
    change(other);
    other.write();
    refuse(expected, change);
    testing::write_content(lowest, before);
  };
  for (const std::string kind : {"edges", "faces"})
    refuse_in_both("it does not list all ranks that share the " + kind.substr(0, 4), drop(kind));
  const auto change_line = [&](const std::string& what, const std::function<std::string(std::string)>& how) {
    return [=](text_lines& text) {
      auto& line = text.lines[group(text, what) + 1];
      line = how(line);
    };
  };
  const auto with_last_two_swapped = [](const std::string& line) {
    const auto c = line.rfind(' '), b = line.rfind(' ', c - 1);
    return line.substr(0, b) + line.substr(c) + line.substr(b, c - b);
  };
  const auto with_last_repeated = [](const std::string& line) { // the one before it
    const auto c = line.rfind(' '), b = line.find_last_of(' ', c - 1);
    return line.substr(0, c + 1) +
           line.substr(b == std::string::npos ? 0 : b + 1, c - (b == std::string::npos ? 0 : b + 1));
  };
  refuse_in_both("is turned the wrong way", change_line("shared_faces", with_last_two_swapped));
  refuse_in_both("is no side where the elements of the rank end",
                 change_line("shared_faces", with_last_repeated));
  refuse_in_both("is none of an element", change_line("shared_edges", with_last_repeated));
  refuse_in_both("an edge or a face is shared twice", [&](text_lines& text) {
    const auto at = group(text, "shared_edges");
    text.lines[at + 2] = text.lines[at + 1];
  });
  testing::expect_refusal_when_cut(file, 40, read);
  testing::expect_reading_or_refusal(file, 100, read);
  read();

  // An element that is inverted is a fault of the mesh, where no other rank or boundary says so.
  std::string faults;
  for (std::size_t e = 0; e < 300 && faults.empty(); ++e) {
    const std::string before = testing::file_content(file);
    text_lines text(file);
    auto& line = text.lines[text.find("elements") + 2 + e]; // attribute 4 a b c d
    line = line.substr(0, 4) + line.substr(line.find(' ', 4) + 1) + line.substr(3, line.find(' ', 4) - 3);
    text.write();
    testing::refusal_of<input_error>(
        [&] { faults = faults_of([&](const auto& f) { io::for_each_mfem_piece(file, f); }); });
    testing::write_content(file, before);
  }
  CHECK(faults.find("inverted element") != std::string::npos);

  std::filesystem::remove(folder / "a/b/mesh.000003");
  CHECK(testing::refusal_of<input_error>(read).find("has rank 3, and there are 3 files") !=
        std::string::npos);
  std::filesystem::remove(lowest);
  CHECK(testing::refusal_of<input_error>(read).find("mesh.000000: there is no such file") !=
        std::string::npos);
  CHECK(testing::refusal_of<input_error>([&] { io::read_mfem(folder / "mesh"); }).find("NAME.000000") !=
        std::string::npos);
}

TEST_CASE("MFEM of second order is read where that is asked for") {
  const testing::scratch_folder folder("mfem_quadratic");
  for (const int ranks : {1, 4}) {
    io::rank_writer<io::mfem_format>{.ranks = ranks}(testing::with_bent_edges(cubes_in_27.distributed()),
                                                     folder);
    const auto check = [&] {
      return testing::check_second_order(
          [&](const auto& f) { io::for_each_mfem_piece(folder / "mesh.000000", f, io::element_order::any); });
    };
    testing::expect_second_order(check(), cubes_in_27.whole());
    CHECK(testing::refusal_of<input_error>([&] {
            io::read_mfem(folder / "mesh.000000");
          }).find("second order are not read") != std::string::npos);
    if (ranks == 1)
      continue;
    const auto refuse = [&](const std::string& expected, const std::string& heading, std::size_t after,
                            const std::string& line) {
      testing::expect_refusal(
          folder / "mesh.000001", expected,
          [&](text_lines& text) { text.lines[text.find(heading) + after] = line; }, check);
    };
    testing::expect_reading_or_refusal(folder / "mesh.000001", 100, [&] {
      io::streamed_middles<3> middles;
      const auto add = [&](const io::loaded_mesh& piece, const auto& file) {
        middles.add(piece, file.string());
      };
      io::for_each_mfem_piece(folder / "mesh.000000", add, io::element_order::any);
      middles.faults();
    });
    refuse("'H1_3D_P2' is expected, not 'H1_3D_P3'", "FiniteElementCollection", 0,
           "FiniteElementCollection: H1_3D_P3");
    text_lines text(folder / "mesh.000001");
    const auto corners = std::stoul(text.lines[text.find("vertices") + 1]);
    std::size_t moved = 0;
    for (auto at = text.find("Ordering") + 1 + corners; moved == 0; ++at) { // a middle that others have too
      text_lines spoiled = text;
      spoiled.lines[at] = "0.5 0.5 0.5";
      spoiled.write();
      if (testing::refusal_of<input_error>(check).find("the middle of shared edge ") != std::string::npos)
        moved = at;
    }
    CHECK(moved > 0);
    text.lines[text.find("mfem_serial_mesh_end") - 2] = "9 9 9"; // one that no other has
    text.write();
    CHECK(check().faults.find("mesh.000001: ") == 0);
    CHECK(check().faults.find(" x element that its middles may invert (") != std::string::npos);
  }
}

TEST_CASE("OpenFOAM: what is read is what was written, of one case and of processors") {
  for (const int ranks : {1, 4}) {
    CAPTURE(ranks);
    const testing::scratch_folder folder("foam_read");
    io::rank_writer<io::openfoam_format>{.ranks = ranks}(cubes_in_27.distributed(), folder);
    const std::string mesh = "constant/polyMesh";
    for (const auto& path : {std::filesystem::path(folder), folder / (ranks == 1 ? mesh : "processor1"),
                             folder / ((ranks == 1 ? "" : "processor2/") + mesh + "/owner")}) {
      CAPTURE(path.string());
      const auto read = io::read_openfoam(path);
      expect_cubes(read);
      expect_ranks(read, ranks);
      CHECK(read.files.size() == static_cast<std::size_t>(ranks));
      CHECK(read.triangles.size() == 432);
      CHECK(read.material_names.size() == 3);
      REQUIRE(read.triangle_names.size() == 3);
      CHECK(read.triangle_names[1].second == "roof");
      CHECK(std::count(read.triangle_tags.begin(), read.triangle_tags.end(), 1) == 72);
    }
    CHECK(faults_of([&](const auto& f) { io::for_each_openfoam_piece(folder, f); }) == "");
    if (ranks == 1)
      continue;
    std::filesystem::remove_all(folder / "processor1");
    CHECK(testing::refusal_of<input_error>([&] {
            io::read_openfoam(folder);
          }).find("processor1: there is no mesh of this processor") != std::string::npos);
  }
  const testing::scratch_folder nothing("foam_nothing");
  CHECK(io::folders_of_openfoam(nothing).empty());
  CHECK(testing::refusal_of<input_error>([&] { io::read_openfoam(nothing); }).find("no case of OpenFOAM") !=
        std::string::npos);
}

TEST_CASE("OpenFOAM: a file with one thing changed is refused, in words that name it") {
  const testing::scratch_folder folder("foam_near");
  io::rank_writer<io::openfoam_format>{.ranks = 3}(cubes_in_27.distributed(), folder);
  const auto read = [&] { io::read_openfoam(folder); };
  const auto mesh = folder / "processor1/constant/polyMesh";
  const auto refuse = [&](const char* file, const std::string& expected,
                          const std::function<void(text_lines&)>& change) {
    testing::expect_refusal(mesh / file, expected, change, read);
  };
  const auto set = [](std::size_t after, const std::string& line) { // behind the bracket of the list
    return [=](text_lines& text) { text.lines[text.find("(") + after] = line; };
  };
  const auto set_header = [](const std::string& begin, const std::string& line) {
    return [=](text_lines& text) { text.lines[text.find(begin)] = line; };
  };
  const auto set_count = [](const std::string& count) {
    return [=](text_lines& text) { text.lines[text.find("(") - 1] = count; };
  };
  refuse("points", "it does not begin with the header", set_header("FoamFile", "Header"));
  refuse("points", "not of format ascii", set_header("    format", "    format binary;"));
  refuse("points", "it has a faceList, not a vectorField", set_header("    class", "    class faceList;"));
  refuse("points", "points: line 11: a coordinate of point 0 is not finite", set(1, "(inf 0 0)"));
  refuse("points", "a number is expected", set(1, "(0 0)"));
  refuse("points", "')' is expected", set(1, "(0 0 0 0)"));
  refuse("points", "2000000000 entries are announced", set_count("2000000000"));
  refuse("points", "a list of -4 entries", set_count("-4"));
  refuse("points", "the list does not end after the 3 entries", set_count("3"));
  refuse("points", "there is more than one list", [](text_lines& text) { text.lines.push_back("0()"); });
  refuse("points", "two points are at the same place", [](text_lines& text) {
    const auto at = text.find("(");
    text.lines[at + 2] = text.lines[at + 1];
  });
  refuse("faces", "face 0 has 4 points; only tetrahedra", set(1, "4(0 1 2 3)"));
  refuse("faces", "face 0 has the point 99999", set(1, "3(0 1 99999)"));
  refuse("faces", "face 0 has the point -1", set(1, "3(0 1 -1)"));
  refuse("faces", "is no tetrahedron: its faces 0", set(1, "3(0 0 1)"));
  refuse("faces", "is no tetrahedron: its faces 0", [](text_lines& text) { // turned from neighbour to owner
    auto& line = text.lines[text.find("(") + 1];
    const auto a = line.find('('), b = line.find(' '), c = line.rfind(' ');
    line = "3(" + line.substr(a + 1, b - a) + line.substr(c + 1, line.size() - c - 2) +
           line.substr(b, c - b) + ")";
  });
  refuse("owner", "is of cell 99999", set(1, "99999"));
  refuse("owner", "the number -3 is negative", set(1, "-3"));
  refuse("owner", "which has four other faces already", [](text_lines& text) {
    const auto at = text.find("(");
    text.lines[text.lines.size() - 2] = text.lines[at + 1];
  });
  refuse("owner", "its note says nCells:7, and there are", [](text_lines& text) {
    auto& line = text.lines[text.find("    note")];
    const auto at = line.find("nCells:");
    line = line.substr(0, at) + "nCells:7" + line.substr(line.find(' ', at));
  });
  refuse("owner", "faces have an owner, and there are", [](text_lines& text) {
    const auto at = text.find("(");
    text.lines[at - 1] = std::to_string(std::stoi(text.lines[at - 1]) - 1);
    text.lines.erase(text.lines.begin() + static_cast<std::ptrdiff_t>(at) + 1);
  });
  refuse("neighbour", "the cells cannot have four faces each", [](text_lines& text) {
    const auto at = text.find("(");
    text.lines[at - 1] = std::to_string(std::stoi(text.lines[at - 1]) - 1);
    text.lines.erase(text.lines.begin() + static_cast<std::ptrdiff_t>(at) + 1);
  });
  refuse("neighbour", "which is not the higher one", set(1, "0"));
  refuse("boundary", "it should begin with", [](text_lines& text) {
    auto& line = text.lines[text.find("    startFace")];
    line = "    startFace 0;";
  });
  refuse("boundary", "it should begin with", set_header("    nFaces", "    nFaces 99999;"));
  refuse("boundary", "lacks a type, nFaces or startFace", set_header("    nFaces", "    faces 3;"));
  refuse("boundary", "its patches are not those of processor 0", set_header("floor", "ground"));
  refuse("boundary", "there are two patches roof", set_header("floor", "roof"));
  refuse("boundary", "between processors 2 and 0", set_header("    myProcNo", "    myProcNo 2;"));
  refuse("boundary", "of 3", set_header("    neighbProcNo", "    neighbProcNo 3;"));
  refuse("boundary", "does not say which two processors",
         set_header("    neighbProcNo", "    neighbProcNo 1;"));
  const auto first_label = [](const text_lines& text) {
    std::size_t at = text.find("(", text.find("(") + 1);
    while (text.lines[at + 1] == ")")
      at = text.find("(", at + 1);
    return at + 1;
  };
  refuse("cellZones", "has the cell 99999",
         [&](text_lines& text) { text.lines[first_label(text)] = "99999"; });
  refuse("cellZones", "is in none of the zones", [&](text_lines& text) {
    const auto at = first_label(text);
    text.lines[at - 2] = std::to_string(std::stoi(text.lines[at - 2]) - 1);
    text.lines.erase(text.lines.begin() + static_cast<std::ptrdiff_t>(at));
  });
  refuse("cellZones", "is in two zones", [&](text_lines& text) {
    const auto at = first_label(text);
    text.lines[at + 1] = text.lines[at];
  });
  refuse("cellZones", "there are two zones", [](text_lines& text) {
    const auto at = text.find("solid");
    text.lines[text.find("solid", at + 1)] = text.lines[at];
  });
  refuse("cellZones", "the zones are not those of processor 0", set_header("solid", "liquid"));

  // Upper-triangular order: two faces, whole, change their places.
  const auto swapped = [](const std::filesystem::path& file, std::size_t first, std::size_t second) {
    text_lines text(file);
    const auto at = text.find("(") + 1;
    std::swap(text.lines[at + first], text.lines[at + second]);
    text.write();
  };
  for (const char* file : {"faces", "owner", "neighbour"})
    swapped(mesh / file, 0, 1);
  CHECK(testing::refusal_of<input_error>(read).find("breaks the upper-triangular order") !=
        std::string::npos);
  for (const char* file : {"faces", "owner", "neighbour"})
    swapped(mesh / file, 0, 1);
  read();

  // The same face of both is in a patch of the boundary.
  const auto other = folder / "processor0/constant/polyMesh/boundary";
  const auto add_to_last_patch = [](text_lines& text, const std::string& processor) {
    const auto add = [&](std::size_t line, int more) {
      auto& entry = text.lines[line];
      const auto at = entry.rfind(' ') + 1;
      entry = entry.substr(0, at) + std::to_string(std::stoi(entry.substr(at)) + more) + ";";
    };
    add(text.find("    nFaces", text.find("side_walls")), 1);
    add(text.find("    nFaces", text.find(processor)), -1);
    add(text.find("    startFace", text.find(processor)), 1);
  };
  const std::string before = testing::file_content(other);
  text_lines changed(other);
  add_to_last_patch(changed, "procBoundary0to1");
  changed.write();
  refuse("boundary", "a face of a patch that is not between processors is also one of processor",
         [&](text_lines& text) { add_to_last_patch(text, "procBoundary1to0"); });
  testing::write_content(other, before);

  // Patches that are there once, or twice.
  const auto add_patch = [](int here, int there) {
    return [=](text_lines& text) {
      const auto count = text.find("(") - 1;
      text.lines[count] = std::to_string(std::stoi(text.lines[count]) + 1);
      std::size_t last = text.find("    nFaces");
      for (std::size_t at = last; at < text.lines.size(); ++at)
        if (text.lines[at].starts_with("    nFaces"))
          last = at;
      const auto number = [](const std::string& line) { return std::stoi(line.substr(line.rfind(' '))); };
      text.lines.insert(text.lines.end() - 1,
                        "another { type processor; nFaces 0; startFace " +
                            std::to_string(number(text.lines[last]) + number(text.lines[last + 1])) +
                            "; myProcNo " + std::to_string(here) + "; neighbProcNo " + std::to_string(there) +
                            "; }");
    };
  };
  refuse("boundary", "there are two patches to processor 2", add_patch(1, 2));
  refuse("boundary", "has no counterpart in processor 0, or is there twice", add_patch(1, 0));
  const auto shift = [](text_lines& text, std::size_t line, int more) {
    auto& entry = text.lines[line];
    const auto at = entry.rfind(' ') + 1;
    entry = entry.substr(0, at) + std::to_string(std::stoi(entry.substr(at)) + more) + ";";
  };
  testing::expect_refusal(
      folder / "processor2/constant/polyMesh/boundary", "it has no patch to processor 0",
      [&](text_lines& text) { // its faces are in the patch before it
        const auto at = text.find("procBoundary2to0"), faces = text.find("    nFaces", at);
        shift(text, text.find("    nFaces", text.find("side_walls")),
              std::stoi(text.lines[faces].substr(10)));
        const auto line = [&](std::size_t k) { return text.lines.begin() + static_cast<std::ptrdiff_t>(k); };
        text.lines.erase(line(at), line(text.find("}", at) + 1));
        auto& count = text.lines[text.find("(") - 1];
        count = std::to_string(std::stoi(count) - 1);
      },
      read);
  refuse("boundary", " faces, and processor 0 has ", [&](text_lines& text) {
    shift(text, text.find("    nFaces", text.find("procBoundary1to0")), 1);
    shift(text, text.find("    nFaces", text.find("procBoundary1to2")), -1);
    shift(text, text.find("    startFace", text.find("procBoundary1to2")), 1);
  });
  refuse("boundary", " on are in no patch",
         [&](text_lines& text) { shift(text, text.find("    nFaces", text.find("procBoundary1to2")), -1); });

  // Faces of a processor patch, the last of all faces: in another order, and beginning elsewhere.
  const auto swap_last = [&] {
    for (const char* file : {"faces", "owner"}) {
      text_lines text(mesh / file);
      const auto end = text.lines.size() - 1;
      std::swap(text.lines[end - 1], text.lines[end - 2]);
      text.write();
    }
  };
  swap_last();
  CHECK(testing::refusal_of<input_error>(read).find(
            "of patch procBoundary2to1 is not where processor 1 has it") != std::string::npos);
  swap_last();
  testing::expect_refusal(
      mesh / "faces", "does not begin with the same point there",
      [](text_lines& text) {
        auto& line = text.lines[text.lines.size() - 2];
        const auto b = line.find(' ');
        line = "3(" + line.substr(b + 1, line.size() - b - 2) + " " + line.substr(2, b - 2) + ")";
      },
      read);
  testing::expect_refusal(
      mesh / "points", "of patch procBoundary1to0 is not where processor 0 has it",
      [&](text_lines& text) { // a point of the patch to processor 0 is moved by little
        const text_lines boundary(mesh / "boundary");
        const auto entry = boundary.find("    startFace", boundary.find("procBoundary1to0"));
        const auto face = std::stoul(boundary.lines[entry].substr(14));
        const text_lines of_faces(mesh / "faces");
        const auto& line = of_faces.lines[of_faces.find("(") + 1 + face];
        auto& place = text.lines[text.find("(") + 1 + std::stoul(line.substr(2))];
        place = "(0.123456789" + place.substr(place.find(' '));
      },
      read);
  for (const char* file : {"points", "faces", "owner", "neighbour", "boundary", "cellZones"})
    testing::expect_refusal_when_cut(mesh / file, 10, read);
  for (const char* file : {"points", "faces", "owner", "neighbour", "boundary", "cellZones"})
    testing::expect_reading_or_refusal(mesh / file, 20, read);
  read();
  std::filesystem::remove_all(folder / "processor2");
  CHECK(testing::refusal_of<input_error>(read).find("of 2") != std::string::npos);
}
