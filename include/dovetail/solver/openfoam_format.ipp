/// @file
/// What `openfoam_format.hpp` declares.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/solver/openfoam_format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The faces of a rank as OpenFOAM numbers them: those between two cells by owner, then neighbour, each
/// facing its neighbour, the cell of higher number; then patch by patch, facing outwards.
struct foam_faces {
  std::vector<simplex<2>> vertices;
  std::vector<local_id> owners;        ///< per face
  std::vector<local_id> neighbours;    ///< per face between two cells
  std::vector<std::size_t> patch_ends; ///< per patch: its end in the faces
};

/// The patches that all ranks have, in the same order: groups of faces on the boundary of the domain, and
/// behind them one for faces without a CAD face, if there are any.
struct foam_patches {
  face_groups groups;
  std::vector<std::size_t> of_group; ///< the patch of each group; past the end for one inside the domain
  std::vector<std::string> names;
  bool has_default = false; ///< the last one is that of faces without a CAD face
};

inline bool is_foam_letter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.';
}

/// Distinct words of letters, digits and what is harmless in a name of OpenFOAM.
inline std::vector<std::string> foam_words(const std::vector<std::string>& names) {
  std::vector<std::string> words;
  std::set<std::string> taken;
  for (std::string word : names) {
    std::replace_if(
        word.begin(), word.end(), [](char c) { return !is_foam_letter(c); }, '_');
    if (word.empty() || (word.front() >= '0' && word.front() <= '9'))
      word.insert(0, "_");
    const std::string given = word;
    for (int n = 2; !taken.insert(word).second; ++n)
      word = given + "_" + std::to_string(n);
    words.push_back(word);
  }
  return words;
}

inline std::vector<std::string> foam_mesh_files(local_id rank, int ranks,
                                                std::initializer_list<const char*> files) {
  const std::string folder = ranks == 1 ? "" : "processor" + std::to_string(rank) + "/";
  std::vector<std::string> names;
  for (const char* file : files)
    names.push_back(folder + "constant/polyMesh/" + file);
  return names;
}

inline foam_patches collect_foam_patches(const distributed_mesh& mesh) {
  foam_patches patches{collect_face_groups(mesh), {}, {}, false};
  std::vector<bool> on_boundary(patches.groups.names.size(), false);
  for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s) {
    if (mesh.skeleton.subdomains[s][1] != no_id)
      continue;
    if (const local_id face = mesh.skeleton.side_hosts[s]; face == no_id)
      patches.has_default = true;
    else
      on_boundary[patches.groups.of_face[face]] = true;
  }
  for (std::size_t g = 0; g < on_boundary.size(); ++g) {
    patches.of_group.push_back(patches.names.size());
    if (on_boundary[g])
      patches.names.push_back(patches.groups.names[g]);
  }
  if (patches.has_default)
    patches.names.push_back("defaultFaces");
  patches.names = foam_words(patches.names);
  return patches;
}

inline foam_faces number_foam_faces(const rank_mesh<3>& rank, const foam_patches& patches) {
  const auto table =
      build_sides<3>(span_of(rank.mesh.elements).first(rank.owned_elements), rank.held_vertices);
  foam_faces faces;
  std::vector<std::size_t> inner;
  for (std::size_t s = 0; s < table.size(); ++s)
    if (!table.is_boundary(static_cast<local_id>(s)))
      inner.push_back(s);
  sort_all(inner, [&](std::size_t a, std::size_t b) { return table.elements[a] < table.elements[b]; });
  for (const std::size_t s : inner) {
    faces.vertices.push_back(table.vertices[s]);
    faces.owners.push_back(table.elements[s][0]);
    faces.neighbours.push_back(table.elements[s][1]);
  }

  struct outer_face {
    std::size_t patch;
    std::size_t place; ///< in its patch
    simplex<2> vertices;
    local_id owner;
  };
  std::vector<outer_face> outer;
  std::vector<bool> placed(table.size(), false);
  const auto add = [&](std::size_t patch, const simplex<2>& vertices) {
    const local_id side = find_side(table, vertices);
    if (side == no_id || !table.is_boundary(side) || placed[side])
      return;
    placed[side] = true;
    outer.push_back({patch, outer.size(), vertices, table.elements[side][0]});
  };
  for (std::size_t n = 0; n < rank.neighbours.size(); ++n)
    for (const auto& face : rank.neighbours[n].faces)
      add(patches.names.size() + n, face);
  for (std::size_t s = 0; s < rank.sides.size(); ++s)
    if (rank.side_elements[s][1] == no_id)
      add(patches.of_group[patches.groups.of_face[rank.side_hosts[s]]], rank.sides[s]);
  for (std::size_t s = 0; s < table.size(); ++s)
    if (table.is_boundary(static_cast<local_id>(s)) && !placed[s])
      add(patches.names.size() - 1, table.vertices[s]);
  sort_all(outer, [](const outer_face& a, const outer_face& b) {
    return std::pair(a.patch, a.place) < std::pair(b.patch, b.place);
  });
  std::size_t next = 0;
  for (std::size_t patch = 0; patch < patches.names.size() + rank.neighbours.size(); ++patch) {
    for (; next < outer.size() && outer[next].patch == patch; ++next) {
      faces.vertices.push_back(outer[next].vertices);
      faces.owners.push_back(outer[next].owner);
    }
    faces.patch_ends.push_back(faces.vertices.size());
  }
  return faces;
}

