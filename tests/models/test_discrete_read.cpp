#include "discrete_shapes.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "support/refusal.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <doctest/doctest.h>
#include <fstream>
#include <sstream>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

const scratch_folder read_folder("test_discrete_read");

/// Reads a file of this text; the message when that is refused.
std::string refusal(const std::string& name, const std::string& text) {
  write_content(read_folder / name, text);
  return refusal_of<input_error>([&] { return read_triangles(read_folder / name); });
}

double area(const triangle_soup& soup) {
  double sum = 0;
  for (const auto& t : soup.triangles) {
    const vec3 a = soup.points[t[0]];
    sum += 0.5 * norm(cross(soup.points[t[1]] - a, soup.points[t[2]] - a));
  }
  return sum;
}

const std::string square_points = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n";

template <class T>
void put(std::string& to, T value, bool swapped) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (swapped)
    std::reverse(bytes, bytes + sizeof(T));
  to.append(bytes, sizeof(T));
}

std::string binary_ply(bool big) {
  std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\ncomment made here\nelement vertex 4\nproperty double x\nproperty float y\n"
                     "property float z\nproperty uchar red\nelement face 1\nproperty list uchar int "
                     "vertex_indices\nend_header\n";
  const double xy[4][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const auto& p : xy) {
    put(text, p[0], big);
    put(text, static_cast<float>(p[1]), big);
    put(text, 0.0F, big);
    text += '\x7f';
  }
  text += '\x04';
  for (std::int32_t i = 0; i < 4; ++i)
    put(text, i, big);
  return text;
}

} // namespace

TEST_CASE("STL text and binary give the triangles written") {
  const auto box = box_soup({0, 0, 0}, {1, 2, 3}, 2);
  write_text_stl(read_folder / "box.stl", box);
  write_binary_stl(read_folder / "binary.STL", box);
  const auto text = read_triangles(read_folder / "box.stl");
  const auto binary = read_triangles(read_folder / "binary.STL");
  CHECK(text.triangles.size() == 48);
  CHECK(binary.triangles.size() == 48);
  CHECK(area(text) == doctest::Approx(22));
  CHECK(area(binary) == doctest::Approx(22));
  CHECK(text.group_names == std::vector<std::string>{"part"});
  CHECK(text.groups[7] == 0);
  CHECK(binary.groups[7] == no_id);
}

TEST_CASE("STL keywords are keywords in capitals, and behind blanks") {
  const std::string small =
      "solid Part A\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid Part A\n";
  std::string capitals = small;
  for (char& c : capitals)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  write_content(read_folder / "small.stl", small);
  write_content(read_folder / "capitals.stl", capitals);
  write_content(read_folder / "behind.stl", " \r\n\t" + small);
  write_content(read_folder / "mixed.stl", "Solid" + small.substr(5));
  for (const char* name : {"small.stl", "capitals.stl", "behind.stl", "mixed.stl"}) {
    CAPTURE(name);
    const auto soup = read_triangles(read_folder / name);
    CHECK(soup.triangles.size() == 1);
    CHECK(area(soup) == doctest::Approx(0.5));
    CHECK(soup.group_names ==
          std::vector<std::string>{name == std::string("capitals.stl") ? "PART A" : "Part A"});
  }
}

TEST_CASE("OBJ, OFF and PLY give the square written") {
  write_content(read_folder / "a.obj", "# square\nv 0 0 0\nv 2 0 0\nv 2 2 0\nvn 0 0 1\nv 0 2 0\ng lid one\n"
                                       "f 1/1 2/2/1 3//1 -1\n");
  write_content(read_folder / "a.off", "OFF\n# counts\n4 1 0\n" + square_points + "4 0 1 2 3\n");
  write_content(read_folder / "b.off", "OFF 4 2 0\n" + square_points + "3 0 1 2 255 0 0\n3 0 2 3\n");
  write_content(read_folder / "a.ply",
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                "end_header\n" +
                    square_points + "4 0 1 2 3\n");
  write_content(read_folder / "b.ply", binary_ply(false));
  write_content(read_folder / "c.ply", binary_ply(true));
  for (const char* name : {"a.obj", "a.off", "b.off", "a.ply", "b.ply", "c.ply"}) {
    CAPTURE(name);
    const auto soup = read_triangles(read_folder / name);
    CHECK(soup.triangles.size() == 2);
    CHECK(soup.groups.size() == 2);
    CHECK(area(soup) == doctest::Approx(4));
  }
  CHECK(read_triangles(read_folder / "a.obj").group_names == std::vector<std::string>{"lid one"});
}

TEST_CASE("bad files are refused with their names") {
  CHECK_THROWS_AS(read_triangles(read_folder / "missing.stl"), input_error);
  CHECK(has(refusal("a.xyz", "x"), "a.xyz: unknown kind"));
  CHECK(has(refusal("empty.stl", ""), "empty.stl: the file is empty"));
  CHECK(has(refusal("none.stl", "solid x\nendsolid x\n"), "no triangle"));
  CHECK(has(refusal("step.stl", "ISO-10303-21;\nHEADER;\nENDSEC;\n"), "step.stl:1: this is not an STL file"));
  CHECK(has(refusal("cut.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"), "truncated"));
  CHECK(has(refusal("nan.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"), "nan.stl:4:"));
  CHECK(has(refusal("two.stl", "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid"),
            "2 vertices"));
  CHECK(has(refusal("a1.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "a1.obj:3: the face refers to vertex 3"));
  CHECK(has(refusal("a2.obj", "v 0 0\n"), "a2.obj:1:"));
  CHECK(has(refusal("a3.obj", "hello\n"), "no face"));
  CHECK(has(refusal("a1.off", "OFX\n"), "a1.off:1: this is not an OFF file"));
  CHECK(has(refusal("a2.off", "OFF\n4 1 0\n" + square_points), "truncated: faces"));
  CHECK(has(refusal("a3.off", "OFF\n4 1 0\n" + square_points + "3 0 1 4\n"), "refers to vertex 4"));
  CHECK(has(refusal("a1.ply", "plx\n"), "not a PLY file"));
  // Counts that the file has no room for, before anything is made of them.
  for (const char* format : {"ascii", "binary_little_endian"})
    for (const char* properties : {"", "property float x\n", "property list uchar int vertex_indices\n"})
      CHECK(has(refusal("a3.ply", std::string("ply\nformat ") + format + " 1.0\nelement vertex 20000000\n" +
                                      properties + "end_header\n0 0 0\n"),
                "announces 20000000 elements"));
  CHECK(has(refusal("a2.ply", binary_ply(true).substr(0, binary_ply(true).size() - 5)), "truncated"));
}

TEST_CASE("a binary STL of the wrong size is told") {
  write_binary_stl(read_folder / "whole.stl", box_soup({0, 0, 0}, {1, 1, 1}, 3));
  std::ifstream in(read_folder / "whole.stl", std::ios::binary);
  std::stringstream whole;
  whole << in.rdbuf();
  const std::string message = refusal("part.stl", "X" + whole.str().substr(1, 1000));
  CHECK(has(message, "announces 108 triangles and has room for 18"));
}
