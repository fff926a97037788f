/// @file
/// A B-rep shape of Open CASCADE (OCCT) together with the names its file gives to solids and faces.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/vector.hpp"

#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <NCollection_DataMap.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>
#include <utility>

namespace dovetail::occt {

/// A point of OCCT as a point of ours.
inline vec3 to_vec3(const gp_XYZ& p) {
  return {p.X(), p.Y(), p.Z()};
}
inline vec3 to_vec3(const gp_Pnt& p) {
  return to_vec3(p.XYZ());
}
/// A point of ours as a point of OCCT.
inline gp_Pnt to_pnt(vec3 p) {
  return {p.x, p.y, p.z};
}

/// "(x, y, z)" with six digits, for error messages.
inline std::string to_text(vec3 p) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
  return text.data();
}

/// A length with six digits.
/// \param value a number
inline std::string to_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// Calls `action`; a failure inside OCCT becomes a `geometry_error` that starts with `what`.
template <class Action>
auto guarded(const std::string& what, Action&& action) -> decltype(action()) {
  try {
    return action();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    const char* message = failure.GetMessageString();
    throw geometry_error(what + ": Open CASCADE failed" +
                         (message && *message ? " (" + std::string(message) + ")" : ""));
  }
}

/// Keeps OCCT's readers and healers from writing to the terminal while it lives, by its messenger or past it.
class silenced {
public:
  silenced() : printers_(Message::DefaultMessenger()->Printers()), output_(std::cout.rdbuf(nullptr)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~silenced() {
    std::cout.rdbuf(output_);
    Message::DefaultMessenger()->ChangePrinters() = printers_;
  }
  silenced(const silenced&) = delete;
  silenced& operator=(const silenced&) = delete;

private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* output_;
};

/// What a file says about one solid or face.
struct attributes {
  std::string name;  ///< the entity's own name
  std::string layer; ///< its layer or group
  std::string color; ///< "color_RRGGBB"

  bool empty() const { return name.empty() && layer.empty() && color.empty(); }
  /// The group: name, else layer, else colour.
  const std::string& group() const { return !name.empty() ? name : !layer.empty() ? layer : color; }
};

/// Attributes by shape, whatever its place in an assembly or orientation: all instances of a part share them.
class attribute_map {
public:
  /// The attributes of a shape, or null.
  const attributes* find(const TopoDS_Shape& shape) const { return map_.Seek(key(shape)); }
  attributes& operator[](const TopoDS_Shape& shape) {
    const TopoDS_Shape k = key(shape);
    if (!map_.IsBound(k))
      map_.Bind(k, attributes{});
    return map_.ChangeFind(k);
  }
  /// Gives `heir`, made from `original` by an operation, the attributes of `original`.
  void inherit(const TopoDS_Shape& heir, const TopoDS_Shape& original) {
    if (heir.IsPartner(original))
      return;
    if (const attributes* found = find(original)) {
      const attributes copy = *found;
      (*this)[heir] = copy;
    }
  }
  bool empty() const { return map_.IsEmpty(); }

private:
  static TopoDS_Shape key(const TopoDS_Shape& shape) { return shape.Located(TopLoc_Location()); }
  NCollection_DataMap<TopoDS_Shape, attributes, TopTools_ShapeMapHasher> map_;
};

/// A shape with attributes; `source` is the file or model name used in messages.
struct attributed_shape {
  TopoDS_Shape shape;  ///< of any kind
  attribute_map names; ///< what its file says of solids and faces
  std::string source = "shape";
  std::string file_unit; ///< length unit the file was written in, as it calls it; empty when it does not say
};

/// All different sub-shapes of one kind, in the order in which OCCT's explorer meets them.
inline TopTools_IndexedMapOfShape sub_shapes(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  if (!shape.IsNull())
    TopExp::MapShapes(shape, kind, map);
  return map;
}

/// Diagonal of a box around the shape; the box may be a little too large.
inline double size_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

/// Carries the attributes of the faces and solids of `before` over to what `image_of` maps each of them to.
template <class ImageOf>
void inherit_attributes(attribute_map& names, const TopoDS_Shape& before, ImageOf&& image_of) {
  for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE}) {
    const TopTools_IndexedMapOfShape originals = sub_shapes(before, kind);
    for (int i = 1; i <= originals.Extent(); ++i) {
      if (!names.find(originals(i)))
        continue;
      const TopTools_IndexedMapOfShape heirs = sub_shapes(image_of(originals(i)), kind);
      for (int k = 1; k <= heirs.Extent(); ++k)
        names.inherit(heirs(k), originals(i));
    }
  }
}

} // namespace dovetail::occt