/// By this a dictionary is known to be no other's.
inline constexpr const char* foam_dictionary_note =
    "of dovetail, which replaces this file with the mesh: without this line it is kept";

/// A file of OpenFOAM, with a list in it or a dictionary.
class foam_file {
public:
  foam_file(const std::filesystem::path& path, const std::string& kind, const std::string& object,
            const std::string& note = {}, const std::string& location = "constant/polyMesh")
      : file_(path) {
    file_.text("FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + kind + ";\n" +
               (note.empty() ? "" : "    note \"" + note + "\";\n") + "    location \"" + location +
               "\";\n    object " + object + ";\n}\n");
  }
  /// `write(i)` writes entry i, which ends a line.
  template <class Function>
  void list(std::size_t count, const Function& write) {
    file_.number(count);
    file_.text("\n(\n");
    for (std::size_t i = 0; i < count; ++i) {
      write(i);
      file_.text("\n");
    }
    file_.text(")\n");
  }
  void labels(const std::vector<local_id>& values) {
    list(values.size(), [&](std::size_t i) { file_.number(values[i]); });
  }
  output_file& out() { return file_; }

private:
  output_file file_;
};

inline void write_foam_boundary(foam_file& file, const rank_mesh<3>& rank, const foam_patches& patches,
                                const foam_faces& faces) {
  const std::size_t common = patches.names.size();
  std::vector<std::size_t> listed; // common ones also when they are empty here, those of processors not
  std::vector<std::size_t> begins{faces.neighbours.size()};
  for (std::size_t p = 0; p < faces.patch_ends.size(); ++p) {
    if (p < common || faces.patch_ends[p] > begins.back())
      listed.push_back(p);
    begins.push_back(faces.patch_ends[p]);
  }
  file.list(listed.size(), [&](std::size_t i) {
    const std::size_t p = listed[i];
    const auto counts = "    nFaces " + std::to_string(faces.patch_ends[p] - begins[p]) +
                        ";\n    startFace " + std::to_string(begins[p]) + ";\n";
    if (p < common)
      return file.out().text(patches.names[p] + "\n{\n    type patch;\n" + counts + "}");
    const std::string here = std::to_string(rank.rank);
    const std::string there = std::to_string(rank.neighbours[p - common].rank);
    file.out().text("procBoundary" + here + "to" + there +
                    "\n{\n    type processor;\n    inGroups 1(processor);\n" + counts +
                    "    matchTolerance 0.0001;\n    transform unknown;\n    myProcNo " + here +
                    ";\n    neighbProcNo " + there + ";\n}");
  });
}

/// All ranks list all zones.
inline void write_foam_zones(foam_file& file, const rank_mesh<3>& rank,
                             const std::vector<std::string>& materials) {
  const auto words = foam_words(materials);
  file.list(words.size() > 1 ? words.size() : 0, [&](std::size_t m) {
    std::vector<local_id> cells;
    for (std::size_t e = 0; e < rank.owned_elements; ++e)
      if (rank.mesh.tags[e] == static_cast<local_id>(m))
        cells.push_back(static_cast<local_id>(e));
    file.out().text(words[m] + "\n{\n    type cellZone;\n    cellLabels List<label>\n");
    file.labels(cells);
    file.out().text(";\n}");
  });
}

} // namespace detail

DOVETAIL_INLINE std::vector<std::string> openfoam_format::files_of_rank(local_id rank, int ranks) const {
  return detail::foam_mesh_files(rank, ranks,
                                 {"points", "faces", "owner", "neighbour", "boundary", "cellZones"});
}

