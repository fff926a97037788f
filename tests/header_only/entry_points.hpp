// What most programs include.
#pragma once

#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/dovetail.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/write_msh.hpp"
#include "dovetail/files/write_surface.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/models/plane_domain.hpp"
