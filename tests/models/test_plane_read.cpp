#include "dovetail/models/plane/read.hpp"
#include "files/scratch_folder.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

namespace {

plane_drawing svg(const std::string& content) {
  const testing::scratch_folder folder("plane_read");
  testing::write_content(folder / "a.svg", content);
  return read_svg(folder / "a.svg");
}

constexpr const char* square = R"(<path d="M0 0 H4 V4 H0 Z"/>)";

} // namespace

TEST_CASE("an SVG file's paths are read wherever they stand in it, and whatever else drawing programs add") {
  const auto drawing = svg("\xef\xbb\xbf<?xml version='1.0'?>\n"
                           "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\" [\n"
                           "  <!ENTITY ns_svg \"http://www.w3.org/2000/svg\">\n]>\n"
                           "<!-- <path d='M0 0 H9 V9 Z'/> -->\n"
                           "<svg xmlns='&ns_svg;' viewBox='0 0 4 4'>\n"
                           "<style><![CDATA[ g[id] > path { fill: #ccc } </path> ]]></style>\n"
                           "<g id='a'><g><path id = 'outer &amp; first'\n d='M0 0 H4 V4 H0 Z'/></g></g>\n"
                           "<g><path d=\"M1 1 H2 V2 Z M1 3 L3 3\" fill=\"none\"></path></g>\n"
                           "</svg>\n");
  REQUIRE(drawing.polygons.size() == 2);
  CHECK(drawing.polygons[0].name == "outer & first");
  CHECK(drawing.polygons[0].points == std::vector<vec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  CHECK(drawing.polygons[1].points.size() == 3);
  REQUIRE(drawing.lines.size() == 1);
  CHECK(drawing.lines[0].points == std::vector<vec2>{{1, 3}, {3, 3}});
}

TEST_CASE("what is not read is refused, and so is what is no SVG; the file is named") {
  const auto refusal = [](const std::string& content) {
    return testing::refusal_of<input_error>([&] { return svg(content); });
  };
  const auto says = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find("a.svg: ") != std::string::npos);
    CHECK(text.find(part) != std::string::npos);
  };
  for (const std::string shape : {"rect", "circle", "ellipse", "polygon", "polyline", "line", "use"})
    says(refusal("<svg>" + std::string(square) + "<g><" + shape + " x='1'/></g></svg>"),
         shape + " elements are not read");
  says(refusal("<svg><g transform='scale(2)'>" + std::string(square) + "</g></svg>"), "a transform");
  says(refusal("<svg><g>" + std::string(square) + "</svg>"), "line 1: </g> is expected");
  says(refusal("<svg>\n<path d=\"M0 0 H4"), "line 2: the file ends in an attribute");
  says(refusal("M0 0 H4 V4 H0 Z"), "this is not an XML file");
  says(refusal("<svg/>"), "there is no closed path");
  CHECK(refusal("<svg>" + std::string(square) + "</svg>") == "accepted");
}

TEST_CASE("points in a list") {
  const testing::scratch_folder folder("plane_read");
  testing::write_content(folder / "a.txt",
                         "# a triangle\npolygon outer\n0 0\n4 0 # right\n0 4\nline\n1 1\n2 1\n");
  const auto drawing = read_polygons(folder / "a.txt");
  REQUIRE(drawing.polygons.size() == 1);
  CHECK(drawing.polygons[0].name == "outer");
  CHECK(drawing.polygons[0].points == std::vector<vec2>{{0, 0}, {4, 0}, {0, 4}});
  CHECK(drawing.lines.size() == 1);
}
