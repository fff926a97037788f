/// @file
/// Reads STEP, IGES and BREP files into a shape with names. The content decides the format, not the
/// extension.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/geometry/occt_shape.hpp"
#include "dovetail/geometry/occt_xcaf.hpp"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace dovetail::occt {

enum class file_format { unknown, step, iges, brep, binary_brep };

/// Recognises a format by the first lines of a file.
inline file_format format_of_content(std::string_view head) {
  const auto begins_with_blanks_skipped = [&](std::string_view word) {
    const auto first = std::find_if(head.begin(), head.end(),
                                    [](char c) { return !std::isspace(static_cast<unsigned char>(c)); });
    return head.substr(static_cast<std::size_t>(first - head.begin())).starts_with(word);
  };
  if (begins_with_blanks_skipped("ISO-10303-21"))
    return file_format::step;
  if (head.find("Open CASCADE Topology V") != std::string_view::npos)
    return file_format::binary_brep;
  if (begins_with_blanks_skipped("DBRep_DrawableShape") || begins_with_blanks_skipped("CASCADE Topology V"))
    return file_format::brep;
  // The first card of an IGES file is its start section: an S in column 73.
  const std::string_view first_card = head.substr(0, head.find('\n'));
  if (first_card.size() >= 73 && (first_card[72] == 'S' || first_card[72] == 'C'))
    return file_format::iges;
  return file_format::unknown;
}

/// Whether a BREP text has all the shapes it announces. OCCT's own reader loops for ever on some truncated
/// files, so it must never see one. The last section, "TShapes n", lists n shapes that each end with an
/// asterisk; then follows the reference to the whole shape.
inline bool is_whole_brep(std::string_view content) {
  const std::size_t section = content.rfind("TShapes ");
  if (section == std::string_view::npos)
    return false;
  std::size_t announced = 0;
  std::size_t at = section + 8;
  for (; at < content.size() && content[at] >= '0' && content[at] <= '9' && announced < content.size(); ++at)
    announced = 10 * announced + static_cast<std::size_t>(content[at] - '0');
  const std::string_view shapes = content.substr(at);
  const std::size_t last = shapes.rfind('*');
  return announced > 0 && last != std::string_view::npos &&
         static_cast<std::size_t>(std::count(shapes.begin(), shapes.end(), '*')) == announced &&
         shapes.find_first_of("+-ie", last) != std::string_view::npos;
}

/// Throws `input_error` when the mark that ends every complete file of its format is absent.
inline void require_complete(const std::string& source, file_format format, std::string_view content) {
  const std::string_view tail = content.substr(content.size() - std::min<std::size_t>(content.size(), 4096));
  if (format == file_format::step && tail.find("END-ISO-10303-21") == std::string_view::npos)
    throw input_error(source + ": the STEP file is truncated (it does not end with END-ISO-10303-21)");
  if (format == file_format::brep && !is_whole_brep(content))
    throw input_error(source + ": the BREP file is truncated or damaged (shapes it announces are missing)");
  if (format == file_format::iges) {
    std::string_view last = tail;
    while (!last.empty() && std::isspace(static_cast<unsigned char>(last.back())))
      last.remove_suffix(1);
    const std::size_t start = last.rfind('\n');
    const std::string_view card = start == std::string_view::npos ? last : last.substr(start + 1);
    if (card.size() < 73 || card[72] != 'T')
      throw input_error(source + ": the IGES file is truncated (it has no terminate section)");
  }
}

inline TopoDS_Shape read_brep(const std::string& source, const std::string& content, file_format format) {
  std::istringstream stream(content);
  TopoDS_Shape shape;
  try {
    if (format == file_format::binary_brep)
      BinTools::Read(shape, stream);
    else
      BRepTools::Read(shape, stream, BRep_Builder());
  } catch (const Standard_Failure&) {
    throw input_error(source + ": the BREP file is truncated or damaged");
  }
  if (shape.IsNull() || stream.fail())
    throw input_error(source + ": the BREP file is truncated or damaged");
  return shape;
}

/// Reads a file. `unit` says in which length unit the coordinates are wanted (STEP and IGES only; BREP files
/// have none). Throws `input_error` for a missing, empty, truncated, foreign or unreadable file.
inline attributed_shape read_shape(const std::filesystem::path& path, length_unit unit) {
  const silenced quiet;
  const std::string source = path.string();
  const std::string content = read_file(path);
  const file_format format = format_of_content(std::string_view(content).substr(0, 4096));
  if (format == file_format::unknown)
    throw input_error(source + ": neither STEP, IGES nor BREP; convert the model to one of these");
  require_complete(source, format, content);

  attributed_shape result;
  if (format == file_format::step)
    result = read_step(path, unit);
  else if (format == file_format::iges)
    result = read_iges(path, unit);
  else
    result.shape = read_brep(source, content, format);
  result.source = path.filename().string();
  if (result.shape.IsNull())
    throw input_error(source + ": the file contains no shape");
  return result;
}

} // namespace dovetail::occt
