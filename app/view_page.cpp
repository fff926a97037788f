#include "view_page.hpp"

#include "base64.hpp"
#include "colours.hpp"
#include "json_text.hpp"
#include "markup.hpp"
#include "three_js_pieces.hpp"    // three.min.js, or nothing
#include "view_model_script.hpp"  // view_model.js
#include "view_page_template.hpp" // view_page.html as a string

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace dovetail::app {
namespace {

template <class T>
std::string base64_of(const std::vector<T>& items) {
  const auto bytes = std::as_bytes(std::span(items));
  return base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::string text_of_colour(rgb colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned part : {colour.red, colour.green, colour.blue})
    text += {digits[part >> 4U], digits[part & 15U]};
  return text;
}

nlohmann::json json_of(const view_labels& labels) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t k = 0; k < labels.names.size(); ++k)
    list.push_back(
        {{"name", labels.names[k]}, {"colour", text_of_colour(colour_of_number(static_cast<local_id>(k)))}});
  return list;
}

nlohmann::json json_of(vec3 p) {
  return {p.x, p.y, p.z};
}

nlohmann::json json_of(std::optional<float> number) {
  return number ? nlohmann::json(*number) : nlohmann::json();
}

nlohmann::json angle_colours() {
  nlohmann::json list = nlohmann::json::array();
  for (int degrees = 0; degrees <= 70; ++degrees)
    list.push_back(text_of_colour(colour_of_angle(degrees)));
  return list;
}

/// The points that a part of a scene uses, numbered in the order of their use.
class used_points {
public:
  explicit used_points(const view_scene& scene) : scene_(scene), numbers_(scene.points.size(), no_id) {}

  template <std::size_t N>
  void add(std::vector<std::uint32_t>& to, const std::array<local_id, N>& vertices) {
    for (const local_id v : vertices) {
      local_id& number = numbers_[v];
      if (number == no_id) {
        number = static_cast<local_id>(places_.size() / 3);
        const vec3 p = scene_.points[v] - scene_.box.center();
        for (int k = 0; k < 3; ++k)
          places_.push_back(static_cast<float>(p[k]));
      }
      to.push_back(static_cast<std::uint32_t>(number));
    }
  }
  /// Relative to the middle of the mesh.
  const std::vector<float>& places() const { return places_; }

private:
  const view_scene& scene_;
  std::vector<local_id> numbers_;
  std::vector<float> places_;
};

/// What the page knows of triangles or elements besides their vertices.
struct page_items {
  std::vector<std::uint32_t> vertices, pieces, materials;
  std::vector<std::uint16_t> angles; ///< in hundredths of a degree, rounded down

  void add(const view_scene& scene, local_id element) {
    const auto e = static_cast<std::size_t>(element);
    pieces.push_back(static_cast<std::uint32_t>(scene.pieces.of[e]));
    materials.push_back(static_cast<std::uint32_t>(scene.materials.of[e]));
    angles.push_back(static_cast<std::uint16_t>(100 * scene.angles[e]));
  }
};

/// Numbers of two bytes where they fit.
nlohmann::json packed(const std::vector<std::uint32_t>& items) {
  if (std::any_of(items.begin(), items.end(), [](std::uint32_t item) { return item > 0xffff; }))
    return {{"bytes", 4}, {"data", base64_of(items)}};
  return {{"bytes", 2}, {"data", base64_of(std::vector<std::uint16_t>(items.begin(), items.end()))}};
}

nlohmann::json json_of(const page_items& items) {
  return {{"vertices", packed(items.vertices)},
          {"pieces", packed(items.pieces)},
          {"materials", packed(items.materials)},
          {"angles", {{"bytes", 2}, {"data", base64_of(items.angles)}}}};
}

nlohmann::json arrays_of(const view_scene& scene, const view_part& part) {
  used_points points(scene);
  page_items triangles, elements, outline;
  std::vector<std::uint32_t> groups;
  for (const local_id t : part.triangles) {
    const auto at = static_cast<std::size_t>(t);
    points.add(triangles.vertices, scene.triangles[at]);
    triangles.add(scene, scene.element_of[at]);
    groups.push_back(static_cast<std::uint32_t>(scene.groups.of[at]));
  }
  for (const local_id e : part.elements) {
    points.add(elements.vertices, scene.tetrahedra[e]);
    elements.add(scene, e);
  }
  for (const auto& edge : scene.outline) {
    points.add(outline.vertices, edge.ends);
    outline.pieces.push_back(static_cast<std::uint32_t>(edge.piece));
  }
  nlohmann::json all{
      {"triangles", json_of(triangles)}, {"elements", json_of(elements)}, {"outline", json_of(outline)}};
  all["triangles"]["groups"] = packed(groups);
  all["triangles"]["outer"] = std::count_if(part.triangles.begin(), part.triangles.end(), [&](local_id t) {
    return static_cast<std::size_t>(t) < scene.outer;
  });
  all["points"] = base64_of(points.places());
  return all;
}

nlohmann::json json_of(const view_marks& marks, vec3 middle) {
  const auto labels = labels_of(marks);
  nlohmann::json data{
      {"report", marks.report}, {"labels", nlohmann::json::array()}, {"all", nlohmann::json::array()}};
  for (const mark_label& label : labels)
    data["labels"].push_back({{"name", label.name}, {"colour", text_of_colour(label.colour)}});
  for (const view_mark& mark : marks.all) {
    const auto label =
        std::find_if(labels.begin(), labels.end(), [&](const auto& each) { return each.name == mark.label; });
    data["all"].push_back(
        {{"at", json_of(mark.place - middle)}, {"label", label - labels.begin()}, {"text", mark.text}});
  }
  return data;
}

std::string three_js() {
  std::string text;
  for (const char* piece : three_js_pieces)
    text += piece;
  return text;
}

} // namespace

bool has_three_js() {
  return !three_js().empty();
}

std::string page_of_view(const view_scene& scene, const view_part& part, const std::string& name,
                         const view_marks& marks) {
  nlohmann::json centres = nlohmann::json::array();
  for (const vec3 centre : scene.centres)
    centres.push_back(json_of(centre - scene.box.center()));
  const nlohmann::json data{{"name", name},
                            {"dimension", scene.dimension},
                            {"secondOrder", scene.second_order},
                            {"count", scene.count},
                            {"outer", scene.outer},
                            {"inner", scene.triangles.size() - scene.outer},
                            {"complete", json_of(complete_under(scene, part))},
                            {"vertices", scene.vertices},
                            {"least", scene.least_angle},
                            {"lower", json_of(scene.box.lower)},
                            {"upper", json_of(scene.box.upper)},
                            {"leftOut", text_of_left_out(scene, part)},
                            {"groups", json_of(scene.groups)},
                            {"pieces", json_of(scene.pieces)},
                            {"materials", json_of(scene.materials)},
                            {"centres", std::move(centres)},
                            {"angleColours", angle_colours()},
                            {"marks", json_of(marks, scene.box.center())},
                            {"arrays", arrays_of(scene, part)}};
  // Names may be any bytes; a "<" in one must not end the script.
  std::string text = text_of_json(data, -1, true);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  std::string page = view_page_template;
  put_in(page, "SCRIPT_OF_THE_MODEL", view_model_script);
  put_in(page, "TEXT_OF_THREE_JS", three_js());
  put_in(page, "DATA_OF_THE_MESH", text); // the last, since a name in it may be any text
  return page;
}

} // namespace dovetail::app
