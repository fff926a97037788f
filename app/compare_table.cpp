#include "compare_table.hpp"

#include "csv.hpp"

#include "dovetail/core/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dovetail::app {
namespace {

/// The first four columns to the left, numbers to the right.
std::string aligned(const std::vector<text_row>& lines) {
  constexpr std::size_t names = 4;
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k)
      widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (const auto& line : lines) {
    std::string padded;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string space(widths[k] - line[k].size(), ' ');
      padded += k == 0 ? "" : "  ";
      padded += k < names ? line[k] + space : space + line[k];
    }
    padded.erase(padded.find_last_not_of(' ') + 1);
    text += padded + '\n';
  }
  return text;
}

std::string aligned_table(const comparison& compared, const std::vector<table_column>& columns) {
  std::vector<text_row> lines{{"partitioner", "mesher", "improver", "simplifier"}};
  for (const auto& column : columns)
    lines.front().push_back(column.heading);
  for (const auto& row : compared.rows) {
    const combination& by = row.policies;
    lines.push_back({by.partitioner, by.mesher, by.improver, by.simplifier});
    for (const auto& column : columns)
      lines.back().push_back(row.failed() ? "-" : column.text(row));
  }
  return aligned(lines);
}

double whole(std::int64_t count) {
  return static_cast<double>(count);
}

} // namespace

std::string table_column::text(const comparison_row& row) const {
  const double number = row.failed() ? std::nan("") : value(row);
  if (std::isnan(number))
    return {};
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, number);
  return buffer;
}

namespace {

std::vector<table_column> quality_columns(const element_words& words) {
  using row = const comparison_row&;
  const std::string angle = words.angle;
  const auto under = [&](int degrees) {
    return "Elements with " + std::string(angle == "angle" ? "an " : "a ") + angle + " under " +
           std::to_string(degrees) + " degrees, per million.";
  };
  const std::string key = angle == "angle" ? "angle" : "dihedral";
  return {
      {"elements", "elements", "Elements of the mesh: " + std::string(words.elements) + ".", 0,
       [](row r) { return whole(r.elements); }},
      {"bad_per_million", "bad/M", under(words.bad), 1,
       [bad = words.bad](row r) { return r.quality.per_million_under(bad); }},
      {"low_per_million", "low/M", under(words.low), 1,
       [low = words.low](row r) { return r.quality.per_million_under(low); }},
      {"min_" + key + "_deg", "min angle", "The smallest " + angle + " of any element, in degrees.", 2,
       [](row r) { return r.quality.min_dihedral_deg; }},
      {"mean_min_" + key + "_deg", "mean min", "The mean over elements of their smallest " + angle + ".", 2,
       [](row r) { return r.quality.mean_min_dihedral_deg(); }},
  };
}

/// Angles of triangles between subdomains, and at their edges.
std::vector<table_column> interface_face_columns() {
  using row = const comparison_row&;
  return {
      {"coarse_min_face_deg", "coarse face",
       "The smallest angle of a triangle of an interface in the background mesh, in degrees.", 1,
       [](row r) { return r.coarse.min_face_angle; }},
      {"coarse_min_dihedral_deg", "coarse dihedral",
       "The smallest angle between an interface and another one or the surface, in the background mesh.", 1,
       [](row r) { return r.coarse.min_dihedral; }},
      {"coarse_under_30", "coarse <30",
       "How many angles of the two kinds are under 30 degrees in the background mesh.", 0,
       [](row r) { return whole(r.coarse.under_threshold); }},
      {"fine_min_face_deg", "fine face", "The smallest angle of an interface's triangle in the mesh.", 1,
       [](row r) { return r.fine.min_face_angle; }},
      {"fine_min_dihedral_deg", "fine dihedral",
       "The smallest angle between an interface and another one or the surface, in the mesh.", 1,
       [](row r) { return r.fine.min_dihedral; }},
      {"fine_under_30", "fine <30", "How many angles of the two kinds are under 30 degrees in the mesh.", 0,
       [](row r) { return whole(r.fine.under_threshold); }},
      {"cut", "cut", "Faces of the background mesh between two subdomains.", 0,
       [](row r) { return whole(r.coarse.faces); }},
      {"interface_triangles", "interf. tri.", "Triangles of the mesh between two subdomains.", 0,
       [](row r) { return whole(r.fine.faces); }},
  };
}

/// Angles where the lines between subsurfaces meet each other or a CAD curve.
std::vector<table_column> interface_line_columns() {
  using row = const comparison_row&;
  return {
      {"coarse_min_corner_deg", "coarse corner",
       "The smallest angle that a line between subdomains makes with another one or with a CAD curve, in the "
       "background mesh, in degrees.",
       1, [](row r) { return r.coarse.min_dihedral; }},
      {"coarse_under_50", "coarse <50",
       "How many of these angles are under 50 degrees in the background mesh.", 0,
       [](row r) { return whole(r.coarse.under_threshold); }},
      {"fine_min_corner_deg", "fine corner",
       "The smallest angle between the first edges of such lines in the mesh.", 1,
       [](row r) { return r.fine.min_dihedral; }},
      {"fine_under_50", "fine <50", "How many of these angles are under 50 degrees in the mesh.", 0,
       [](row r) { return whole(r.fine.under_threshold); }},
      {"cut", "cut", "Edges of the background mesh between two subdomains.", 0,
       [](row r) { return whole(r.coarse.faces); }},
  };
}

} // namespace

