#include "view_page.hpp"

#include "files/scratch_folder.hpp"
#include "view_meshes.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

namespace dovetail::app {
namespace {

using dovetail::testing::file_content;
using dovetail::testing::scratch_folder;
using dovetail::testing::write_content;

std::string page_of(io::loaded_mesh mesh, std::int64_t most = 1000, const std::string& name = "a mesh",
                    const view_marks& marks = {}) {
  const view_scene scene = scene_of(std::move(mesh));
  return page_of_view(scene, part_that_fits(scene, most), name, marks);
}

/// What draw_view.js says of a page, by key; empty without node or three.js.
std::map<std::string, std::string> drawn(const std::string& page) {
  std::map<std::string, std::string> values;
  if (!has_three_js() || std::system("node --version > /dev/null 2>&1") != 0) {
    MESSAGE("skipped: node or three.js is not installed");
    return values;
  }
  const scratch_folder folder("view_page");
  write_content(folder / "page.html", page);
  const int status = std::system(("node '" DOVETAIL_DRAW_VIEW "' '" + (folder / "page.html").string() +
                                  "' > '" + (folder / "drawn").string() + "'")
                                     .c_str());
  CHECK(status == 0);
  std::istringstream lines(file_content(folder / "drawn"));
  for (std::string key, value; lines >> key && std::getline(lines >> std::ws, value);)
    values[key] = value;
  return values;
}

TEST_CASE("the page is whole, and refers to nothing outside") {
  const std::string page = page_of(testing::cubes_in_pieces(2), 1000, "an <odd> </script> name\xff");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(page.ends_with("</html>\n"));
  // three.js has loaders, which nothing here uses.
  const std::size_t begin = page.find("<script id=\"three\">");
  const std::string own = page.substr(0, begin) + page.substr(page.find("</script>", begin));
  CHECK(own.find("THREE.WebGLRenderer") != std::string::npos);
  for (const std::string not_there : {"http", "src=\"", "href=\"", "fetch(", "XMLHttpRequest", "import",
                                      "<odd>", "DATA_OF", "TEXT_OF", "SCRIPT_OF"})
    CHECK_MESSAGE(own.find(not_there) == std::string::npos, not_there);
}

TEST_CASE("a name may be what a script's place is called") {
  const std::string page = page_of(testing::cubes_in_pieces(2), 1000, "TEXT_OF_THREE_JS");
  CHECK(page.find("\"TEXT_OF_THREE_JS\"") != std::string::npos);
  CHECK(page.find("<script id=\"three\">TEXT_OF") == std::string::npos);
}

TEST_CASE("two pieces: their sides, sections, and elements by angle") {
  auto values = drawn(page_of(testing::cubes_in_pieces(2)));
  if (values.empty())
    return;
  CHECK(values["title"] == "a mesh");
  CHECK(values["figures"] ==
        "a mesh · 12 tetrahedra · 12 vertices · least angle 45.00° · 2 groups · 2 pieces");
  CHECK(values["groups"] == "2");
  CHECK(values["edges"] == "0"); // as the address of the page asks
  CHECK(values["whole.surface"] == "20");
  CHECK(values["whole.section"] == "0");
  CHECK(values["whole.width"] == "2");
  CHECK(values["cut.surface"] == "24");
  CHECK(values["cut.area"] == "1"); // the square across the row
  CHECK(values["cut.place"] == "-0.5");
  CHECK(std::stod(values["view.area"]) > 0.5);
  CHECK(values["apart.surface"] == "24");
  CHECK(values["apart.width"] == "3");
  CHECK(values["under44.surface"] == "0");
  CHECK(values["under44.ghost"] == "20");
  CHECK(values["under46.surface"] == "48");
  CHECK(values["none.surface"] == "0");
  CHECK(values["all.surface"] == "20");
  CHECK(values["without.surface"] == "4"); // what is between the pieces
  CHECK(values["colour.piece"] != values["colour.angle"]);
  CHECK(values["turned"] == "-3.5");
  CHECK(values["moved"] == "true");
  CHECK(values["pinched"] == "0.5"); // from 100 to 200 pixels
  CHECK(values["rendered"] == "true");
}

TEST_CASE("triangles have groups as pieces, and no sections") {
  auto values = drawn(page_of(testing::two_squares()));
  if (values.empty())
    return;
  CHECK(values["figures"] == "a mesh · 4 triangles · 6 vertices · least angle 45.00° · 2 groups · 2 pieces");
  CHECK(values["whole.surface"] == "4");
  CHECK(values["cut.section"] == "0");
  CHECK(values["apart.width"] == "3");
  CHECK(values["under44.surface"] == "0");
  CHECK(values["under46.surface"] == "4");
  CHECK(values["without.surface"] == "2");
  CHECK(values["colour.group"] != values["colour.angle"]);
}

TEST_CASE("marks are discs where the report has them, and say what they are") {
  view_marks marks{"run.json", {}};
  marks.all.push_back({{0.5, 0.25, 1}, "forced", {220, 40, 40}, "3° of a </script>"});
  marks.all.push_back({{1.75, 0.5, 0.5}, "remeshing", {30, 100, 225}, "9° of a face"});
  marks.all.push_back({{2, 0.5, 0.5}, "forced", {220, 40, 40}, "20° of a face"});
  auto values = drawn(page_of(testing::cubes_in_pieces(2), 1000, "a mesh", marks));
  if (values.empty())
    return;
  CHECK(values["figures"].ends_with("2 pieces · 3 marks"));
  CHECK(values["marks.all"] == "3");
  CHECK(values["marks.labels"] == "forced #dc2828; remeshing #1e64e1");
  CHECK(values["marks.control"] == "shown");
  CHECK(values["marks.last"] == "-0.5,-0.25,0.5"); // drawn over the others, relative to the middle
  CHECK(values["marks.offset"] == "0");
  CHECK(values["marks.told"] == "3° of a </script>");
  CHECK(values["marks.beside"] == "nothing");
  CHECK(values["marks.cut"] == "1"); // what is nearer to the viewer, where x is larger, is taken away
  CHECK(values["marks.apart"] == "0");
  CHECK(values["marks.none"] == "0");
  CHECK(values["marks.hidden"] == "3"); // the same, with holes, where they are hidden
  CHECK(values["marks.note"] == "hollow: behind the surface");
  CHECK(values["marks.noteApart"] == "none while pieces are apart");
  CHECK(values["marks.disabledApart"] == "true");
  CHECK(values["marks.disabled"] == "false");
}

TEST_CASE("the mesh is fitted again to another window or without the panel, until the view is moved") {
  auto values = drawn(page_of(testing::cubes_in_pieces(5))); // wider than a narrow window
  if (values.empty())
    return;
  for (const std::string when : {"home", "narrow", "panel", "back"})
    CHECK_MESSAGE(values["fits." + when] == "true", when);
  for (const std::string how : {"turned", "zoomed"})
    CHECK_MESSAGE(values["stays." + how] == "true", how);
}

TEST_CASE("without marks there is no control for them; of a report without any the page says so") {
  auto without = drawn(page_of(testing::cubes_in_pieces(2)));
  auto empty = drawn(page_of(testing::cubes_in_pieces(2), 1000, "a mesh", {"run.json", {}}));
  if (without.empty() || empty.empty())
    return;
  CHECK(without["marks.all"] == "0");
  CHECK(without["marks.labels"] == "none");
  CHECK(without["marks.control"] == "hidden");
  CHECK(without["figures"].ends_with("2 pieces"));
  CHECK(empty["figures"].ends_with("2 pieces · no marks in run.json"));
}

TEST_CASE("the legend follows the choice of colours") {
  auto values = drawn(page_of(testing::cubes_in_pieces(2)));
  if (values.empty())
    return;
  const std::string angles = "0° 10° 20° 30° 40° 50° 60° ≥70°";
  CHECK(values["legend.group"] == "none; groups have colours");
  CHECK(values["legend.piece"].starts_with("#"));
  CHECK(values["legend.piece"].ends_with("piece 1; groups have none"));
  CHECK(values["legend.material"].ends_with("material 0; groups have none"));
  CHECK(values["legend.angle"] == angles + "; groups have none");
  CHECK(values["legend.under"] == angles + "; groups have none"); // of elements groups are not seen
}

TEST_CASE("of elements that are not there at all no angle is told") {
  auto values = drawn(page_of(testing::cubes_in_pieces(2), 24));
  if (values.empty())
    return;
  CHECK(values["figures"].ends_with("2 pieces · none of 12 elements inside"));
  const std::string none = "This page has none of the 12 elements inside; dovetail view --png draws them.";
  CHECK(values["whole.gaps"] == "none");
  CHECK(values["cut.gaps"] == none);
  CHECK(values["under46.gaps"] == none);
}

TEST_CASE("what was left out is said on the page") {
  auto values = drawn(page_of(testing::cubes_in_pieces(2), 24 + 4 * 6));
  if (values.empty())
    return;
  CHECK(values["figures"].ends_with("2 pieces · only 6 of 12 elements inside, half of them the worst"));
  CHECK(values["under46.surface"] == "24");
  CHECK(values["whole.gaps"] == "none");
  CHECK(values["cut.gaps"] == "The section has gaps, as this page has 6 of 12 elements; dovetail view --png "
                              "--cut draws all.");
  CHECK(values["under44.gaps"] == "none"); // the least angle is 45 degrees
  CHECK(values["under46.gaps"] == "Elements under 45.0° are all here, and some of the others.");
}

TEST_CASE("where nothing is left out no gaps are told, and where sides are they are at once") {
  auto complete = drawn(page_of(testing::cubes_in_pieces(2)));
  auto holed = drawn(page_of(testing::cubes_in_pieces(2), 10));
  auto hollow = drawn(page_of(testing::cubes_in_pieces(2), 22));
  auto flat = drawn(page_of(testing::two_squares()));
  if (complete.empty() || holed.empty() || hollow.empty() || flat.empty())
    return;
  for (const std::string place : {"whole.gaps", "cut.gaps", "under46.gaps"}) {
    CHECK(complete[place] == "none");
    CHECK(flat[place] == "none");
    CHECK(
        hollow[place].starts_with("There are gaps between pieces, as this page has 2 of 4 triangles there."));
    CHECK(holed[place].starts_with("The surface has gaps, as this page has 10 of 20 triangles."));
  }
}

} // namespace
} // namespace dovetail::app
