// near miss 1: a mesher without traits
// first error 1: mesher::wraps holds a piece_mesher
// near miss 2: an improver without a call
// first error 2: improvement::wraps holds an improver
// near miss 3: a writer without a call
// first error 3: io::wraps holds a mesh_writer
// near miss 4: a rule without penalties
// first error 4: simplifier::wraps holds a simplification_rule
// near miss 5: a redistributor without a call
// first error 5: redistribution_by::wraps holds a redistributor
// near miss 6: a format without files
// first error 6: format_wraps holds a rank_format or a shared_rank_format
// near miss 7: a solver's ranks in such a format
// first error 7: rank_writer takes a rank_format or a shared_rank_format
// near miss 8: sizes to adapt to that are none
// first error 8: adapt<D> takes a size for each point, or a sizing_field
// near miss 9: a partitioner without a call
// first error 9: partition::wraps holds a graph_partitioner
// near miss 10: an executor that runs nothing
// first error 10: parallel::wraps holds an executor
// near miss 11: a surface mesher without a call
// first error 11: remesh::wraps holds a surface_mesher
// near miss 12: a model without topology
// first error 12: model_wraps holds a geometry_model
// near miss 13: sizes that are none
// first error 13: sizing::wraps holds a sizing_field
// near miss 14: a mesher that derives from the base of another one
// first error 14: derives from wraps<Self, Policy> with another Self
// near miss 15: an improver that does
// first error 15: derives from wraps<Self, Policy> with another Self
// near miss 16: a partitioner that does
// first error 16: derives from wraps<Self, Policy> with another Self
// near miss 17: a surface mesher that does
// first error 17: derives from wraps<Self, Policy> with another Self
#include "dovetail/distributed/wraps.hpp"
#include "dovetail/files/wraps.hpp"
#include "dovetail/geometry/wraps.hpp"
#include "dovetail/improver/wraps.hpp"
#include "dovetail/mesher/wraps.hpp"
#include "dovetail/parallel/wraps.hpp"
#include "dovetail/partition/wraps.hpp"
#include "dovetail/remesh/wraps.hpp"
#include "dovetail/simplification/wraps.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/sizing/wraps.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/wraps.hpp"

using namespace dovetail;

struct nothing {};
template <class P>
struct my_mesher : mesher::wraps<my_mesher<P>, P> {};
template <class P>
struct my_improver : improvement::wraps<my_improver<P>, P> {};
template <class P>
struct my_writer : io::wraps<my_writer<P>, P> {};
template <class P>
struct my_rule : simplifier::wraps<my_rule<P>, P> {};
template <class P>
struct my_redistributor : redistribution_by::wraps<my_redistributor<P>, P> {};
template <class P>
struct my_format : io::format_wraps<my_format<P>, P> {};
template <class P>
struct my_partitioner : partition::wraps<my_partitioner<P>, P> {};
template <class P>
struct my_executor : parallel::wraps<my_executor<P>, P> {};
template <class P>
struct my_surface_mesher : remesh::wraps<my_surface_mesher<P>, P> {};
template <class P>
struct my_model : model_wraps<my_model<P>, P> {};
template <class P>
struct my_size : sizing::wraps<my_size<P>, P> {};

struct copied_mesher : mesher::wraps<my_mesher<mesher::native>, mesher::native> {};
struct copied_improver : improvement::wraps<my_improver<improvement::native>, improvement::native> {};
struct copied_partitioner : partition::wraps<my_partitioner<partition::greedy>, partition::greedy> {};
struct copied_surface_mesher
    : remesh::wraps<my_surface_mesher<remesh::patch_remesher>, remesh::patch_remesher> {};

void call(const adaptable_mesh<3>& mesh) {
#if NEAR_MISS == 1
  my_mesher<nothing>{};
#elif NEAR_MISS == 2
  my_improver<nothing>{};
#elif NEAR_MISS == 3
  my_writer<nothing>{};
#elif NEAR_MISS == 4
  my_rule<nothing>{};
#elif NEAR_MISS == 5
  my_redistributor<nothing>{};
#elif NEAR_MISS == 6
  my_format<nothing>{};
#elif NEAR_MISS == 7
  io::rank_writer<nothing>{};
#elif NEAR_MISS == 8
  adapt<3>(mesh, nothing{}, parameters<>{});
#elif NEAR_MISS == 9
  my_partitioner<nothing>{};
#elif NEAR_MISS == 10
  my_executor<nothing>{};
#elif NEAR_MISS == 11
  my_surface_mesher<nothing>{};
#elif NEAR_MISS == 12
  my_model<nothing>{};
#elif NEAR_MISS == 13
  my_size<nothing>{};
#elif NEAR_MISS == 14
  parameters<>{}.with_mesher(copied_mesher{});
#elif NEAR_MISS == 15
  parameters<>{}.with_improver(copied_improver{});
#elif NEAR_MISS == 16
  parameters<>{}.with_partitioner(copied_partitioner{});
#elif NEAR_MISS == 17
  parameters<>{}.with_surface_mesher(copied_surface_mesher{});
#else
  parameters<>{}
      .with_mesher(my_mesher<mesher::native>{})
      .with_improver(my_improver<improvement::native>{})
      .with_partitioner(my_partitioner<partition::greedy>{})
      .with_surface_mesher(my_surface_mesher<remesh::patch_remesher>{});
  adapt<3>(mesh, uniform_size(1), parameters<>{});
#endif
}
