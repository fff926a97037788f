/// An operation of one's own in the native improver, used by the whole pipeline.
/// Usage: c05_custom_operation FILE
#include "dovetail/improver/native_by.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <array>
#include <cstdio>

// for the readme
using namespace dovetail::improvement;

/// Moves a vertex of a poor element to the mean of the vertices around it.
template <shape_measure Measure>
class centering {
public:
  static constexpr std::array names{"centering"};
  static constexpr turn when = turn::always;

  bool mend(tet_complex& mesh, dovetail::local_id e, const operation_limits<3>& limits,
            const recorded_tries& tries) {
    for (const dovetail::local_id v : mesh.vertices(e))
      if (mesh.is_free(v) && tries([&] { return improve(mesh, v, limits.band); }))
        return true;
    return false;
  }

private:
  bool improve(tet_complex& mesh, dovetail::local_id v, const size_band& band) {
    if (!star_.start(mesh, v))
      return false;
    dovetail::vec3 sum{};
    for (const dovetail::local_id e : star_.elements())
      for (const dovetail::vec3 corner : star_.opposite_side(mesh, e))
        sum += corner;
    const double corners = 3.0 * star_.elements().size;
    return star_.move(mesh, sum / corners, {.worst = star_.worst(mesh)}, band); // refuses what is worse
  }

  star_move<Measure> star_;
};

/// Tried after those that the improver has anyway.
struct my_operations : native_operations {
  template <shape_measure Measure>
  using on_tetrahedra = typename native_operations::on_tetrahedra<Measure>::template with<centering<Measure>>;
};
// end

int main(int argc, char** argv) try {
  using namespace dovetail;
  const auto model = read_occt_model(argc > 1 ? argv[1] : "").model;
  const auto given = parameters<>{}.with_improver(native_by<my_operations>{native::fine()});
  const auto result = generate<3>(model, uniform_size(model.bounds().diagonal() / 25), given);
  std::printf("smallest dihedral angle: %.1f degrees\n", result.quality.min_dihedral_deg);
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
