/// @file
/// Sizing fields from JSON files (docs/sizing.md describes the format). An adapter for nlohmann-json.
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/files/json_tree.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/background.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::sizing {

/// What a sizing file needs to know besides its own text.
struct json_options {
  /// The box of the model: where a gradation limit is precomputed.
  box3 domain = {};
  /// Reads the field of a "background" member: a mesh file (relative to the sizing file's folder) and the
  /// name of the point array. Without it such a member is refused: this header reads no meshes.
  std::function<background_field(const std::filesystem::path& file, const std::string& array)>
      load_background = {};
  /// Makes the field of a "curvature", "proximity" or "automatic" member, which come from the model, such as
  /// `[&](const automatic_options& o) { return automatic_size(model, o); }`. Without it such members are
  /// refused.
  std::function<erased_sizing(const automatic_options&)> size_from_model = {};
  /// Look at the text alone, which says what is wrong with it before any model or mesh is read. The field is
  /// of no use then.
  bool only_check = false;
};

namespace detail {

/// Turns one parsed document into a field; every message starts with file and line.
class json_field_reader {
public:
  json_field_reader(std::string file, std::filesystem::path folder, const json_options& options)
      : file_(std::move(file)), folder_(std::move(folder)), options_(options) {}

private:
  [[noreturn]] void fail(const json_value& v, const std::string& what) const {
    throw sizing_error(file_ + ":" + std::to_string(v.line) + ": " + what);
  }

  /// Runs a construction and puts file and line before the message of what it throws.
  template <class Make>
  auto at_line(const json_value& v, Make&& make) const {
    try {
      return make();
    } catch (const sizing_error& e) {
      fail(v, e.what());
    }
  }

  void require_keys(const json_value& v, std::initializer_list<std::string_view> known,
                    const std::string& what) const {
    if (v.type != json_value::kind::object)
      fail(v, what + " must be an object { ... }");
    for (std::size_t i = 0; i < v.keys.size(); ++i)
      if (std::find(known.begin(), known.end(), v.keys[i]) == known.end()) {
        std::string list;
        for (const std::string_view k : known)
          list += (list.empty() ? "" : ", ") + std::string(k);
        fail(v.items[i], "unknown key \"" + v.keys[i] + "\" in " + what + "; known are " + list);
      }
  }

  const json_value& required(const json_value& v, const std::string& key) const {
    if (const json_value* member = v.find(key))
      return *member;
    fail(v, "the key \"" + key + "\" is missing");
  }
  double number(const json_value& v, const std::string& key) const {
    const json_value& member = required(v, key);
    if (member.type != json_value::kind::number || !std::isfinite(member.number))
      fail(member, "\"" + key + "\" must be a finite number");
    return member.number;
  }
  double positive(const json_value& v, const std::string& key) const {
    const double value = number(v, key);
    if (!(value > 0))
      fail(*v.find(key), "\"" + key + "\" is " + number_text(value) + "; give a positive number");
    return value;
  }
  /// Around a circle, or across a wall.
  double checked_count(const json_value& v, const std::string& key) const {
    if (v.type != json_value::kind::number || !(v.number > 0 && v.number <= 1000))
      fail(v, "\"" + key + "\" is " + number_text(v.number) + "; give a number of elements, at most 1000");
    return v.number;
  }
  std::string text(const json_value& v, const std::string& key) const {
    const json_value& member = required(v, key);
    if (member.type != json_value::kind::text)
      fail(member, "\"" + key + "\" must be a text in quotes");
    return member.text;
  }
  const json_value& array(const json_value& v, const std::string& key) const {
    const json_value& member = required(v, key);
    if (member.type != json_value::kind::array)
      fail(member, "\"" + key + "\" must be a list [ ... ]");
    return member;
  }
  vec3 point(const json_value& member, const std::string& key) const {
    const bool three_numbers = member.type == json_value::kind::array && member.items.size() == 3 &&
                               std::all_of(member.items.begin(), member.items.end(), [](const json_value& i) {
                                 return i.type == json_value::kind::number;
                               });
    if (!three_numbers)
      fail(member, "\"" + key + "\" must be a point [x, y, z]");
    return {member.items[0].number, member.items[1].number, member.items[2].number};
  }

  void append_sources(const json_value& v, double slope, std::vector<erased_sizing>& parts,
                      bool& exact) const {
    if (!v.find("sources")) {
      if (v.find("size"))
        parts.emplace_back(uniform_size(positive(v, "size")));
      return;
    }
    if (!v.find("size"))
      fail(*v.find("sources"), "\"sources\" need \"size\" beside them, the size away from all sources");
    std::vector<grid_source> sources;
    for (const json_value& item : array(v, "sources").items)
      sources.push_back(source(item));
    for (const grid_source& s : sources)
      exact = exact && is_even(s);
    const double ambient = positive(v, "size");
    parts.emplace_back(at_line(*v.find("sources"), [&] {
      return source_field(ambient, std::move(sources),
                          exact ? slope : std::numeric_limits<double>::infinity());
    }));
  }

  static bool is_even(const grid_source& s) {
    bool even = true;
    for (std::size_t k = 1; k <= static_cast<std::size_t>(s.dimension); ++k)
      even = even && s.spacing[k] == s.spacing[0] && s.inner_radius[k] == s.inner_radius[0] &&
             s.outer_radius[k] == s.outer_radius[0];
    return even;
  }

  grid_source source(const json_value& v) const {
    if (v.type != json_value::kind::object)
      fail(v, "a source must be an object { ... }");
    const std::string type = text(v, "type");
    grid_source s;
    if (type == "point") {
      require_keys(v, {"type", "name", "at", "inner_radius", "outer_radius", "spacing", "growth"},
                   "a point source");
      s.dimension = 0;
      s.corners[0] = point(required(v, "at"), "at");
    } else if (type == "line") {
      require_keys(v, {"type", "name", "from", "to", "inner_radius", "outer_radius", "spacing", "growth"},
                   "a line source");
      s.dimension = 1;
      s.corners[0] = point(required(v, "from"), "from");
      s.corners[1] = point(required(v, "to"), "to");
    } else if (type == "triangle") {
      require_keys(v, {"type", "name", "corners", "inner_radius", "outer_radius", "spacing", "growth"},
                   "a triangle source");
      s.dimension = 2;
      const json_value& corners = array(v, "corners");
      if (corners.items.size() != 3)
        fail(corners, "\"corners\" must be three points");
      for (std::size_t k = 0; k < 3; ++k)
        s.corners[k] = point(corners.items[k], "corners");
    } else {
      fail(*v.find("type"), "unknown source type \"" + type + "\"; known are point, line, triangle");
    }
    per_corner(v, "inner_radius", s.dimension, true, s.inner_radius);
    per_corner(v, "outer_radius", s.dimension, false, s.outer_radius);
    per_corner(v, "spacing", s.dimension, false, s.spacing);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(s.dimension); ++k)
      if (s.outer_radius[k] < s.inner_radius[k])
        fail(*v.find("outer_radius"), "\"outer_radius\" is smaller than \"inner_radius\"; exchange them");
    if (v.find("name"))
      s.name = text(v, "name");
    if (v.find("growth")) {
      const std::string growth = text(v, "growth");
      if (growth != "to_ambient" && growth != "doubling")
        fail(*v.find("growth"), "unknown growth \"" + growth + "\"; known are to_ambient, doubling");
      s.growth = growth == "doubling" ? source_growth::doubling : source_growth::to_ambient;
    }
    return s;
  }

  /// One number for all corners, or a list of one per corner.
  void per_corner(const json_value& v, const std::string& key, int dimension, bool zero_allowed,
                  std::array<double, 3>& values) const {
    const json_value& member = required(v, key);
    const std::size_t corners = static_cast<std::size_t>(dimension) + 1;
    std::vector<double> given;
    if (member.type == json_value::kind::number)
      given.assign(3, member.number);
    else if (member.type == json_value::kind::array && dimension > 0 && member.items.size() == corners)
      for (const json_value& item : member.items)
        given.push_back(item.type == json_value::kind::number ? item.number : std::nan(""));
    else
      fail(member, "\"" + key + "\" must be a number" +
                       (dimension > 0 ? ", or a list of one number per corner" : ""));
    for (std::size_t k = 0; k < 3; ++k) {
      values[k] = given[std::min(k, given.size() - 1)];
      if (!std::isfinite(values[k]) || values[k] < 0 || (values[k] == 0 && !zero_allowed))
        fail(member, "\"" + key + "\" is " + number_text(values[k]) + "; give a " +
                         (zero_allowed ? "number that is not negative" : "positive number"));
    }
  }

  void append_background(const json_value& v, std::vector<erased_sizing>& parts, bool& exact) const {
    const json_value* member = v.find("background");
    if (!member)
      return;
    require_keys(*member, {"file", "array"}, "a background mesh");
    const auto path = folder_ / text(*member, "file");
    const std::string name = member->find("array") ? text(*member, "array") : "size";
    exact = false;
    if (options_.only_check) {
      parts.emplace_back(uniform_size(1));
      return;
    }
    if (!options_.load_background)
      fail(*member, "a background mesh cannot be read here; give the sizes another way");
    parts.emplace_back(at_line(*member, [&] { return options_.load_background(path, name); }));
  }

  /// Members that ask for sizes from the model; the largest of these is "size", if that is given.
  void append_from_model(const json_value& v, std::vector<erased_sizing>& parts, bool& exact) const {
    for (const char* key : {"curvature", "proximity", "automatic"}) {
      const json_value* member = v.find(key);
      if (!member || (member->type == json_value::kind::boolean && !member->boolean))
        continue;
      automatic_options options = options_from_model(*member, key);
      if (options.range.largest == 0 && v.find("size"))
        options.range.largest = positive(v, "size");
      exact = false;
      if (options_.only_check) {
        parts.emplace_back(uniform_size(1));
        continue;
      }
      if (!options_.size_from_model)
        fail(*member, std::string("\"") + key +
                          "\" needs a model, and there is none here; give the sizes another way");
      parts.emplace_back(at_line(*member, [&] { return options_.size_from_model(options); }));
    }
  }

  /// true, the number of elements, or an object with all options.
  automatic_options options_from_model(const json_value& v, const std::string& key) const {
    automatic_options options;
    const bool curvature = key != "proximity";
    const bool proximity = key != "curvature";
    if (!curvature)
      options.elements_per_circle = 0;
    if (!proximity)
      options.elements_across = 0;
    if (v.type == json_value::kind::boolean)
      return options;
    if (v.type == json_value::kind::number && curvature != proximity) {
      (curvature ? options.elements_per_circle : options.elements_across) = checked_count(v, key);
      return options;
    }
    require_keys(v, {"elements_per_circle", "elements_across", "where", "smallest", "largest", "growth"},
                 "\"" + key + "\"");
    if (const json_value* given = v.find("elements_per_circle"))
      options.elements_per_circle = checked_count(*given, "elements_per_circle");
    if (const json_value* given = v.find("elements_across"))
      options.elements_across = checked_count(*given, "elements_across");
    if (v.find("where")) {
      const std::string where = text(v, "where");
      if (where != "inside" && where != "outside" && where != "both")
        fail(*v.find("where"), "unknown place \"" + where + "\"; known are inside, outside, both");
      options.inside = where != "outside";
      options.outside = where != "inside";
    }
    if (v.find("smallest"))
      options.range.smallest = positive(v, "smallest");
    if (v.find("largest"))
      options.range.largest = positive(v, "largest");
    if (v.find("growth"))
      options.range.growth = positive(v, "growth");
    return options;
  }

  void append_minimum(const json_value& v, std::vector<erased_sizing>& parts, bool& exact) const {
    if (!v.find("minimum"))
      return;
    const json_value& list = array(v, "minimum");
    if (list.items.empty())
      fail(list, "\"minimum\" is empty; give at least one field");
    exact = false;
    for (const json_value& item : list.items)
      parts.push_back(field(item));
  }

  erased_sizing clamped(const json_value& v, const erased_sizing& field) const {
    const double lower = v.find("smallest") ? positive(v, "smallest") : std::numeric_limits<double>::min();
    const double upper = v.find("largest") ? positive(v, "largest") : std::numeric_limits<double>::max();
    return at_line(v.find("smallest") ? *v.find("smallest") : *v.find("largest"),
                   [&] { return bounded(field, lower, upper); });
  }

  /// true, a slope, or { "slope": s, "relative_error": e }; false and null switch it off.
  std::optional<gradation_options> gradation_of(const json_value& v) const {
    const json_value* member = v.find("gradation");
    if (!member || member->type == json_value::kind::null ||
        (member->type == json_value::kind::boolean && !member->boolean))
      return std::nullopt;
    gradation_options options;
    if (member->type == json_value::kind::number) {
      options.slope = positive(v, "gradation");
    } else if (member->type == json_value::kind::object) {
      require_keys(*member, {"slope", "relative_error"}, "a gradation");
      if (member->find("slope"))
        options.slope = positive(*member, "slope");
      if (member->find("relative_error"))
        options.relative_error = positive(*member, "relative_error");
      if (constexpr double least = 0.001; options.relative_error < least) // cells without end
        fail(*member, "\"relative_error\" is " + number_text(options.relative_error) + "; give at least " +
                          number_text(least));
    } else if (member->type != json_value::kind::boolean) {
      fail(*member, "\"gradation\" must be a slope, true, false or an object { ... }");
    }
    return options;
  }

public:
  /// Exact limits are handed down to where they are exact: `slope` is the limit asked for above this value.
  erased_sizing field(const json_value& v) const {
    require_keys(v,
                 {"size", "sources", "background", "curvature", "proximity", "automatic", "minimum", "scale",
                  "smallest", "largest", "gradation"},
                 "a sizing field");
    const double scale = v.find("scale") ? positive(v, "scale") : 1.0;
    const auto gradation = gradation_of(v);
    std::vector<erased_sizing> parts;
    bool exactly_limited = true;
    const double slope = gradation ? gradation->slope / scale : std::numeric_limits<double>::infinity();
    append_sources(v, slope, parts, exactly_limited);
    append_background(v, parts, exactly_limited);
    append_from_model(v, parts, exactly_limited);
    append_minimum(v, parts, exactly_limited);
    if (parts.empty())
      fail(v, "a sizing field needs \"size\", \"background\", \"curvature\", \"proximity\", \"automatic\" or "
              "\"minimum\"");
    erased_sizing result = parts.size() == 1 ? parts.front() : erased_sizing(minimum_of(std::move(parts)));
    if (scale != 1)
      result = scaled(result, scale);
    if (v.find("smallest") || v.find("largest"))
      result = clamped(v, result);
    if (gradation && !exactly_limited && !options_.only_check)
      result =
          at_line(*v.find("gradation"), [&] { return graded_size(result, options_.domain, *gradation); });
    return result;
  }

private:
  std::string file_;
  std::filesystem::path folder_;
  const json_options& options_;
};

} // namespace detail

