/// @file
/// Statistics of the elements at interfaces, beside those of the others: what a decomposition costs in
/// quality shows there first, and drowns in the whole mesh.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/piece_quality.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dovetail {

/// Measures the elements of a piece whose points on interfaces are known. Linear.
/// Throws nothing but for a lack of memory.
/// \param mesh the elements of one subdomain
/// \param on_interface not 0 for points of an interface; one per point of the mesh
template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_mesh<D>& mesh,
                                            const std::vector<std::uint8_t>& on_interface);

/// Measures the elements of a piece. Linear, and n log n in its skeleton points.
/// Throws nothing but for a lack of memory.
/// \param piece as `check_piece` finds it right
/// \param skeleton that of its mesh
/// \param listed the numbers of the skeleton's sides at this piece: `io::sides_by_subdomain`
template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_piece<D>& piece,
                                            const simplicial_skeleton<D>& skeleton,
                                            std::span<const local_id> listed);

/// Both in one pass: `measure_quality`, and `measure_at_interfaces` with the points that are on interfaces.
/// Linear. Throws nothing but for a lack of memory.
/// \param mesh the elements of one subdomain
/// \param on_interface not 0 for points of an interface; the points behind these are on none. Where it is
/// empty, nothing is measured apart
template <int D>
piece_quality measure_piece(const simplicial_mesh<D>& mesh, std::vector<std::uint8_t> on_interface);

#ifdef DOVETAIL_COMPILED
extern template piece_quality measure_piece<2>(const simplicial_mesh<2>& mesh,
                                               std::vector<std::uint8_t> on_interface);
extern template piece_quality measure_piece<3>(const simplicial_mesh<3>& mesh,
                                               std::vector<std::uint8_t> on_interface);
extern template quality_at_interfaces measure_at_interfaces<2>(const simplicial_mesh<2>& mesh,
                                                               const std::vector<std::uint8_t>& on_interface);
extern template quality_at_interfaces measure_at_interfaces<3>(const simplicial_mesh<3>& mesh,
                                                               const std::vector<std::uint8_t>& on_interface);
extern template quality_at_interfaces measure_at_interfaces<2>(const simplicial_piece<2>& piece,
                                                               const simplicial_skeleton<2>& skeleton,
                                                               std::span<const local_id> listed);
extern template quality_at_interfaces measure_at_interfaces<3>(const simplicial_piece<3>& piece,
                                                               const simplicial_skeleton<3>& skeleton,
                                                               std::span<const local_id> listed);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/quality_at_interfaces.ipp"
#endif