DOVETAIL_INLINE std::vector<std::string> openfoam_format::outdated_files_of_rank(local_id rank,
                                                                                 int ranks) const {
  return detail::foam_mesh_files(rank, ranks,
                                 {"pointZones", "faceZones", "pointProcAddressing", "faceProcAddressing",
                                  "cellProcAddressing", "boundaryProcAddressing"});
}

DOVETAIL_INLINE std::vector<std::string> openfoam_format::files_of_all() const {
  return {"system/controlDict", "system/decomposeParDict", "system/fvSchemes", "system/fvSolution"};
}

DOVETAIL_INLINE bool openfoam_format::may_replace(const std::filesystem::path& file) const {
  return file.parent_path().filename() != "system" ||
         read_file(file).find(detail::foam_dictionary_note) != std::string::npos;
}

DOVETAIL_INLINE void openfoam_format::write_all(const rank_source<3>& source,
                                                const std::vector<std::filesystem::path>& paths) const {
  // With fewer digits reconstructParMesh, which reads them again, does not find the points of processors
  // equal.
  const std::string control = "application checkMesh;\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\n"
                              "endTime 1;\ndeltaT 1;\nwriteControl timeStep;\nwriteInterval 1;\n"
                              "writeFormat ascii;\nwritePrecision 16;\n";
  const std::string parts =
      "numberOfSubdomains " + std::to_string(source.numbers.ranks()) + ";\nmethod scotch;\n";
  const std::string schemes = "ddtSchemes { default steadyState; }\ngradSchemes { default Gauss linear; }\n"
                              "divSchemes { default none; }\n"
                              "laplacianSchemes { default Gauss linear corrected; }\n"
                              "interpolationSchemes { default linear; }\n"
                              "snGradSchemes { default corrected; }\n";
  const std::string solution = "solvers {}\n";
  const std::array contents{&control, &parts, &schemes, &solution}; // as in `files_of_all`
  for (std::size_t k = 0; k < contents.size(); ++k) {
    const auto object = std::filesystem::path(files_of_all()[k]).filename().string();
    detail::foam_file file(paths[k], "dictionary", object, detail::foam_dictionary_note, "system");
    file.out().text(*contents[k]);
    file.out().commit();
  }
}

DOVETAIL_INLINE void openfoam_format::write(const rank_source<3>& source, const rank_mesh<3>& rank,
                                            const std::vector<std::filesystem::path>& paths) const {
  const auto patches = detail::collect_foam_patches(source.mesh);
  const auto faces = detail::number_foam_faces(rank, patches);
  const auto write_file = [&](std::size_t which, const std::string& kind, const std::string& object,
                              const std::string& note, const auto& write) {
    detail::foam_file file(paths[which], kind, object, note);
    write(file);
    file.out().commit();
  };
  const auto triple = [](output_file& out, const auto& values) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.text(k == 0 ? "(" : " ");
      out.number(values[k]);
    }
    out.text(")");
  };
  write_file(0, "vectorField", "points", "", [&](auto& file) {
    file.list(rank.held_vertices, [&](std::size_t v) {
      const vec3 p = rank.mesh.points[v];
      triple(file.out(), std::array{p.x, p.y, p.z});
    });
  });
  write_file(1, "faceList", "faces", "", [&](auto& file) {
    file.list(faces.vertices.size(), [&](std::size_t f) {
      file.out().text("3");
      triple(file.out(), faces.vertices[f]);
    });
  });
  const std::string note = "nPoints:" + std::to_string(rank.held_vertices) +
                           "  nCells:" + std::to_string(rank.owned_elements) +
                           "  nFaces:" + std::to_string(faces.owners.size()) +
                           "  nInternalFaces:" + std::to_string(faces.neighbours.size());
  write_file(2, "labelList", "owner", note, [&](auto& file) { file.labels(faces.owners); });
  write_file(3, "labelList", "neighbour", note, [&](auto& file) { file.labels(faces.neighbours); });
  write_file(4, "polyBoundaryMesh", "boundary", "",
             [&](auto& file) { detail::write_foam_boundary(file, rank, patches, faces); });
  write_file(5, "regIOobject", "cellZones", "",
             [&](auto& file) { detail::write_foam_zones(file, rank, collect_material_names(source.mesh)); });
}

} // namespace dovetail::io
