/// Section 3.6 of the paper, and the meshing of section 4: what crosses among remeshed boundaries is found by
/// an octree and suppressed by merging subdomains; the pieces are meshed in parallel. Without a model: a thin
/// pipe in D = 3. Usage: p5_pieces [MODEL.brep|step|stl [SIZE]]
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/rounds.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "paper_model.hpp"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace dovetail;

// part suppress
/// By hand, as long as something crosses and a merge helps. Lines and patches that a merge leaves as they are
/// stay in `made` from round to round.
void suppress(const any_geometry& model, const background_result<3>& background,
              const divided_background<3>& divided, const any_parameters<3>& given) {
  std::vector<local_id> subdomain_of_element = divided.pieces.part_of_element;
  std::vector<local_id> members(static_cast<std::size_t>(divided.pieces.parts), 1); // parts per subdomain
  skeleton_memo made;
  for (;;) {
    const auto skeleton = realize<3>(model, background.mesh, divided, subdomain_of_element, members.size(),
                                     background.size, made, given);
    const std::vector<bool> planar(skeleton.fine.sides.size(), false); // all are searched
    const suppression_plan plan = plan_suppression(skeleton.fine, planar, given.run_tasks);
    std::printf("  %zu subdomains: %zu pairs of %zu triangles cross, %zu pairs of subdomains to merge\n",
                members.size(), plan.crossings, skeleton.fine.sides.size(), plan.merges.size());
    if (plan.merges.empty())
      return;
    merge_subdomains(subdomain_of_element, members, plan.merges);
  }
}
// end

template <int D>
void show(int argc, char** argv) {
  const any_geometry model =
      D == 3 && argc < 2 ? any_geometry(paper::thin_pipe()) : paper::model<D>(argc, argv);
  const double size = D == 3 && argc < 2 ? 0.1 : paper::size<D>(argc, argv, model);
  const auto given = bind_parameters<D>(
      parameters<>{}
          .with_executor(parallel::threads{})
          .with_options({.subdomains = 24, .coarse_scale = 4, .largest_merged_fraction = 0.25}));
  const auto background = make_background<D>(model, uniform_size(size), given);
  const auto divided = divide<D>(background.mesh, background.size, 24, given);
  std::printf("D = %d\n", D);
  if constexpr (D == 3)
    suppress(model, background, divided, given);
  // part pieces
  decomposition_rounds<D, any_parameters<D>> rounds(model, background.mesh, divided, background.size, given);
  const auto made = rounds.mesh_pieces(); // nothing where too many would have to be merged
  if (!made)
    throw intersection_error(rounds.too_many_merges());
  const auto& [skeleton, meshed] = *made;
  std::printf("  %zu pieces, %lld elements; %.0f crossings, %.0f merges\n", meshed.pieces.size(),
              static_cast<long long>(meshed.quality.elements), rounds.intersection().get("crossings"),
              rounds.intersection().get("merges"));

  simplicial_mesh<D> whole{{skeleton.fine.points.begin(), skeleton.fine.points.end()}, {}, {}};
  std::vector<local_id> piece_of_element;
  for (std::size_t p = 0; p < meshed.pieces.size(); ++p) {
    append_piece(whole, meshed.load(static_cast<local_id>(p)));
    piece_of_element.resize(whole.elements.size(), static_cast<local_id>(p));
  }
  whole.tags = piece_of_element;
  io::write_vtu(whole, "p5_" + std::to_string(D) + "d.vtu");
  // end
}

} // namespace

int main(int argc, char** argv) try {
  show<2>(argc, argv);
  show<3>(argc, argv);
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
