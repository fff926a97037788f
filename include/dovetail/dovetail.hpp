/// @file
/// The whole library in pipeline order, without the adapters of third-party libraries (OCCT, TetGen, METIS,
/// Gmsh, JSON): include those you use beside it.
#pragma once

// The model and the sizes.
#include "dovetail/geometry/discrete_model.hpp"
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
#include "dovetail/decomposition/interface_contract.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"

// The skeleton, remeshed, without crossings.
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/subdomain_surface.hpp"

// The subdomains, meshed and improved in parallel.
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/mesh_subdomains.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"

// All of it.
#include "dovetail/pipeline/generate.hpp"

// Files.
#include "dovetail/io/distributed_statistics.hpp"
#include "dovetail/io/distributed_validity.hpp"
#include "dovetail/io/mesh_hash.hpp"
#include "dovetail/io/msh_writer.hpp"
#include "dovetail/io/png_output.hpp"
#include "dovetail/io/raster_render.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/vtu_writer.hpp"
