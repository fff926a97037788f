#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "plane_meshes.hpp"
#include "solid_meshes.hpp"

#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

/// A mesh's surface on the faces of its CAD model.
struct surface_of_mesh {
  std::vector<vec3> points;
  std::vector<host> hosts; ///< per point; empty where they are not known
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<local_id> faces;
};

surface_of_mesh surface_of(const distributed_mesh& mesh) {
  surface_of_mesh found;
  append(found.points, mesh.skeleton.points);
  append(found.hosts, mesh.skeleton.point_hosts);
  for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s)
    if (const auto [a, b, c] = mesh.skeleton.sides[s]; mesh.skeleton.side_hosts[s] != no_id) {
      found.triangles.push_back(
          {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
      found.faces.push_back(mesh.skeleton.side_hosts[s]);
    }
  return found;
}

surface_of_mesh surface_of(const distributed_simplicial_mesh<2>& mesh) {
  const whole_mesh all = whole(mesh);
  surface_of_mesh found;
  std::map<global_id, std::size_t> place;
  for (const auto& [id, point] : all.points) {
    place[id] = found.points.size();
    found.points.push_back(point);
  }
  for (const auto& [a, b, c] : all.triangles)
    found.triangles.push_back({place.at(a), place.at(b), place.at(c)});
  found.faces = all.faces;
  return found;
}

std::int64_t euler_characteristic(const surface_of_mesh& mesh) {
  std::set<std::size_t> points;
  std::set<std::array<std::size_t, 2>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      points.insert(t[k]);
      edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    }
  return static_cast<std::int64_t>(points.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangles.size());
}

/// Vertices - edges + faces, where a face with holes counts as what it is without its boundary: 2 less its
/// loops.
std::int64_t euler_characteristic(const occt_model& model) {
  const geometry_topology& topology = model.topology();
  std::set<local_id> vertices;
  std::int64_t edges = 0, faces = 0;
  for (const auto& curve : topology.curves)
    if (!curve.degenerate) {
      ++edges;
      vertices.insert(curve.vertices.begin(), curve.vertices.end());
    }
  for (const TopoDS_Face& face : model.data().faces) {
    faces += 2;
    for (TopExp_Explorer loop(face, TopAbs_WIRE); loop.More(); loop.Next())
      --faces;
  }
  return static_cast<std::int64_t>(vertices.size()) - edges + faces;
}

/// Of one face of the CAD, and of the mesh on it.
struct face_figures {
  double cad_area = 0, area = 0, farthest = 0, longest_edge = 0;

  /// Of faces smaller than an element no more can be asked than of an element.
  double error() const { return std::abs(area - cad_area) / (cad_area + longest_edge * longest_edge); }
  /// A circle of eight edges, as coarse as one on the boundary gets, encloses a tenth less. A tube thinner
  /// than the size may have three around: a sixth less.
  double largest_error() const { return cad_area > 25 * longest_edge * longest_edge ? 0.1 : 0.2; }
};

std::vector<face_figures> compare_faces(const occt_model& model, const surface_of_mesh& mesh) {
  std::vector<face_figures> figures(model.topology().faces.size());
  std::vector<std::set<std::size_t>> points(figures.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto f = static_cast<std::size_t>(mesh.faces[t]);
    figures[f].area += 0.5 * norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
    points[f].insert({a, b, c});
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      figures[f].longest_edge = std::max(figures[f].longest_edge, distance(mesh.points[p], mesh.points[q]));
  }
  for (std::size_t f = 0; f < figures.size(); ++f) {
    const TopoDS_Face& face = model.data().faces[f];
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties, 1e-4);
    figures[f].cad_area = std::abs(properties.Mass());
    ShapeAnalysis_Surface surface(BRep_Tool::Surface(face));
    for (const std::size_t v : points[f]) {
      const vec3 p = mesh.points[v];
      const gp_Pnt at(p.x, p.y, p.z);
      const gp_Pnt2d uv = surface.ValueOfUV(at, 1e-9);
      figures[f].farthest = std::max(figures[f].farthest, surface.Value(uv).Distance(at));
    }
  }
  return figures;
}

void check_surface(const occt_model& model, const surface_of_mesh& mesh) {
  const double diagonal = model.bounds().diagonal();
  double total = 0, cad_total = 0, worst = 0, farthest = 0;
  std::size_t worst_face = 0;
  const auto figures = compare_faces(model, mesh);
  for (std::size_t f = 0; f < figures.size(); ++f) {
    total += figures[f].area;
    cad_total += figures[f].cad_area;
    const double off = figures[f].error() / figures[f].largest_error();
    if (off > worst) {
      worst = off;
      worst_face = f;
    }
    farthest = std::max(farthest, figures[f].farthest);
  }
  CAPTURE(worst_face);
  CAPTURE(figures[worst_face].area);
  CAPTURE(figures[worst_face].cad_area);
  CHECK(total == doctest::Approx(cad_total).epsilon(0.01));
  CHECK(worst < 1);
  CHECK(farthest < 1e-3 * diagonal);
  CHECK(euler_characteristic(mesh) == euler_characteristic(model));
}

void check_both(const occt_model& model, const any_sizing& size) {
  const auto given = parameters<>{}.with_executor(parallel::processes{}).with_options(in_parts(5));
  const auto solid = generate<3>(model, size, given.with_mesher(mesher::tetgen{}));
  REQUIRE(solid.failures.empty());
  CHECK(solid.mesh.counts.size() >= 4);
  double volume = 0;
  for (const double part : occt_solid_volumes(model))
    volume += part;
  CHECK(volume_of(solid.mesh) == doctest::Approx(volume).epsilon(0.01));
  check_surface(model, surface_of(solid.mesh));

  const auto flat = generate<2>(model, size, given);
  REQUIRE(flat.failures.empty());
  check_surface(model, surface_of(flat.mesh));
}

} // namespace

TEST_CASE("built-in models: area of each face, volume, genus and distance are those of the CAD") {
  constexpr double coarser = 3;
  for (const auto& info : builtin_models()) {
    const std::string name(info.name);
    CAPTURE(name);
    auto built = builtin_model(info.name);
    for (auto& source : built.sources)
      for (auto& spacing : source.spacing)
        spacing *= coarser;
    check_both(built.model, source_field(coarser * built.size, std::move(built.sources)));
  }
}

TEST_CASE("external models: area of each face, volume, genus and distance are those of the CAD") {
  const char* shared = std::getenv("DOVETAIL_SHARED");
  if (shared == nullptr) {
    MESSAGE("SKIPPED: DOVETAIL_SHARED is not set");
    return;
  }
  for (const std::string file : {"linkrods.step", "U_Joint_2.stp", "SampleCrankshaft4A.stp"}) {
    CAPTURE(file);
    const occt_model model = read_occt_model(std::filesystem::path(shared) / "models" / file).model;
    check_both(model, uniform_size(model.bounds().diagonal() / 40));
  }
}
