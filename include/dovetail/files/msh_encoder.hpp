/// @file
/// The number encoding of MSH 4.1: the same records as text or as raw bytes.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::io {

/// Writes the sections of an MSH 4.1 file. In binary files `line` does nothing, in text files it ends a
/// record.
class msh_encoder {
public:
  msh_encoder(output_file& file, bool binary) : file_(file), binary_(binary) {}

  /// The beginning of a file.
  void format() {
    file_.text("$MeshFormat\n");
    file_.text(binary_ ? "4.1 1 8\n" : "4.1 0 8\n");
    if (binary_) {
      file_.value<std::int32_t>(1); // tells readers the byte order
      file_.text("\n");
    }
    file_.text("$EndMeshFormat\n");
  }

  void integer(std::int64_t value) { write(static_cast<std::int32_t>(value)); } ///< a number of four bytes
  void count(std::uint64_t value) { write(value); }       ///< a number of eight bytes, not negative
  void real(double value) { write(value); }               ///< a floating-point number
  void point(vec3 p) { real(p.x), real(p.y), real(p.z); } ///< three floating-point numbers
  void line() {
    if (!binary_)
      file_.text("\n");
  }
  void begin(std::string_view section) { file_.text("$"), file_.text(section), file_.text("\n"); }
  void end(std::string_view section) {
    file_.text(binary_ ? "\n$End" : "$End"), file_.text(section), file_.text("\n");
  }

private:
  template <class T>
  void write(T value) {
    if (binary_)
      return file_.value(value);
    file_.number(value);
    file_.text(" ");
  }

  output_file& file_;
  bool binary_;
};

/// Gmsh's numbers of element types: `point`, `line`, `triangle`, `tetrahedron`, and of second order
/// `quadratic_line`, `quadratic_triangle`, `quadratic_tetrahedron`.
enum class msh_type {
  line = 1,
  triangle = 2,
  tetrahedron = 4,
  quadratic_line = 8,
  quadratic_triangle = 9,
  quadratic_tetrahedron = 11,
  point = 15
};

/// The type of simplices of a dimension from 0 to 3.
inline int msh_type_of(int dimension, bool quadratic) {
  constexpr std::array<msh_type, 4> linear{msh_type::point, msh_type::line, msh_type::triangle,
                                           msh_type::tetrahedron};
  constexpr std::array<msh_type, 4> second{msh_type::point, msh_type::quadratic_line,
                                           msh_type::quadratic_triangle, msh_type::quadratic_tetrahedron};
  return static_cast<int>((quadratic ? second : linear)[dimension]);
}

/// A physical group: what Gmsh calls a named set of entities of one dimension.
struct physical_name {
  int dimension;    ///< of the entities
  local_id tag;     ///< its number
  std::string name; ///< as Gmsh shows it
};

/// The one section that is text in binary files too. Quotes and line breaks in names are replaced, and names
/// cut at 120 bytes, because Gmsh's reader allows no more.
inline void write_physical_names(output_file& file, const std::vector<physical_name>& names) {
  if (names.empty())
    return;
  file.text("$PhysicalNames\n");
  file.number(names.size());
  file.text("\n");
  for (const auto& [dimension, tag, name] : names) {
    auto clean = name.substr(0, 120);
    std::replace(clean.begin(), clean.end(), '"', '\'');
    std::replace_if(
        clean.begin(), clean.end(), [](unsigned char c) { return c < ' '; }, ' ');
    file.number(dimension);
    file.text(" ");
    file.number(tag);
    file.text(" \"" + clean + "\"\n");
  }
  file.text("$EndPhysicalNames\n");
}

} // namespace dovetail::io
