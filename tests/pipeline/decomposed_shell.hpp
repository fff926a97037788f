#pragma once

#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/rounds.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopoDS_Shape.hxx>

namespace dovetail::testing {

/// A thin shell: its two faces, and interfaces between them, come near to each other.
inline any_geometry shell(double inner_radius) {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  return any_geometry(
      occt_shape_from(BRepAlgoAPI_Cut(ball, BRepPrimAPI_MakeSphere(inner_radius).Shape()).Shape()).model);
}

/// A scale of the background that is given, so that it does not regard walls: interfaces among flat elements
/// of a thin shell cross.
inline constexpr double flat_in_shells = 1.5;

/// A decomposed coarse mesh of the shell, before anything is realized.
struct decomposed_shell {
  decomposed_shell(double inner_radius, int parts) : decomposed_shell(shell(inner_radius), parts) {}
  decomposed_shell(const any_geometry& shape, int parts)
      : model(shape), given(parameters<>{}
                                .with_mesher(mesher::tetgen{})
                                .with_options({.subdomains = parts, .coarse_scale = flat_in_shells})),
        background(make_background<3>(model, uniform_size(0.2), given)) {
    const simplicial_mesh<3>& volume = background.mesh.volume;
    divided.sides = build_sides(volume);
    divided.beside_surface = elements_beside_surface(background.mesh, divided.sides);
    const auto simplified = simplify<3>(volume, mesh_duals<3>(volume, sides), simplifier::none{});
    divided.side_states = simplified.side_states;
    divided.pieces = decompose<3>(volume, sides, simplified.super_of_element, simplified.graph, volume.tags,
                                  given.partition_it, parts);
    want(1e-3); // interfaces stay where they are
  }

  /// A rule that wants such interface angles; nothing is simplified by it any more.
  void want(double angle_deg) {
    given.simplify_by = simplifier::paper{.volume_dihedral_deg = angle_deg, .volume_shape_deg = angle_deg};
  }

  /// The rounds, of which so large a fraction of the subdomains may be merged.
  decomposition_rounds<3, any_parameters<3>> rounds(double largest_merged_fraction) {
    given.options.largest_merged_fraction = largest_merged_fraction;
    return {model, background.mesh, divided, background.size, given};
  }

  any_geometry model;
  any_parameters<3> given;
  background_result<3> background;
  divided_background<3> divided;
  const side_table<3>& sides = divided.sides;
  decomposition& pieces = divided.pieces;
};

} // namespace dovetail::testing
