#include "dovetail/geometry/occt_model.hpp"
#include "dovetail/geometry/occt_repair.hpp"
#include "dovetail/geometry/occt_xcaf.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace dovetail;

namespace {

/// A folder for the files of one test case, removed at its end.
class scratch_folder {
public:
  explicit scratch_folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("dovetail_occt_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~scratch_folder() { std::filesystem::remove_all(path_); }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  std::filesystem::path operator/(const std::string& file) const { return path_ / file; }

private:
  std::filesystem::path path_;
};

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}
std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A box of width 50.8 with a name, its faces coloured and the first one named too.
void write_named_step(const std::filesystem::path& path, const char* unit) {
  const occt::silenced quiet;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(50.8, 50.8, 50.8).Shape();
  Handle(TDocStd_Document) document = occt::new_document();
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const Handle(XCAFDoc_LayerTool) layers = XCAFDoc_DocumentTool::LayerTool(document->Main());
  const TDF_Label label = shapes->AddShape(box, false);
  TDataStd_Name::Set(label, "block");
  const TopTools_IndexedMapOfShape faces = occt::sub_shapes(box, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TDF_Label face = shapes->AddSubShape(label, faces(i));
    colors->SetColor(face, Quantity_Color(1, 0, 0, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
    if (i == 1)
      TDataStd_Name::Set(face, "inlet");
    if (i == 2)
      layers->SetLayer(face, "walls");
  }
  STEPCAFControl_Writer writer;
  const occt::reader_setting in_unit("write.step.unit", unit);
  const occt::reader_setting face_names("write.stepcaf.subshapes.name", "On");
  writer.SetColorMode(true);
  writer.SetNameMode(true);
  writer.SetLayerMode(true);
  REQUIRE(writer.Perform(document, path.c_str()));
}

} // namespace

TEST_CASE("files that are missing, no file, empty or foreign are refused by name") {
  const scratch_folder folder("bad");
  CHECK_THROWS_WITH_AS(read_occt_model(folder / "none.step"),
                       doctest::Contains("none.step: there is no such file"), input_error);
  CHECK_THROWS_AS(read_occt_model(folder / ""), input_error);
  write_text(folder / "empty.step", "");
  CHECK_THROWS_WITH_AS(read_occt_model(folder / "empty.step"), doctest::Contains("empty"), input_error);
  write_text(folder / "foreign.step", "solid cube\nfacet normal 0 0 1\n");
  CHECK_THROWS_WITH_AS(read_occt_model(folder / "foreign.step"), doctest::Contains("neither STEP"),
                       input_error);
  CHECK_FALSE(is_occt_file(folder / "foreign.step"));
  CHECK_FALSE(is_occt_file(folder / "none.step"));
}

TEST_CASE("a BREP file cut anywhere is refused") {
  const scratch_folder folder("brep");
  BRepTools::Write(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), (folder / "whole.brep").c_str());
  const std::string whole = read_text(folder / "whole.brep");
  CHECK(read_occt_model(folder / "whole.brep").model.topology().faces.size() == 6);
  for (std::size_t part = 1; part < 40; ++part) {
    CAPTURE(part);
    write_text(folder / "cut.brep", whole.substr(0, whole.size() * part / 41));
    CHECK_THROWS_AS(read_occt_model(folder / "cut.brep"), error);
  }
}

TEST_CASE("a STEP file cut anywhere is refused") {
  const scratch_folder folder("step");
  write_named_step(folder / "whole.step", "MM");
  const std::string whole = read_text(folder / "whole.step");
  for (std::size_t part = 1; part < 8; ++part) {
    CAPTURE(part);
    write_text(folder / "cut.step", whole.substr(0, whole.size() * part / 8));
    CHECK_THROWS_AS(read_occt_model(folder / "cut.step"), input_error);
  }
  write_text(folder / "hollow.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n");
  CHECK_THROWS_AS(read_occt_model(folder / "hollow.step"), input_error);
}

TEST_CASE("the content decides the format, not the name") {
  const scratch_folder folder("content");
  BRepTools::Write(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), (folder / "box.step").c_str());
  CHECK(read_occt_model(folder / "box.step").model.topology().solids.size() == 1);
}

TEST_CASE("an IGES file of faces is sewn to a solid") {
  const scratch_folder folder("iges");
  {
    const occt::silenced quiet;
    IGESControl_Writer writer("MM", 0);
    writer.AddShape(BRepPrimAPI_MakeBox(1, 2, 3).Shape());
    writer.ComputeModel();
    REQUIRE(writer.Write((folder / "box.igs").c_str()));
  }
  CHECK(is_occt_file(folder / "box.igs"));
  const occt_read_result result = read_occt_model(folder / "box.igs");
  CHECK(occt::volume_of(result.model.shape()) == doctest::Approx(6));
  const std::string whole = read_text(folder / "box.igs");
  write_text(folder / "cut.igs", whole.substr(0, whole.size() / 2));
  CHECK_THROWS_AS(read_occt_model(folder / "cut.igs"), input_error);
}

TEST_CASE("STEP names, layers and colours become names and patches") {
  const scratch_folder folder("names");
  write_named_step(folder / "block.step", "MM");
  const occt_model model = read_occt_model(folder / "block.step").model;
  CHECK(model.topology().solids.at(0).name == "block");
  const auto& faces = model.topology().faces;
  REQUIRE(faces.size() == 6);
  CHECK(faces[0].name == "inlet");
  CHECK(faces[0].patch == "inlet");
  CHECK(faces[1].name == "");
  CHECK(faces[1].patch == "walls");
  CHECK(faces[2].patch == "color_FF0000");
}

TEST_CASE("coordinates come in millimetres, or in the file's unit when asked") {
  const scratch_folder folder("units");
  write_named_step(folder / "inch.step", "INCH");
  const auto width = [](const occt_model& model) { return model.bounds().upper.x - model.bounds().lower.x; };
  // The writer puts the numbers into the file as they are, so the block is 50.8 inches wide.
  const double millimetres = 50.8 * 25.4;
  CHECK(width(read_occt_model(folder / "inch.step").model) == doctest::Approx(millimetres));
  CHECK(width(read_occt_model(folder / "inch.step", {occt::length_unit::file}).model) ==
        doctest::Approx(50.8));
  CHECK(width(read_occt_model(folder / "inch.step").model) ==
        doctest::Approx(millimetres)); // nothing is left set
}
