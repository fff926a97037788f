/// @file
/// The pipeline's stages in their order. Beside it, include what you choose: a geometry (occt_model,
/// discrete_model, plane_domain, implicit_model), adapters of libraries (TetGen, METIS, Gmsh, ...), ranks as
/// threads (in_process), readers and further writers. It must stay cheap to include: with the compiled
/// library at most 450 MB with g++ 12, which a test checks.
#pragma once

// The sizes.
#include "dovetail/sizing/background.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/sizing/volume_prediction.hpp"

// The background mesh, simplified and decomposed.
#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/aspect_ratio.hpp"
#include "dovetail/simplification/dihedrals_only.hpp"
#include "dovetail/simplification/flow_aligned.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/shape_only.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"

// The skeleton, remeshed, without crossings.
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

// The subdomains, meshed and improved in parallel.
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/parallel/self.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"

// All of it.
#include "dovetail/pipeline/generate.hpp"

// Files.
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
