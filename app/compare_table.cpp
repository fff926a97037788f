#include "compare_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dovetail::app {
namespace {

using text_row = std::vector<std::string>;

/// A field of a CSV file: in quotes when it has to be.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string csv_line(const text_row& fields) {
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    line += k == 0 ? "" : ",";
    line += csv_field(fields[k]);
  }
  return line + '\n';
}

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
  std::vector<text_row> lines{{"partitioner", "mesher", "improver", "simplification"}};
  for (const auto& column : columns)
    lines.front().push_back(column.heading);
  for (const auto& row : compared.rows) {
    const combination& by = row.policies;
    lines.push_back({by.partitioner, by.mesher, by.improver, simplification_of(by)});
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

std::vector<table_column> result_columns() {
  using row = const comparison_row&;
  return {
      {"elements", "elements", "Tetrahedra of the mesh.", 0, [](row r) { return whole(r.elements); }},
      {"bad_per_million", "bad/M", "Elements with a dihedral angle under 12 degrees, per million.", 1,
       [](row r) { return r.quality.per_million_under(12); }},
      {"low_per_million", "low/M", "Elements with a dihedral angle under 24 degrees, per million.", 1,
       [](row r) { return r.quality.per_million_under(24); }},
      {"min_dihedral_deg", "min angle", "The smallest dihedral angle of any element, in degrees.", 2,
       [](row r) { return r.quality.min_wedge_deg; }},
      {"mean_min_dihedral_deg", "mean min", "The mean over elements of their smallest dihedral angle.", 2,
       [](row r) { return r.quality.mean_min_wedge_deg(); }},
      {"coarse_min_face_deg", "coarse face",
       "The smallest angle of a triangle of an interface in the background mesh, in degrees.", 1,
       [](row r) { return r.coarse.min_face_angle; }},
      {"coarse_min_wedge_deg", "coarse wedge",
       "The smallest angle between an interface and another one or the surface, in the background mesh.", 1,
       [](row r) { return r.coarse.min_wedge; }},
      {"coarse_under_30", "coarse <30",
       "How many angles of the two kinds are under 30 degrees in the background mesh.", 0,
       [](row r) { return whole(r.coarse.under_threshold); }},
      {"fine_min_face_deg", "fine face", "The smallest angle of an interface's triangle in the mesh.", 1,
       [](row r) { return r.fine.min_face_angle; }},
      {"fine_min_wedge_deg", "fine wedge",
       "The smallest angle between an interface and another one or the surface, in the mesh.", 1,
       [](row r) { return r.fine.min_wedge; }},
      {"fine_under_30", "fine <30", "How many angles of the two kinds are under 30 degrees in the mesh.", 0,
       [](row r) { return whole(r.fine.under_threshold); }},
      {"cut", "cut", "Faces of the background mesh between two subdomains.", 0,
       [](row r) { return whole(r.coarse.faces); }},
      {"interface_triangles", "interf. tri.", "Triangles of the mesh between two subdomains.", 0,
       [](row r) { return whole(r.fine.faces); }},
      {"imbalance", "imbalance", "Elements of the largest subdomain over the average.", 3,
       [](row r) { return r.imbalance; }},
      {"subdomains", "subdomains", "Subdomains of the mesh.", 0, [](row r) { return r.subdomains; }},
      {"background_elements", "backgr. el.", "Tetrahedra of the background mesh.", 0,
       [](row r) { return whole(r.background_elements); }},
  };
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
      column("intersection", "intersection", "Seconds for finding and removing crossings of the skeleton.",
             &stage_seconds::intersection),
      column("meshing", "meshing", "Seconds for meshing the subdomains, all workers together.",
             &stage_seconds::meshing),
      column("improvement", "improve", "Seconds for improving the subdomains.", &stage_seconds::improvement),
      column("total", "total", "Seconds from the geometry to the mesh.", &stage_seconds::total),
  };
}

std::string terminal_text(const comparison& compared) {
  std::string text = "Results\n" + aligned_table(compared, result_columns()) + "\nSeconds\n" +
                     aligned_table(compared, time_columns());
  if (std::any_of(compared.rows.begin(), compared.rows.end(),
                  [](const comparison_row& row) { return row.background_reused; }))
    text += "The background mesh was made once for each mesher; its time is repeated and in every total.\n";
  for (const auto& row : compared.rows)
    if (row.failed())
      text += name_of(row.policies) + ", " + simplification_of(row.policies) +
              " simplification, failed: " + row.error + '\n';
  return text;
}

std::string csv_text(const comparison& compared) {
  std::vector<table_column> columns = result_columns();
  const auto times = time_columns();
  columns.insert(columns.end(), times.begin(), times.end());
  text_row head{"partitioner", "mesher", "improver", "simplification", "error", "background_reused"};
  for (const auto& column : columns)
    head.push_back(column.key);
  std::string text = csv_line(head);
  for (const auto& row : compared.rows) {
    const combination& by = row.policies;
    text_row fields{by.partitioner,        by.mesher, by.improver,
                    simplification_of(by), row.error, row.background_reused ? "yes" : "no"};
    for (const auto& column : columns)
      fields.push_back(column.text(row));
    text += csv_line(fields);
  }
  return text;
}

} // namespace dovetail::app
