#include "mesh_digest.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/io/mesh_hash.hpp"

namespace dovetail::app {

template <int D>
std::uint64_t parallel_mesh_hash(const distributed_simplicial_mesh<D>& mesh, const any_executor& executor) {
  const auto numbers = io::number_globally(mesh);
  const auto outcomes =
      executor.run(mesh.counts.size(),
                   [&](std::size_t piece) {
                     io::mesh_hasher hasher;
                     io::hash_piece(hasher, io::load_checked(mesh, static_cast<local_id>(piece)), numbers);
                     byte_writer bytes;
                     bytes.value(hasher);
                     return bytes.take();
                   },
                   {.stage = "hash"});
  io::mesh_hasher whole;
  io::hash_skeleton(whole, mesh.skeleton);
  for (const auto& outcome : outcomes) {
    if (!outcome.ok)
      throw mesh_error("the hash of the mesh could not be taken: " + outcome.failure);
    whole.merge(byte_reader(outcome.result).value<io::mesh_hasher>());
  }
  return whole.value();
}

template std::uint64_t parallel_mesh_hash<2>(const distributed_simplicial_mesh<2>&, const any_executor&);
template std::uint64_t parallel_mesh_hash<3>(const distributed_simplicial_mesh<3>&, const any_executor&);

} // namespace dovetail::app
