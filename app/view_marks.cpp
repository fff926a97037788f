#include "view_marks.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

namespace dovetail::app {
namespace {

struct named_colour {
  std::string_view what; ///< a cause, or a wall
  std::string_view name;
  rgb colour;
};
constexpr named_colour colours[] = {{"forced", "red", {220, 40, 40}},
                                    {"refused", "orange", {245, 150, 20}},
                                    {"remeshing", "blue", {30, 100, 225}},
                                    {"thinnest wall", "violet", {150, 50, 200}},
                                    {"detail left out", "green", {20, 150, 70}}};
constexpr named_colour other_colour{"", "grey", {120, 120, 120}};
constexpr const char* remedy = "; give the JSON file that 'dovetail mesh --report' has written";
// Begin the labels of angles, before their cause; those of the coarse skeleton are of no interface of the
// mesh.
constexpr std::string_view of_angle = "interface angle, ";
constexpr std::string_view of_coarse = "coarse interface angle, ";

const named_colour& colour_of(std::string_view what) {
  const auto* found = std::find_if(std::begin(colours), std::end(colours),
                                   [&](const auto& each) { return each.what == what; });
  return found == std::end(colours) ? other_colour : *found;
}

rgb paler(rgb colour) {
  const auto half = [](std::uint8_t part) { return static_cast<std::uint8_t>((part + 255) / 2); };
  return {half(colour.red), half(colour.green), half(colour.blue)};
}

/// Takes a report apart; each step knows how it is reached, for messages.
class mark_reader {
public:
  explicit mark_reader(std::string file) : file_(std::move(file)) {}

  view_marks read(const nlohmann::json& document) {
    if (!document.is_object())
      fail("it is no JSON object");
    if (const nlohmann::json* poor = object_at(document, "", "poor_elements"))
      if (!poor->value("thinnest_wall", nlohmann::json()).is_null()) // as where no wall is thin
        add_wall(*object_at(*poor, "poor_elements", "thinnest_wall"), "poor_elements/thinnest_wall");
    if (const nlohmann::json* interfaces = object_at(document, "", "interfaces")) {
      add_angles(*interfaces, "interfaces", false);
      if (const nlohmann::json* coarse = object_at(*interfaces, "interfaces", "coarse"))
        add_angles(*coarse, "interfaces/coarse", true);
    }
    add_suppressed(document);
    const auto elements = document.find("elements");
    return {file_, std::move(marks_),
            elements != document.end() && elements->is_number_unsigned() ? elements->get<std::size_t>() : 0};
  }

  [[noreturn]] void fail(const std::string& what) const { throw input_error(file_ + ": " + what + remedy); }

private:
  /// Null where there is none, since other reports lack them.
  const nlohmann::json* object_at(const nlohmann::json& of, const std::string& path,
                                  const std::string& name) const {
    const auto found = of.find(name);
    if (found == of.end())
      return nullptr;
    if (!found->is_object())
      fail((path.empty() ? "" : path + "/") + name + " is no object");
    return &*found;
  }
  double number(const nlohmann::json& value, const std::string& path) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(path + " is no finite number");
    return value.get<double>();
  }
  const std::string& text(const nlohmann::json& value, const std::string& path) const {
    if (!value.is_string())
      fail(path + " is no text");
    return value.get_ref<const std::string&>();
  }
  const nlohmann::json& member(const nlohmann::json& of, const std::string& path, const char* name) const {
    const auto found = of.find(name);
    if (found == of.end())
      fail(path + " has no \"" + name + "\"");
    return *found;
  }
  vec3 place(const nlohmann::json& of, const std::string& path) const {
    const nlohmann::json& at = member(of, path, "at");
    if (!at.is_array() || at.size() != 3)
      fail(path + "/at is no list of three numbers");
    return {number(at[0], path + "/at/0"), number(at[1], path + "/at/1"), number(at[2], path + "/at/2")};
  }

