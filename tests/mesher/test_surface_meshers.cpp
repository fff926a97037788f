#include "dovetail/adapters/cgal_surface.hpp"
#include "dovetail/adapters/gmsh_surface.hpp"
#include "dovetail/mesher/native_surface.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "mesher/surface_mesher_contract.hpp"

using namespace dovetail;

TEST_CASE("the native remesher keeps the contract of surface meshers") {
  contract::check_surface_mesher(remesh::patch_remesher{});
}

TEST_CASE("CGAL's Delaunay triangulation keeps the contract of surface meshers") {
  contract::check_surface_mesher(mesher::cgal_delaunay{});
}

TEST_CASE("Gmsh keeps the contract of surface meshers") {
  contract::check_surface_mesher(mesher::gmsh_frontal{});
}

TEST_CASE("pieces: slits, the same in threads, crossing lines as typed errors") {
  static_assert(mesher::native_surface::traits.thread_safe && mesher::cgal_surface::traits.thread_safe);
  static_assert(!mesher::gmsh_surface::traits.thread_safe); // a process per region is forked
  contract::check_pieces(mesher::native_surface{});
  contract::check_pieces(mesher::cgal_surface{});
  contract::check_pieces(mesher::gmsh_surface{});
}

TEST_CASE("edges that another region has are split, whatever the mesher") {
  contract::check_forbidden_chords(mesher::native_surface{});
  contract::check_forbidden_chords(mesher::cgal_surface{});
  contract::check_forbidden_chords(mesher::gmsh_surface{});
}
