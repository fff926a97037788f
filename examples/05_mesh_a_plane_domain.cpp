// A plane domain with a hole, meshed with triangles in parallel and written for ParaView.
#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cstdio>

int main() {
  using namespace dovetail;
  const auto drawing = drawing_from_svg_path("M0 0 H30 V20 H0 Z M8 10 a4 4 0 1 0 8 0 a4 4 0 1 0 -8 0 Z");
  const plane_domain domain(drawing);
  const auto result =
      generate<2>(domain, uniform_size(0.2), parameters<>{}.with_executor(parallel::processes{}));
  io::vtu_writer{}(result.mesh, "plane");
  std::printf("%lld triangles, smallest angle %.1f degrees\n",
              static_cast<long long>(result.quality.elements), result.quality.min_dihedral_deg);
}