  void add_wall(const nlohmann::json& wall, const std::string& path) {
    const auto& [label, name, colour] = colour_of("thinnest wall");
    const double thickness = number(member(wall, path, "thickness"), path + "/thickness");
    marks_.push_back({place(wall, path), std::string(label), colour,
                      "thinnest wall, thickness " + number_text(thickness, 4)});
  }
  void add_suppressed(const nlohmann::json& document) {
    const auto listed = document.find("suppressed");
    if (listed == document.end())
      return;
    if (!listed->is_array())
      fail("suppressed is no list");
    const auto& [label, name, colour] = colour_of("detail left out");
    for (std::size_t k = 0; k < listed->size(); ++k) {
      const nlohmann::json& each = (*listed)[k];
      const std::string path = "suppressed/" + std::to_string(k);
      if (!each.is_object())
        fail(path + " is no object");
      const double length = number(member(each, path, "length"), path + "/length");
      const double entity = number(member(each, path, "entity"), path + "/entity");
      const std::string what = text(member(each, path, "what"), path + "/what");
      const bool is_there = what == name_of(suppressed_detail::kind::joined_face);
      marks_.push_back({place(each, path), std::string(label), colour,
                        what + " " + number_text(entity, 12) + (is_there ? "; " : ", left out; ") +
                            number_text(length, 4)});
    }
  }
  void add_angles(const nlohmann::json& interfaces, const std::string& path, bool coarse) {
    const auto listed = interfaces.find("below_threshold");
    if (listed == interfaces.end())
      return;
    const std::string list = path + "/below_threshold";
    if (!listed->is_array())
      fail(list + " is no list");
    for (std::size_t k = 0; k < listed->size(); ++k)
      add_angle((*listed)[k], list + "/" + std::to_string(k), coarse);
  }
  void add_angle(const nlohmann::json& angle, const std::string& path, bool coarse) {
    if (!angle.is_object())
      fail(path + " is no object");
    const std::string& cause = text(member(angle, path, "cause"), path + "/cause");
    const double degrees = number(member(angle, path, "angle_deg"), path + "/angle_deg");
    const std::string label = std::string(coarse ? of_coarse : of_angle) + cause;
    std::string said =
        label + ": " + number_text(degrees, 4) + "° of a " + text(member(angle, path, "of"), path + "/of");
    const nlohmann::json& cad = member(angle, path, "cad");
    if (!cad.is_array())
      fail(path + "/cad is no list");
    for (std::size_t k = 0; k < cad.size(); ++k)
      said += (k == 0 ? "; CAD: " : ", ") + text(cad[k], path + "/cad/" + std::to_string(k));
    const rgb colour = colour_of(cause).colour;
    marks_.push_back({place(angle, path), label, coarse ? paler(colour) : colour, std::move(said)});
  }

  std::string file_;
  std::vector<view_mark> marks_;
};

/// Of a label, as a word.
std::string name_of_colour(const std::string& label) {
  if (label.starts_with(of_coarse))
    return "pale " + std::string(colour_of(label.substr(of_coarse.size())).name);
  return std::string(colour_of(label.starts_with(of_angle) ? label.substr(of_angle.size()) : label).name);
}

} // namespace

view_marks marks_of_report(const std::filesystem::path& report) {
  mark_reader reader(report.string());
  std::string text;
  try {
    text = read_file(report);
  } catch (const input_error& problem) {
    throw input_error(std::string(problem.what()) + remedy);
  }
  nlohmann::json document;
  try {
    document = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& problem) {
    reader.fail("it is not valid JSON: " + std::string(problem.what()));
  }
  return reader.read(document);
}

std::vector<mark_label> labels_of(const view_marks& marks) {
  std::vector<mark_label> labels;
  for (const view_mark& mark : marks.all) {
    const auto known = std::find_if(labels.begin(), labels.end(),
                                    [&](const mark_label& label) { return label.name == mark.label; });
    if (known != labels.end())
      ++known->count;
    else
      labels.push_back({mark.label, mark.colour, 1});
  }
  return labels;
}

std::string text_of(const view_marks& marks) {
  if (marks.all.empty())
    return "no marks, since it lists no small interface angles and no thin wall";
  std::string text = std::to_string(marks.all.size()) + (marks.all.size() == 1 ? " mark" : " marks");
  const char* before = ": ";
  for (const auto& [name, colour, count] : labels_of(marks)) {
    text += before + std::to_string(count) + " x " + name + " (" + name_of_colour(name) + ")";
    before = "; ";
  }
  return text;
}

std::size_t marks_outside(const view_marks& marks, const box3& box) {
  const double room = 0.01 * box.diagonal();
  return static_cast<std::size_t>(
      std::count_if(marks.all.begin(), marks.all.end(), [&](const view_mark& mark) {
        for (int k = 0; k < 3; ++k)
          if (mark.place[k] < box.lower[k] - room || mark.place[k] > box.upper[k] + room)
            return true;
        return false;
      }));
}

} // namespace dovetail::app
