#include "run_figures.hpp"

#include "json_text.hpp"

#include "dovetail/core/output_file.hpp"
#include "dovetail/core/version.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <sys/resource.h>

namespace dovetail::app {
namespace {

using json = nlohmann::ordered_json;

json seconds_json(const stage_seconds& seconds) {
  return {{"geometry", seconds.geometry},
          {"scaling", seconds.scaling},
          {"background", seconds.background},
          {"simplification", seconds.simplification},
          {"partition", seconds.partition},
          {"skeleton", seconds.skeleton},
          {"intersection", seconds.intersection},
          {"bisection", seconds.bisection},
          {"meshing", seconds.meshing},
          {"fine_partition", seconds.fine_partition},
          {"improvement", seconds.improvement},
          {"redistribution", seconds.redistribution},
          {"first_pass", seconds.first_pass},
          {"between_passes", seconds.between_passes},
          {"second_pass", seconds.second_pass},
          {"writing_back", seconds.writing_back},
          {"output", seconds.output},
          {"total", seconds.total}};
}

json quality_json(const quality_statistics& quality, int dimension) {
  const quality_limits under = limits_of(dimension);
  return {{"min_dihedral_deg", quality.min_dihedral_deg},
          {"max_dihedral_deg", quality.max_dihedral_deg},
          {"mean_min_dihedral_deg", quality.mean_min_dihedral_deg()},
          {"bad_per_million", quality.per_million_under(under.bad)},
          {"low_per_million", quality.per_million_under(under.low)},
          {"worst_element", quality.worst_element},
          {"min_face_angle_deg", quality.min_face_deg},
          {"histogram",
           {{"bin_width_deg", 1},
            {"min_dihedral", quality.min_dihedrals.bins},
            {"max_dihedral", quality.max_dihedrals.bins}}}};
}

json ring_json(const ring_quality& ring, int dimension) {
  const quality_limits under = limits_of(dimension);
  const bool is_empty = ring.elements == 0;
  return {{"elements", ring.elements},
          {"min_dihedral_deg", is_empty ? json(nullptr) : json(ring.min_dihedral_deg)},
          {"mean_min_dihedral_deg", is_empty ? json(nullptr) : json(ring.mean_min_dihedral_deg())},
          {"bad", ring.min_dihedrals.below(under.bad)},
          {"low", ring.min_dihedrals.below(under.low)}};
}

json at_interfaces_json(const quality_at_interfaces& found, int dimension) {
  return {{"touching", ring_json(found.touching, dimension)},
          {"next_ring", ring_json(found.next_ring, dimension)},
          {"rest", ring_json(found.rest, dimension)}};
}

/// By cause; each element under the low limit is counted once.
json poor_elements_json(const poor_elements& poor, int dimension) {
  json causes = json::array();
  for (std::size_t k = 0; k < poor_causes; ++k) {
    const auto cause = static_cast<poor_cause>(k);
    causes.push_back({{"cause", name_of_cause(cause, dimension)},
                      {"bad", poor.bad_by(cause)},
                      {"low", poor.low_by(cause)}});
  }
  json thinnest;
  if (std::isfinite(poor.thinnest_wall)) {
    const vec3 p = poor.thinnest_place;
    thinnest = {{"thickness", poor.thinnest_wall}, {"at", {p.x, p.y, p.z}}};
  }
  return {{"causes", causes}, {"thinnest_wall", thinnest}};
}

json suppressed_json(const std::vector<suppressed_detail>& details) {
  json listed = json::array();
  for (const suppressed_detail& each : details)
    listed.push_back({{"what", name_of(each.what)},
                      {"entity", each.entity},
                      {"length", each.length},
                      {"at", {each.place.x, each.place.y, each.place.z}}});
  return listed;
}

json small_angles_json(const std::vector<small_angle>& angles) {
  json listed = json::array();
  for (const small_angle& each : angles)
    listed.push_back({{"angle_deg", each.angle_deg},
                      {"of", each.dihedral ? "dihedral" : "face"},
                      {"cause", each.cause},
                      {"at", {each.place.x, each.place.y, each.place.z}},
                      {"cad", each.cad}});
  return listed;
}

/// Null where there is no angle.
json angle_json(const std::optional<double>& angle_deg) {
  return angle_deg ? json(*angle_deg) : json(nullptr);
}

json interfaces_json(const interface_figures& interfaces) {
  return {{"min_face_angle_deg", angle_json(interfaces.min_face_angle_deg)},
          {"min_dihedral_deg", angle_json(interfaces.min_dihedral_deg)},
          {"faces", interfaces.faces},
          {"forced", interfaces.forced},
          {"refused", interfaces.refused},
          {"remeshing", interfaces.remeshing},
          {"below_threshold", small_angles_json(interfaces.below)}};
}

json deviation_json(const report& deviation) {
  json faces = json::array();
  for (const report& face : deviation.children) {
    const surface_deviation found = deviation_in(face);
    faces.push_back({{"face", face.name}, {"points", found.points}, {"centres", found.centres}});
  }
  const surface_deviation largest = deviation_in(deviation);
  return {{"points", largest.points}, {"centres", largest.centres}, {"faces", faces}};
}

json details_json(const report& details) {
  json counters = json::object();
  for (const auto& [key, value] : details.counters)
    counters[key] = value;
  json children = json::array();
  for (const auto& child : details.children)
    children.push_back(details_json(child));
  return {{"name", details.name},
          {"seconds", details.seconds},
          {"counters", counters},
          {"warnings", details.warnings},
          {"children", children}};
}

/// The files by their names in the folder, which is told from the report's own, so that both may be moved.
json files_json(const std::vector<written_file>& files) {
  json listed = json::array();
  for (const auto& file : files)
    listed.push_back({{"name", file.name}, {"bytes", file.bytes}, {"checksum", file.checksum}});
  return listed;
}

std::string folder_from(const std::filesystem::path& report, const std::string& folder) {
  if (folder.empty())
    return {};
  const auto from = std::filesystem::absolute(report).lexically_normal().parent_path();
  return std::filesystem::absolute(folder).lexically_normal().lexically_relative(from).string();
}

void write_json(const json& document, const std::filesystem::path& path) {
  output_file file(path);
  file.text(text_of_json(document, 2) + '\n');
  file.commit();
}

} // namespace

void write_report(const run_figures& figures, const std::filesystem::path& file) {
  const std::string folder = folder_from(file, figures.out);
  json interfaces = interfaces_json(figures.interfaces);
  interfaces["coarse"] = interfaces_json(figures.coarse_interfaces);
  json document = {{"dovetail", version},
                   {"mesh_revision", mesh_revision},
                   {"dimension", figures.dimension},
                   {"model", figures.model},
                   {"decomposition", figures.decomposition},
                   {"mesher", figures.mesher},
                   {"partitioner", figures.partitioner},
                   {"simplifier", figures.simplifier},
                   {"improver", figures.improver},
                   {"executor", figures.executor},
                   {"background_mesher", figures.background_mesher},
                   {"surface_mesher", figures.surface_mesher},
                   {"workers", figures.workers},
                   {"elements", figures.elements},
                   {"vertices", figures.vertices},
                   {"boundary_triangles", figures.boundary_triangles},
                   {"background_elements", figures.background_elements},
                   {"subdomains", figures.subdomains},
                   {"only", figures.only},
                   {"of_subdomains", figures.of_subdomains},
                   {"imbalance", figures.imbalance},
                   {"seconds", seconds_json(figures.seconds)},
                   {"quality", quality_json(figures.quality, figures.dimension)},
                   {"at_interfaces", at_interfaces_json(figures.at_interfaces, figures.dimension)},
                   {"poor_elements", poor_elements_json(figures.poor, figures.dimension)},
                   {"suppressed", suppressed_json(figures.suppressed)},
                   {"interfaces", interfaces},
                   {"deviation", deviation_json(figures.deviation)},
                   {"merges", figures.merges},
                   {"largest_merged", figures.largest_merged},
                   {"failed_subdomains", figures.failed_subdomains},
                   {"elements_between_passes", figures.elements_between_passes},
                   {"largest_over_mean", figures.largest_over_mean},
                   {"peak_rss_bytes", figures.peak_rss_bytes},
                   {"mesh_hash", hexadecimal(figures.mesh_hash)},
                   {"repeatable", figures.repeatable},
                   {"folder", folder},
                   {"files", files_json(figures.files)},
                   {"warnings", figures.warnings},
                   {"details", details_json(figures.details)}};
  if (!is_utf8(folder)) // or nobody could find the files by it
    document["folder_bytes"] = digits_of_bytes(folder);
  write_json(document, file);
}

void write_quality_report(const quality_statistics& quality, int dimension, std::int64_t vertices,
                          const report& details, const std::filesystem::path& file,
                          const std::optional<quality_at_interfaces>& at_interfaces) {
  json document = {{"dovetail", version},    {"mesh_revision", mesh_revision},
                   {"dimension", dimension}, {"elements", quality.elements},
                   {"vertices", vertices},   {"quality", quality_json(quality, dimension)}};
  if (at_interfaces)
    document["at_interfaces"] = at_interfaces_json(*at_interfaces, dimension);
  document["details"] = details_json(details);
  write_json(document, file);
}

void write_plan(const plan_figures& figures, const std::filesystem::path& file) {
  write_json({{"dovetail", version},
              {"mesh_revision", mesh_revision},
              {"dimension", figures.dimension},
              {"model", figures.model},
              {"predicted_elements", figures.elements},
              {"relative_error", figures.relative_error},
              {"subdomains", figures.subdomains},
              {"coarsening", figures.coarsening},
              {"workers", figures.workers},
              {"predicted_seconds", figures.seconds},
              {"predicted_worker_bytes", figures.worker_bytes},
              {"predicted_parent_bytes", figures.parent_bytes},
              {"predicted_disk_bytes", figures.disk_bytes},
              {"warnings", figures.warnings}},
             file);
}

std::uint64_t peak_rss_bytes() {
  std::uint64_t kilobytes = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (getrusage(who, &usage) == 0)
      kilobytes = std::max(kilobytes, static_cast<std::uint64_t>(usage.ru_maxrss));
  }
  return 1024 * kilobytes;
}

} // namespace dovetail::app
