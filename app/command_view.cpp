#include "any_mesh_file.hpp"
#include "colours.hpp"
#include "commands.hpp"
#include "failure.hpp"
#include "mesh_files.hpp"
#include "output.hpp"
#include "png.hpp"
#include "view_marks.hpp"
#include "view_memory.hpp"
#include "view_page.hpp"
#include "view_picture.hpp"
#include "view_pieces.hpp"
#include "view_scene.hpp"

#include "dovetail/core/output_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace dovetail::app {
namespace {

/// A whole text as a finite number.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size() ||
      !std::isfinite(static_cast<double>(number)))
    return std::nullopt;
  return number;
}

/// The numbers on both sides of a sign.
template <class Number>
std::optional<std::pair<Number, Number>> two_numbers(const std::string& text, char sign) {
  const std::size_t at = text.find(sign);
  if (at == std::string::npos)
    return std::nullopt;
  const auto first = number_of<Number>(std::string_view(text).substr(0, at));
  const auto second = number_of<Number>(std::string_view(text).substr(at + 1));
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

/// Azimuth 0 is the front, where y is smallest; it grows to the right, where x is largest.
vec3 direction_of(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e)};
}

/// Nothing for the default one, which depends on the mesh.
std::optional<vec3> asked_direction(const std::string& view) {
  constexpr std::pair<std::string_view, vec3> named[] = {{"front", {0, -1, 0}}, {"back", {0, 1, 0}},
                                                         {"left", {-1, 0, 0}},  {"right", {1, 0, 0}},
                                                         {"top", {0, 0, 1}},    {"bottom", {0, 0, -1}}};
  if (view == "default")
    return std::nullopt;
  for (const auto& [name, direction] : named)
    if (name == view)
      return direction;
  const auto angles = two_numbers<double>(view, ',');
  if (!angles)
    throw command_line_error("--view " + view +
                             ": give front, back, left, right, top, bottom, or azimuth,elevation in degrees");
  return direction_of(angles->first, angles->second);
}

std::pair<int, int> asked_size(const std::string& size) {
  constexpr int most = 16384;
  const auto pixels = two_numbers<int>(size, 'x');
  if (!pixels || pixels->first < 1 || pixels->second < 1 || pixels->first > most || pixels->second > most)
    throw command_line_error("--size " + size + ": give WxH, each from 1 to " + std::to_string(most));
  return *pixels;
}

view_colours asked_colours(const std::string& name) {
  return name == "piece"      ? view_colours::piece
         : name == "material" ? view_colours::material
         : name == "angle"    ? view_colours::angle
                              : view_colours::group;
}

/// A section: its axis, or that of the view, and the place on it; without one the middle.
struct asked_cut {
  std::optional<vec3> axis;
  std::optional<double> place;
};

std::optional<asked_cut> asked_section(const std::string& cut) {
  if (cut.empty())
    return std::nullopt;
  const std::size_t sign = cut.find('=');
  const std::string axis = cut.substr(0, sign);
  asked_cut asked;
  if (sign != std::string::npos)
    asked.place = number_of<double>(std::string_view(cut).substr(sign + 1));
  const bool known = axis == "x" || axis == "y" || axis == "z" || axis == "view";
  if (!known || (sign != std::string::npos && !asked.place))
    throw command_line_error("--cut " + cut +
                             ": give x, y, z or view, or one of them and its place, as x=1.5");
  if (axis != "view")
    asked.axis = vec3{axis == "x" ? 1.0 : 0.0, axis == "y" ? 1.0 : 0.0, axis == "z" ? 1.0 : 0.0};
  return asked;
}

/// The lowest and the highest place that a section along an axis can have, with pieces apart.
std::pair<double, double> range_along(vec3 axis, const box3& box, double explode) {
  const vec3 half = 0.5 * (1 + explode) * (box.upper - box.lower);
  const double reach = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
  const double middle = dot(axis, box.center());
  return {middle - reach, middle + reach};
}

/// The plane, with its normal to the viewer.
view_plane plane_of(const asked_cut& cut, const view_scene& scene, vec3 towards) {
  const vec3 axis = cut.axis.value_or(normalized(towards));
  const double place = cut.place.value_or(dot(axis, scene.box.center()));
  return dot(axis, towards) < 0 ? view_plane{-axis, -place} : view_plane{axis, place};
}

