/// @file
/// Places that the report of a run names, to be marked where its mesh is shown.
#pragma once

#include "raster_image.hpp"

#include "dovetail/core/vector.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::app {

/// A small interface angle, the thinnest wall, or a detail of the model that the mesh does not have.
struct view_mark {
  vec3 place;
  std::string label; ///< what marks of one colour have in common
  rgb colour;
  std::string text; ///< what the report says of the place
};

/// Nothing where no report was asked for.
struct view_marks {
  std::string report;         ///< the file; empty: none
  std::vector<view_mark> all; ///< what matters most first
  std::size_t elements = 0;   ///< of the run's mesh; 0: not known
};

/// The thinnest wall, then angles of the fine interfaces, then those of the coarse ones, then details left
/// out. None of a JSON object that lists no places. Throws `input_error` for a file that is not readable, is
/// no such object, or has something else where a report has these lists.
view_marks marks_of_report(const std::filesystem::path& report);

/// A label with its colour, and how many marks have it.
struct mark_label {
  std::string name;
  rgb colour;
  std::size_t count;
};
/// In the order of their first marks.
std::vector<mark_label> labels_of(const view_marks& marks);

/// How many marks there are of each label and colour, in words.
std::string text_of(const view_marks& marks);

/// How many are clearly outside of a box.
std::size_t marks_outside(const view_marks& marks, const box3& box);

} // namespace dovetail::app
