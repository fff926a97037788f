/// @file
/// Reads STEP, IGES and BREP files into a shape with names. The content decides the format, not the
/// extension; whether a file is whole is found out by reading it.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/models/occt/memory.hpp"
#include "dovetail/models/occt/options.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt/xcaf.hpp"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <ios>
#include <new>
#include <sstream>
#include <string>
#include <string_view>

#include <sys/resource.h>

namespace dovetail::occt {

/// What kind of file it is: `step`, `iges`, `brep` (as text), `binary_brep`, or `unknown`.
enum class file_format { unknown, step, iges, brep, binary_brep };

/// As much of a file as `format_of_content` should see: long comments may stand first.
inline constexpr std::size_t head_size = std::size_t{64} << 10;

/// What is left of a text behind the mark of UTF-8, white space and comments of STEP.
inline std::string_view behind_comments(std::string_view text) {
  if (text.starts_with(utf8_mark))
    text.remove_prefix(utf8_mark.size());
  for (;;) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
      text.remove_prefix(1);
    if (!text.starts_with("/*"))
      return text;
    const std::size_t end = text.find("*/", 2);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
  }
}

/// Recognises a format by the beginning of a file.
inline file_format format_of_content(std::string_view head) {
  const auto is_card_of = [](std::string_view line, char section) {
    return line.size() >= 73 && line[72] == section;
  };
  const std::string_view text = behind_comments(head);
  constexpr std::string_view step_mark = "ISO-10303-21";
  if (std::equal(step_mark.begin(), step_mark.end(), text.begin(),
                 text.begin() + static_cast<std::ptrdiff_t>(std::min(step_mark.size(), text.size())),
                 [](char a, char b) { return a == std::toupper(static_cast<unsigned char>(b)); }))
    return file_format::step;
  if (head.find("Open CASCADE Topology V") != std::string_view::npos)
    return file_format::binary_brep;
  if (text.starts_with("DBRep_DrawableShape") || text.starts_with("CASCADE Topology V"))
    return file_format::brep;
  // The first card of an IGES file is its start section: an S in column 73.
  const std::string_view first_card = head.substr(0, head.find('\n'));
  return is_card_of(first_card, 'S') || is_card_of(first_card, 'C') ? file_format::iges
                                                                    : file_format::unknown;
}

/// Throws `input_error` when an IGES file has no terminate section. OCCT reads what is there of such a file,
/// in silence; of the other formats it refuses what is cut off.
inline void require_terminated(const std::string& source, std::string_view content) {
  for (std::size_t end = content.size(); end > 0;) {
    const std::size_t before = content.rfind('\n', end - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    if (end - begin >= 73 && content[begin + 72] == 'T')
      return;
    end = begin == 0 ? 0 : begin - 1;
  }
  throw input_error(source + ": the IGES file is truncated (it has no terminate section); export it again");
}

/// OCCT's readers of BREP look at the state of their stream here and there only, and loop for ever behind
/// the end of some files: the stream throws instead.
inline TopoDS_Shape read_brep(const std::string& source, const std::string& content, file_format format) {
  std::istringstream stream(content);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  TopoDS_Shape shape;
  try {
    if (format == file_format::binary_brep)
      BinTools::Read(shape, stream);
    else
      BRepTools::Read(shape, stream, BRep_Builder());
  } catch (const std::ios_base::failure&) {
    shape.Nullify();
  }
  if (shape.IsNull())
    throw input_error(source + ": the BREP file is truncated or damaged; export it again");
  return shape;
}

/// What OCCT makes of a file, here and now.
inline attributed_shape read_directly(const std::filesystem::path& path, length_unit unit, file_format format,
                                      const std::string& content) {
  const memory_watch memory;
  try {
    if (format == file_format::step)
      return read_step(path, unit, content);
    if (format == file_format::iges) {
      require_terminated(path.string(), content);
      return read_iges(path, unit);
    }
    attributed_shape result;
    result.shape = read_brep(path.string(), content, format);
    return result;
  } catch (const input_error&) {
    memory.throw_if_short();
    throw;
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    memory.throw_if_short();
    throw input_error(path.string() + ": the file is truncated or damaged (" + failure.GetMessageString() +
                      "); export it again");
  }
}

/// Seconds of processor time that reading a file may take: OCCT needs about one per megabyte.
inline double reading_budget(std::size_t bytes) {
  return 30 + 20e-6 * static_cast<double>(bytes);
}

/// Lets an executor's worker read first, which may crash or not come back. It says no more than how that
/// ended: OCCT's own binary format does not give back the same shape to the last bit.
inline void require_readable(const std::string& source, const any_executor& executor,
                             const std::function<void()>& read, double seconds, const progress& on_progress) {
  constexpr double slowest_share = 5;  // of a processor that others use too
  constexpr double clocks_agree = 0.9; // that of the limit counts in ticks
  const auto outcomes = executor.run(
      1,
      [&](std::size_t) {
        if (!executor.shares_process()) {
          const auto whole_seconds = static_cast<rlim_t>(std::ceil(seconds));
          const rlimit limit{whole_seconds, whole_seconds};
          ::setrlimit(RLIMIT_CPU, &limit);
        }
        read();
        return byte_buffer();
      },
      {.limit_seconds = slowest_share * seconds, .on_progress = on_progress, .stage = "reading"});
  const task_outcome& outcome = outcomes.front();
  if (outcome.ok)
    return;
  if (outcome.failure == detail::out_of_memory)
    throw std::bad_alloc();
  const bool had_its_time = outcome.seconds >= clocks_agree * seconds; // the limit ends it by signal 9 too
  if (!outcome.timed_out && !had_its_time && detail::is_for_want_of_room(outcome.failure))
    throw error(source + ": Open CASCADE could not read it: " + outcome.failure);
  if (!outcome.crashed && !outcome.timed_out)
    throw input_error(outcome.failure);
  const std::string what =
      outcome.timed_out ? "is not done reading it after " + to_text(outcome.seconds) + " s"
      : had_its_time    ? "is not done reading it after " + to_text(seconds) + " s of processor time"
                        : "crashed while reading it (" + outcome.failure + ")";
  throw input_error(source + ": Open CASCADE " + what +
                    "; the file is damaged, export it again, best as STEP");
}

/// Reads a file. Throws `input_error` for a missing, empty, truncated, foreign or unreadable file,
/// `cancelled` when `options.on_progress` asks to stop.
inline attributed_shape read_shape(const std::filesystem::path& path, const occt_read_options& options) {
  const silenced quiet;
  const std::string source = path.string();
  const std::string content = read_file(path);
  const file_format format = format_of_content(std::string_view(content).substr(0, head_size));
  if (format == file_format::unknown)
    throw input_error(source + ": neither STEP, IGES nor BREP; convert the model to one of these, or to "
                               "triangles in a file that ends in .stl, .obj, .off or .ply");
  const auto read = [&] { return read_directly(path, options.unit, format, content); };
  if (options.first_reader)
    require_readable(source, *options.first_reader, read,
                     options.most_seconds > 0 ? options.most_seconds : reading_budget(content.size()),
                     options.on_progress);
  attributed_shape result = read();
  result.source = path.filename().string();
  if (result.shape.IsNull())
    throw input_error(source + ": the file contains no shape");
  return result;
}

} // namespace dovetail::occt
