/// @file
/// STEP and IGES through OCCT's extended data exchange (XCAF), which keeps names, colours and layers.
#pragma once

#include "dovetail/models/occt/options.hpp"
#include "dovetail/models/occt/shape.hpp"

#include <BRep_Builder.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDF_Label.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::occt {

/// The name OCCT's readers use for a unit name found in a file, or null when it is unknown.
inline const char* interface_unit(std::string name) {
  for (char& c : name)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  struct known_unit {
    std::string_view begins;
    const char* symbol;
  };
  static constexpr std::array<known_unit, 15> known{{{"MILLIM", "MM"},
                                                     {"MM", "MM"},
                                                     {"CENTIM", "CM"},
                                                     {"CM", "CM"},
                                                     {"KILOM", "KM"},
                                                     {"KM", "KM"},
                                                     {"MICROM", "UM"},
                                                     {"UM", "UM"},
                                                     {"MICROI", "UIN"},
                                                     {"MIL", "MIL"},
                                                     {"METRE", "M"},
                                                     {"METER", "M"},
                                                     {"INCH", "INCH"},
                                                     {"FOOT", "FT"},
                                                     {"MI", "MI"}}};
  for (const auto& unit : known)
    if (name.starts_with(unit.begins))
      return unit.symbol;
  return name == "M" ? "M" : name == "IN" ? "INCH" : name == "FT" || name == "FEET" ? "FT" : nullptr;
}

/// Sets a text parameter of OCCT's readers while it lives. OCCT keeps these parameters in process-wide
/// tables.
class reader_setting {
public:
  reader_setting(const char* key, const char* value) : key_(key), old_(Interface_Static::CVal(key)) {
    Interface_Static::SetCVal(key, value);
  }
  ~reader_setting() { Interface_Static::SetCVal(key_, old_.c_str()); }
  reader_setting(const reader_setting&) = delete;
  reader_setting& operator=(const reader_setting&) = delete;

private:
  const char* key_;
  std::string old_;
};

/// The name of a label; empty where it is a mere stand-in for one.
inline std::string label_name(const TDF_Label& label) {
  Handle(TDataStd_Name) attribute;
  if (!label.FindAttribute(TDataStd_Name::GetID(), attribute))
    return {};
  std::string name = TCollection_AsciiString(attribute->Get()).ToCString();
  // Systems write these where they have no name; XCAF names unnamed labels by the kind of shape.
  static constexpr std::array<std::string_view, 8> placeholders{"NONE", "COMPOUND", "SOLID",     "SHELL",
                                                                "FACE", "ASSEMBLY", "COMPSOLID", "SHAPE"};
  for (const auto& word : placeholders)
    if (name == word)
      return {};
  return name;
}

/// The first layer of a label; empty where it has none.
inline std::string label_layer(const TDF_Label& label, const Handle(XCAFDoc_LayerTool) & tool) {
  Handle(TColStd_HSequenceOfExtendedString) layers;
  if (!tool->GetLayers(label, layers) || layers.IsNull() || layers->IsEmpty())
    return {};
  return TCollection_AsciiString(layers->First()).ToCString();
}

/// The colour of a label as text; empty where it has none.
inline std::string label_color(const TDF_Label& label, const Handle(XCAFDoc_ColorTool) & tool) {
  Quantity_Color color;
  if (!tool->GetColor(label, XCAFDoc_ColorSurf, color) && !tool->GetColor(label, XCAFDoc_ColorGen, color))
    return {};
  const auto level = [](float value) { return static_cast<int>(std::lround(255 * value)); };
  const NCollection_Vec3<float> srgb =
      Quantity_Color::Convert_LinearRGB_To_sRGB((NCollection_Vec3<float>)color);
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "color_%02X%02X%02X", level(srgb.x()), level(srgb.y()),
                level(srgb.z()));
  return text.data();
}