/// What the command line says of a picture, checked before the mesh is read.
struct asked_picture {
  std::optional<vec3> direction;
  std::pair<int, int> size;
  std::optional<asked_cut> cut;

  explicit asked_picture(const view_options& options)
      : direction(asked_direction(options.view)), size(asked_size(options.size)),
        cut(asked_section(options.cut)) {}

  view_wishes wishes(const view_scene& scene, const view_options& options, const view_marks& marks) const {
    view_wishes wishes{.towards = direction.value_or(direction_to_viewer(scene.box)),
                       .width = size.first,
                       .height = size.second,
                       .colours = asked_colours(options.colour),
                       .under = options.under,
                       .explode = options.explode,
                       .edges = !options.no_edges,
                       .marks = marks};
    if (cut)
      wishes.cut = plane_of(*cut, scene, wishes.towards);
    return wishes;
  }
  /// Where the section meets nothing.
  void warn_of_section(const view_options& options, const view_wishes& wishes, const box3& box) const {
    if (!cut || !cut->place)
      return;
    const auto [lowest, highest] =
        range_along(cut->axis.value_or(normalized(wishes.towards)), box, options.explode);
    if (*cut->place < lowest || *cut->place > highest)
      std::fprintf(stderr, "warning: %s: the section %s is outside of the mesh (%s from %g to %g)\n",
                   options.png.c_str(), options.cut.c_str(),
                   options.cut.substr(0, options.cut.find('=')).c_str(), lowest, highest);
  }
};

/// So no mesh, which may be one of several in a folder, is overwritten. Throws `command_line_error`.
void check_is_html(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  if (extension != ".html" && extension != ".htm")
    throw command_line_error("--out " + file.string() +
                             ": pages are written to files with the extension .html or .htm");
}

/// Throws `command_line_error`.
void check_is_png(const std::filesystem::path& file) {
  if (extension_of(file) != ".png")
    throw command_line_error("--png " + file.string() +
                             ": pictures are written to files with the extension .png");
}

std::string megabytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", 1e-6 * static_cast<double>(bytes));
  return text;
}

void write_page(const view_scene& scene, const view_options& options, const view_marks& marks) {
  const view_part part = part_that_fits(scene, options.most);
  const std::string page =
      page_of_view(scene, part, std::filesystem::path(options.mesh).lexically_normal().string(), marks);
  output_file file(options.out);
  file.text(page);
  file.commit();
  const std::string left_out = text_of_left_out(scene, part);
  std::printf("%s: %s%s\n", options.out.c_str(), megabytes(page.size()).c_str(),
              left_out.empty() ? "" : (", " + left_out + "; see --most").c_str());
}

/// \param count of the elements under the angle that is asked for
void write_picture(const view_scene& scene, view_wishes wishes, const view_options& options,
                   std::size_t count) {
  if (wishes.under)
    wishes.under = angle_of_worst(scene, *wishes.under);
  const auto png = encode_png(picture_of_view(scene, wishes));
  output_file file(options.png);
  file.bytes(png.data(), png.size());
  file.commit();
  std::printf("%s: %d x %d pixels\n", options.png.c_str(), wishes.width, wishes.height);
  if (shows_angles(wishes))
    std::printf("colours of least angles: %s\n", text_of_angle_colours().c_str());
  if (!options.under)
    return;
  std::printf("%zu of %zu elements have an angle under %g degrees\n", count, scene.count, *options.under);
  if (const std::size_t drawn = elements_under(scene, *wishes.under); drawn < count)
    std::fprintf(stderr, "warning: %s: only the worst %zu of them are drawn\n", options.png.c_str(), drawn);
  if (count == 0)
    std::fprintf(stderr, "warning: %s: no element has so small an angle; the picture is the outline alone\n",
                 options.png.c_str());
}

/// How marks look, or why there are none.
const char* look_of_marks(const view_options& options, const view_marks& marks) {
  if (marks.all.empty())
    return "";
  if (!options.png.empty() && options.explode > 0)
    return "; none are in the picture, since its pieces are apart";
  return "; those behind the surface are hollow";
}

