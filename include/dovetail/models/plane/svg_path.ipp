/// @file
/// What `svg_path.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/models/plane/svg_path.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace dovetail {

namespace detail {

/// Reads one path's data and collects its subpaths. The y axis is that of the data.
class svg_path_reader {
public:
  svg_path_reader(std::string_view data, const svg_path_options& options, plane_drawing& drawing)
      : data_(data), options_(options), drawing_(drawing) {}

  void read() {
    tolerance_ = options_.chord_error > 0 ? options_.chord_error : 1e-4 * extent_of_numbers();
    at_ = 0;
    for (skip_separators(); at_ < data_.size(); skip_separators()) {
      const char c = data_[at_];
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
        command_ = c;
        ++at_;
      } else if (command_ == 0 || command_ == 'Z' || command_ == 'z') {
        fail("a number where a command is expected");
      }
      run();
    }
    finish(false);
  }

private:
  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(name() + ": " + what + " at character " + std::to_string(at_) + " of its data");
  }
  std::string name() const { return "path" + (options_.name.empty() ? "" : " '" + options_.name + "'"); }

  void skip_separators() {
    while (at_ < data_.size() &&
           (std::isspace(static_cast<unsigned char>(data_[at_])) != 0 || data_[at_] == ','))
      ++at_;
  }
  double number() {
    skip_separators();
    const std::string text(data_.substr(at_, 64));
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = end != text.c_str() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 ||
                                                   text[0] == '-' || text[0] == '+' || text[0] == '.');
    if (!is_number || !std::isfinite(value))
      fail("a number is expected");
    at_ += static_cast<std::size_t>(end - text.c_str());
    return value;
  }
  bool flag() { // of an arc: one digit, which the next number may follow without a separator
    skip_separators();
    if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1'))
      fail("a flag, 0 or 1, is expected");
    return data_[at_++] == '1';
  }
  bool relative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }
  vec2 point() {
    const double x = number(), y = number();
    return relative() ? now_ + vec2{x, y} : vec2{x, y};
  }

  /// The largest absolute number: close enough to the size of the drawing.
  double extent_of_numbers() {
    double largest = 0;
    for (at_ = 0; at_ < data_.size();) {
      if (std::isdigit(static_cast<unsigned char>(data_[at_])) == 0) {
        ++at_;
        continue;
      }
      largest = std::max(largest, std::abs(number()));
    }
    return largest > 0 ? largest : 1;
  }

  void run() {
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    if (kind != 'M' && kind != 'Z' && path_.points.empty())
      start(now_);
    switch (kind) {
    case 'M':
      finish(false);
      start(point());
      command_ = relative() ? 'l' : 'L'; // further points are lines
      break;
    case 'L':
      go_to(point());
      break;
    case 'H': {
      const double x = number();
      go_to({relative() ? now_.x + x : x, now_.y});
      break;
    }
    case 'V': {
      const double y = number();
      go_to({now_.x, relative() ? now_.y + y : y});
      break;
    }
    case 'C': {
      const vec2 first = point(), second = point(), last = point();
      curve(first, second, last);
      break;
    }
    case 'Q': {
      const vec2 middle = point(), last = point(), first = now_;
      curve(first + (2.0 / 3) * (middle - first), last + (2.0 / 3) * (middle - last), last);
      break;
    }
    case 'A':
      arc();
      break;
    case 'Z':
      finish(true);
      break;
    default:
      fail(std::string("the command '") + command_ + "' is not supported (M L H V C Q A Z are)");
    }
  }

  void start(vec2 p) {
    path_.points = {p};
    now_ = start_ = p;
  }
  void go_to(vec2 p) {
    if (p != now_)
      path_.points.push_back(p);
    now_ = p;
  }

  /// A cubic curve in so many equal parts that none strays further than the tolerance.
  void curve(vec2 b, vec2 c, vec2 d) {
    const vec2 a = now_;
    const double bend = std::max(norm(a - 2.0 * b + c), norm(b - 2.0 * c + d));
    const int parts = parts_for(0.75 * bend);
    for (int i = 1; i < parts; ++i) {
      const double t = static_cast<double>(i) / parts, s = 1 - t;
      go_to((s * s * s) * a + (3 * s * s * t) * b + (3 * s * t * t) * c + (t * t * t) * d);
    }
    go_to(d);
  }
  int parts_for(double bend) const {
    return std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / tolerance_))), 1, 10000);
  }

  /// An elliptic arc, by its center (SVG 1.1, appendix F.6).
  void arc() {
    double rx = std::abs(number()), ry = std::abs(number());
    const double turn = number() * std::numbers::pi / 180;
    const bool large = flag(), sweep = flag();
    const vec2 last = point(), first = now_;
    if (rx == 0 || ry == 0 || first == last) {
      go_to(last);
      return;
    }
    const double co = std::cos(turn), si = std::sin(turn);
    const vec2 half = 0.5 * (first - last);
    const vec2 p{co * half.x + si * half.y, -si * half.x + co * half.y};
    const double reach = (p.x * p.x) / (rx * rx) + (p.y * p.y) / (ry * ry);
    if (reach > 1) {
      rx *= std::sqrt(reach);
      ry *= std::sqrt(reach);
    }
    const double below = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
    const double root = std::sqrt(std::max(0.0, rx * rx * ry * ry / below - 1)) * (large == sweep ? -1 : 1);
    const vec2 c{root * rx * p.y / ry, -root * ry * p.x / rx};
    const vec2 center = vec2{co * c.x - si * c.y, si * c.x + co * c.y} + 0.5 * (first + last);
    const double from = std::atan2((p.y - c.y) / ry, (p.x - c.x) / rx);
    double swept = std::atan2((-p.y - c.y) / ry, (-p.x - c.x) / rx) - from;
    if (sweep && swept < 0)
      swept += 2 * std::numbers::pi;
    if (!sweep && swept > 0)
      swept -= 2 * std::numbers::pi;
    const int parts = parts_for(std::max(rx, ry) * swept * swept / 8);
    for (int i = 1; i < parts; ++i) {
      const double at = from + swept * i / parts;
      const vec2 q{rx * std::cos(at), ry * std::sin(at)};
      go_to(center + vec2{co * q.x - si * q.y, si * q.x + co * q.y});
    }
    go_to(last);
  }

  /// Ends a subpath. A last point at the first one closes it too.
  void finish(bool closed) {
    auto& points = path_.points;
    if (points.size() > 1) {
      const bool returns = norm(points.back() - points.front()) <= 1e-9 * (norm(points.front()) + tolerance_);
      if (returns)
        points.pop_back();
      path_.name = options_.name;
      if (closed || returns)
        drawing_.polygons.push_back(std::move(path_));
      else if (options_.open_paths_are_lines)
        drawing_.lines.push_back(std::move(path_));
      else
        throw geometry_error(name() + " is open: it starts at " + text_of(points.front()) + " and ends at " +
                             text_of(points.back()) + "; close it with Z");
    }
    path_ = {};
    if (closed)
      now_ = start_;
  }

  std::string_view data_;
  const svg_path_options& options_;
  plane_drawing& drawing_;
  std::size_t at_ = 0;
  char command_ = 0;
  double tolerance_ = 0;
  vec2 now_{0, 0}, start_{0, 0};
  plane_path path_;
};

} // namespace detail

DOVETAIL_INLINE plane_drawing drawing_from_svg_path(std::string_view data, const svg_path_options& options) {
  plane_drawing drawing;
  detail::svg_path_reader(data, options, drawing).read();
  return drawing;
}

} // namespace dovetail
