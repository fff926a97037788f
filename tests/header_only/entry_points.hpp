// What most programs include.
#pragma once

#include "dovetail/dovetail.hpp"
#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/geometry/discrete_model.hpp"
#include "dovetail/geometry/discrete_read.hpp"
#include "dovetail/geometry/implicit_model.hpp"
#include "dovetail/geometry/implicit_shapes.hpp"
#include "dovetail/geometry/occt_triangulation.hpp"
#include "dovetail/geometry/plane_domain.hpp"
#include "dovetail/geometry/plane_read.hpp"
#include "dovetail/io/msh_writer.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/write_msh.hpp"
#include "dovetail/io/write_surface.hpp"
#include "dovetail/io/write_vtu.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/partition/metis.hpp"