/// The shapes and attributes of all labels of a document, outer shapes first, so that inner ones override.
inline attribute_map document_attributes(const Handle(TDocStd_Document) & document) {
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const Handle(XCAFDoc_LayerTool) layers = XCAFDoc_DocumentTool::LayerTool(document->Main());

  std::vector<std::pair<TopoDS_Shape, attributes>> found;
  for (TDF_ChildIterator child(shapes->Label(), true); child.More(); child.Next()) {
    TopoDS_Shape shape;
    if (!XCAFDoc_ShapeTool::GetShape(child.Value(), shape) || shape.IsNull())
      continue;
    attributes item{label_name(child.Value()), label_layer(child.Value(), layers),
                    label_color(child.Value(), colors)};
    if (!item.empty())
      found.emplace_back(shape, std::move(item));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first.ShapeType() < b.first.ShapeType(); });

  attribute_map names;
  const auto assign = [&](const TopoDS_Shape& shape, const attributes& item, TopAbs_ShapeEnum kind,
                          bool with_name) {
    const TopTools_IndexedMapOfShape parts = sub_shapes(shape, kind);
    for (int i = 1; i <= parts.Extent(); ++i) {
      attributes& mine = names[parts(i)];
      if (with_name && !item.name.empty())
        mine.name = item.name;
      if (!item.layer.empty())
        mine.layer = item.layer;
      if (!item.color.empty())
        mine.color = item.color;
    }
  };
  for (const auto& [shape, item] : found) {
    assign(shape, item, TopAbs_SOLID, true);
    // A part's name is not the name of its faces.
    assign(shape, item, TopAbs_FACE, shape.ShapeType() == TopAbs_FACE);
  }
  return names;
}

/// All free shapes of a document: the shape itself when there is one, else a compound.
inline TopoDS_Shape document_shape(const Handle(TDocStd_Document) & document) {
  TDF_LabelSequence labels;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(labels);
  if (labels.IsEmpty())
    return {};
  if (labels.Length() == 1)
    return XCAFDoc_ShapeTool::GetShape(labels.First());
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (int i = 1; i <= labels.Length(); ++i)
    builder.Add(all, XCAFDoc_ShapeTool::GetShape(labels.Value(i)));
  return all;
}

/// An empty document.
inline Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  XCAFDoc_DocumentTool::Set(document->Main());
  return document;
}

/// The part of reading that STEP and IGES share: `Reader` is OCCT's XCAF reader of the format.
template <class Reader>
attributed_shape transfer(Reader& reader, const std::string& source) {
  Handle(TDocStd_Document) document = new_document();
  attributed_shape result;
  if (!reader.Transfer(document))
    throw input_error(source + ": the file contains no shape that can be read");
  result.shape = document_shape(document);
  result.names = document_attributes(document);
  return result;
}

/// What some editors put before a text. OCCT's reader of STEP refuses it.
inline constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

/// Reads a STEP file of the given content; throws `input_error`, or OCCT's own exceptions.
inline attributed_shape read_step(const std::filesystem::path& path, length_unit unit,
                                  const std::string& content) {
  STEPCAFControl_Reader reader; // registers the reader's parameters too
  // Open CASCADE 7.8 and later look at this when the file is read, earlier ones when it is transferred.
  const reader_setting sub_shape_names("read.stepcaf.subshapes.name", "On");
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(true);
  std::istringstream behind_mark;
  if (content.starts_with(utf8_mark))
    behind_mark.str(content.substr(utf8_mark.size()));
  const bool is_marked = !behind_mark.str().empty();
  if ((is_marked ? reader.ChangeReader().ReadStream(path.c_str(), behind_mark)
                 : reader.ReadFile(path.c_str())) != IFSelect_RetDone)
    throw input_error(path.string() + ": the STEP file is truncated or damaged; export it again");
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
  const std::string file_unit = lengths.IsEmpty() ? "" : lengths.First().ToCString();
  const char* symbol = unit == length_unit::file ? interface_unit(file_unit) : nullptr;
  const reader_setting length("xstep.cascade.unit", symbol ? symbol : "MM");
  attributed_shape result = transfer(reader, path.string());
  result.file_unit = file_unit;
  return result;
}

/// Reads an IGES file; throws `input_error`, or OCCT's own exceptions.
inline attributed_shape read_iges(const std::filesystem::path& path, length_unit unit) {
  IGESCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(true);
  reader.SetReadVisible(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    throw input_error(path.string() + ": the IGES file is truncated or damaged; export it again");
  const auto model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  const Handle(TCollection_HAsciiString) unit_name = model->GlobalSection().UnitName();
  const std::string file_unit = unit_name.IsNull() ? "" : unit_name->ToCString();
  const char* symbol = unit == length_unit::file ? interface_unit(file_unit) : nullptr;
  const reader_setting length("xstep.cascade.unit", symbol ? symbol : "MM");
  attributed_shape result = transfer(reader, path.string());
  result.file_unit = file_unit;
  return result;
}

} // namespace dovetail::occt