/// The field that JSON text describes; `file` names it in messages, paths in it are relative to `folder`.
/// Throws `input_error` when the text is not JSON and `sizing_error` for a wrong key or value, naming file,
/// line and key.
/// Linear in the text, and what the fields take that it describes.
/// \param text JSON
/// \param file what messages call it
/// \param options what the field may refer to, such as a model
/// \param folder where files that it names are
inline erased_sizing parse_sizing(const std::string& text, const std::string& file,
                                  const json_options& options = {},
                                  const std::filesystem::path& folder = {}) {
  const json_value root = parse_json(text, file);
  return detail::json_field_reader(file, folder, options).field(root);
}

/// What is in a JSON file; throws `input_error` when it cannot be read.
/// Linear.
/// \param file a file of any size
inline std::string read_sizing_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw input_error(file.string() + ": the sizing file cannot be read; check its name and permissions");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The field that a JSON file describes. As `parse_sizing` and `read_sizing_text`.
/// Throws `input_error` for a file that cannot be read, and what `parse_sizing` throws. Linear in the file.
/// \param file a JSON file; files that it names are looked for beside it
/// \param options what the field may refer to, such as a model
inline erased_sizing read_sizing(const std::filesystem::path& file, const json_options& options = {}) {
  return parse_sizing(read_sizing_text(file), file.string(), options, file.parent_path());
}

} // namespace dovetail::sizing
