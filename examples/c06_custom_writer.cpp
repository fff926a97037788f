/// A writer of one's own: a mesh for the flow solver SU2, one piece in memory at a time.
/// Usage: c06_custom_writer FILE FOLDER
#include "dovetail/dovetail.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/models/occt_model.hpp"

#include <cstdio>

/// Writes mesh.su2 under a temporary name, and renames it when it is whole. Markers are the groups of faces.
struct su2_writer {
  dovetail::report operator()(const dovetail::distributed_mesh& mesh,
                              const std::filesystem::path& folder) const {
    using namespace dovetail;
    const auto numbers = io::number_globally(mesh);
    make_folder(folder);
    output_file file(folder / "mesh.su2");
    const auto line = [&](auto first, auto... more) {
      file.number(first);
      ((file.text(" "), file.number(more)), ...);
      file.text("\n");
    };
    file.text("NDIME= 3\nNELEM= " + std::to_string(numbers.elements()) + "\n");
    for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
      const auto piece = io::load_checked(mesh, static_cast<local_id>(p));
      const auto point = [&](local_id v) { return io::global_point(piece, numbers, v); };
      for (const auto& [a, b, c, d] : piece.mesh.elements)
        line(10, point(a), point(b), point(c), point(d)); // 10: a tetrahedron
    }
    file.text("NPOIN= " + std::to_string(numbers.points()) + "\n");
    for (const vec3 p : mesh.skeleton.points)
      line(p.x, p.y, p.z);
    for (std::size_t k = 0; k < mesh.counts.size(); ++k) {
      const auto piece = mesh.load(static_cast<local_id>(k));
      for (std::size_t i = piece.skeleton_points.size(); i < piece.mesh.points.size(); ++i)
        line(piece.mesh.points[i].x, piece.mesh.points[i].y, piece.mesh.points[i].z);
    }
    const auto groups = io::collect_face_groups(mesh);
    std::vector<std::vector<simplex<2>>> of_group(groups.names.size());
    for (std::size_t t = 0; t < mesh.skeleton.sides.size(); ++t)
      if (mesh.skeleton.subdomains[t][1] == no_id) // the domain ends there
        of_group[groups.of_face[mesh.skeleton.side_hosts[t]]].push_back(mesh.skeleton.sides[t]);
    file.text("NMARK= " + std::to_string(of_group.size()) + "\n");
    for (std::size_t m = 0; m < of_group.size(); ++m) {
      file.text("MARKER_TAG= " + groups.names[m] + "\nMARKER_ELEMS= " + std::to_string(of_group[m].size()) +
                "\n");
      for (const auto& [a, b, c] : of_group[m])
        line(5, a, b, c); // 5: a triangle
    }
    file.commit();
    report summary;
    summary.name = "su2";
    summary.set("elements", static_cast<double>(numbers.elements()));
    return summary;
  }
};
static_assert(dovetail::mesh_writer<su2_writer>);

int main(int argc, char** argv) try {
  using namespace dovetail;
  if (argc < 3)
    throw input_error("usage: c06_custom_writer FILE FOLDER");
  const auto model = read_occt_model(argv[1]).model;
  const uniform_size size(model.bounds().diagonal() / 25);
  const auto result = generate<3>(model, size, parameters<>{});
  std::printf("%.0f tetrahedra\n", su2_writer{}(result.mesh, argv[2]).get("elements"));
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