void say_marks(const view_marks& marks, const view_options& options, const view_scene& scene) {
  if (marks.report.empty())
    return;
  std::printf("%s: %s%s\n", marks.report.c_str(), text_of(marks).c_str(), look_of_marks(options, marks));
  if (marks.elements > 0 && marks.elements != scene.count)
    std::fprintf(stderr,
                 "warning: %s: it is of a mesh of %zu elements, and this one has %zu; is this the report of "
                 "its run?\n",
                 marks.report.c_str(), marks.elements, scene.count);
  if (const std::size_t outside = marks_outside(marks, scene.box); outside > 0)
    std::fprintf(stderr,
                 "warning: %s: %zu of %zu marks are outside of the mesh; is this the report of its run?\n",
                 marks.report.c_str(), outside, marks.all.size());
}

/// Of a section, which has few and would have gaps.
constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max() / 4;

/// A mesh as far as it is in memory.
class shown_mesh {
public:
  /// \param most triangles of a page, or 0
  shown_mesh(const std::filesystem::path& file, std::int64_t most) : pieces_(view_pieces::read(file, most)) {
    if (!pieces_) {
      std::error_code failure;
      const std::uintmax_t bytes = std::filesystem::file_size(file, failure);
      if (const std::string much = failure ? "" : text_of_memory(bytes, memory_of_machine()); !much.empty())
        std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), much.c_str());
      io::loaded_mesh loaded = read_any_mesh(file, io::element_order::any);
      warn_of_part(loaded, file);
      whole_ = scene_of(std::move(loaded));
    } else if (!pieces_->elsewhere.empty()) {
      std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), pieces_->elsewhere.c_str());
    }
    if (scene().count == 0)
      throw input_error(file.string() + ": has no tetrahedra or triangles to show");
    if (scene().second_order)
      std::printf("%s: elements of second order are drawn by their corners, with straight edges\n",
                  file.c_str());
  }
  const view_scene& scene() const { return pieces_ ? pieces_->scene : whole_; }

  /// Sees to it that the elements in a picture are there, whatever a page has of them.
  /// \return how many have an angle under that of the picture, if there is one
  std::size_t prepare(const view_wishes& wishes) {
    std::size_t wanted = 0;
    if (pieces_ && (wishes.cut || wishes.under))
      wanted = pieces_->take_elements(
          wishes.explode, wishes.under ? most_elements_drawn : no_limit,
          [&](float angle, const std::array<vec3, 4>& corners) { return is_drawn(wishes, angle, corners); });
    return pieces_ || !wishes.under ? wanted : elements_under(whole_, *wishes.under);
  }

private:
  std::optional<view_pieces> pieces_;
  view_scene whole_; ///< where it is not read in pieces
};

} // namespace

int run_view(const view_options& options) {
  if (options.out.empty() && options.png.empty())
    throw command_line_error("view: give -o with an HTML file, or --png with a picture, or both");
  const asked_picture asked(options);
  if (!options.out.empty())
    check_is_html(options.out);
  if (!options.png.empty())
    check_is_png(options.png);
  if (!options.out.empty() && !has_three_js())
    throw usage_error(options.out +
                      ": pages need three.js, which was not there when this dovetail was built; "
                      "install libjs-three and build it again, or use --png");
  for (const std::string& file : {options.out, options.png})
    if (!file.empty())
      check_can_create(file);
  const view_marks marks = options.report.empty() ? view_marks{} : marks_of_report(options.report);
  const std::filesystem::path mesh = find_any_mesh(options.mesh);
  shown_mesh shown(mesh, options.out.empty() ? 0 : options.most);
  if (!options.out.empty())
    write_page(shown.scene(), options, marks);
  if (!options.png.empty()) {
    const view_wishes wishes = asked.wishes(shown.scene(), options, marks);
    asked.warn_of_section(options, wishes, shown.scene().box);
    const std::size_t count = shown.prepare(wishes);
    write_picture(shown.scene(), wishes, options, count);
  }
  say_marks(marks, options, shown.scene());
  return exit_ok;
}

} // namespace dovetail::app