std::vector<table_column> result_columns(int dimension) {
  using row = const comparison_row&;
  const element_words words = words_of(dimension);
  std::vector<table_column> columns = quality_columns(words);
  append(columns, dimension == 3 ? interface_face_columns() : interface_line_columns());
  append(columns,
         std::vector<table_column>{
             {"imbalance", "imbalance", "Elements of the largest subdomain over the average.", 3,
              [](row r) { return r.imbalance; }},
             {"subdomains", "subdomains", "Subdomains of the mesh.", 0, [](row r) { return r.subdomains; }},
             {"background_elements", "backgr. el.",
              "Elements of the background mesh: " + std::string(words.elements) + ".", 0,
              [](row r) { return whole(r.background_elements); }},
         });
  return columns;
}

std::vector<table_column> time_columns() {
  const auto column = [](const std::string& key, const std::string& heading, const std::string& meaning,
                         double stage_seconds::*member) {
    return table_column{"seconds_" + key, heading, meaning, 2,
                        [member](const comparison_row& row) { return row.seconds.*member; }};
  };
  return {
      column("background", "background", "Seconds for the background mesh.", &stage_seconds::background),
      column("simplification", "simplify", "Seconds for the simplification, or for setting up without it.",
             &stage_seconds::simplification),
      column("partition", "partition", "Seconds for the partition and its repair.",
             &stage_seconds::partition),
      column("skeleton", "skeleton", "Seconds for remeshing the interfaces and the surface.",
             &stage_seconds::skeleton),
      column("intersection", "intersection",
             "Seconds for finding crossing triangles, and for what removes them in dimension 3.",
             &stage_seconds::intersection),
      column("meshing", "meshing", "Seconds for meshing the subdomains, all workers together.",
             &stage_seconds::meshing),
      column("improvement", "improve", "Seconds for improving the subdomains.", &stage_seconds::improvement),
      column("total", "total", "Seconds from the geometry to the mesh.", &stage_seconds::total),
  };
}

std::string terminal_text(const comparison& compared) {
  std::string text = "Results\n" + aligned_table(compared, result_columns(compared.dimension)) +
                     "\nSeconds\n" + aligned_table(compared, time_columns());
  if (std::any_of(compared.rows.begin(), compared.rows.end(),
                  [](const comparison_row& row) { return row.background_reused; }))
    text += "The background mesh was made once for each mesher; its time is repeated and in every total.\n";
  for (const auto& row : compared.rows)
    if (row.failed())
      text += full_name_of(row.policies) + ", failed: " + row.error + '\n';
  return text;
}

std::string csv_text(const comparison& compared) {
  std::vector<table_column> columns = result_columns(compared.dimension);
  const auto times = time_columns();
  columns.insert(columns.end(), times.begin(), times.end());
  text_row head{"partitioner", "mesher", "improver", "simplifier", "error", "background_reused"};
  for (const auto& column : columns)
    head.push_back(column.key);
  head.emplace_back("mesh_hash");
  for (const auto& fact : compared.origin)
    head.push_back(fact.key);
  std::string text = csv_line(head);
  for (const auto& row : compared.rows) {
    const combination& by = row.policies;
    text_row fields{by.partitioner, by.mesher, by.improver,
                    by.simplifier,  row.error, row.background_reused ? "yes" : "no"};
    for (const auto& column : columns)
      fields.push_back(column.text(row));
    fields.push_back(row.mesh_hash);
    for (const auto& fact : compared.origin)
      fields.push_back(fact.text);
    text += csv_line(fields);
  }
  return text;
}

} // namespace dovetail::app
