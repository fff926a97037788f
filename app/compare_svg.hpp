/// @file
/// Drawings for a page: text, lines and areas as inline SVG, every element closed as XML wants it.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// Text with the characters replaced that mean something in HTML and XML.
inline std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    switch (c) {
    case '&':
      safe += "&amp;";
      break;
    case '<':
      safe += "&lt;";
      break;
    case '>':
      safe += "&gt;";
      break;
    case '"':
      safe += "&quot;";
      break;
    default:
      safe += c;
    }
  return safe;
}

/// A number with so many decimals.
inline std::string fixed(double number, int decimals = 1) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, number);
  return buffer;
}

/// Where text stands relative to its point.
enum class text_anchor { start, middle, end };

/// One drawing. Coordinates are pixels, x to the right and y down.
class svg_drawing {
public:
  svg_drawing(double width, double height) : width_(width), height_(height) {}

  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const std::string& tip = {}) {
    open("rect");
    number("x", x), number("y", y), number("width", width), number("height", height);
    word("fill", fill);
    close("rect", tip);
  }
  void line(double x1, double y1, double x2, double y2, const std::string& colour, double width = 1,
            bool dashed = false) {
    open("line");
    number("x1", x1), number("y1", y1), number("x2", x2), number("y2", y2);
    word("stroke", colour), number("stroke-width", width);
    if (dashed)
      word("stroke-dasharray", "4 3");
    close("line", {});
  }
  /// Filled with its colour, or hollow.
  void disc(double x, double y, double radius, const std::string& colour, bool filled,
            const std::string& tip = {}) {
    open("circle");
    number("cx", x), number("cy", y), number("r", radius);
    word("fill", filled ? colour : "#fff"), word("stroke", colour), number("stroke-width", 1.8);
    close("circle", tip);
  }
  void curve(const std::vector<std::pair<double, double>>& points, const std::string& colour) {
    open("polyline");
    std::string places;
    for (const auto& [x, y] : points)
      places += fixed(x) + ',' + fixed(y) + ' ';
    word("points", places), word("fill", "none"), word("stroke", colour), number("stroke-width", 1.6);
    close("polyline", {});
  }
  void text(double x, double y, const std::string& words, text_anchor anchor = text_anchor::start,
            const std::string& colour = "#333") {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    open("text");
    number("x", x), number("y", y);
    word("text-anchor", anchors[static_cast<int>(anchor)]), word("fill", colour);
    body_ += '>' + escaped(words) + "</text>\n";
  }

  /// The drawing as an element of a page; `label` says what it shows to those who cannot see it.
  std::string element(const std::string& label) const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + fixed(width_, 0) + ' ' +
           fixed(height_, 0) + "\" width=\"" + fixed(width_, 0) + "\" role=\"img\" aria-label=\"" +
           escaped(label) + "\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n" + body_ +
           "</svg>\n";
  }

private:
  void open(const char* name) {
    body_ += '<';
    body_ += name;
  }
  void close(const char* name, const std::string& tip) {
    if (tip.empty())
      body_ += "/>\n";
    else
      body_ += "><title>" + escaped(tip) + "</title></" + name + ">\n";
  }
  void word(const char* key, const std::string& value) {
    body_ += ' ';
    body_ += key;
    body_ += "=\"" + escaped(value) + '"';
  }
  void number(const char* key, double value) { word(key, fixed(value)); }

  double width_;
  double height_;
  std::string body_;
};

} // namespace dovetail::app
