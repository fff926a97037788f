#include "run_identity.hpp"

#include "build_identity.hpp"
#include "file_checksums.hpp"
#include "named_policies.hpp"
#include "policies.hpp"
#include "run_setup.hpp"

#include "dovetail/core/hash.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace dovetail::app {

std::string all_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string values_of_field(const any_sizing& size, const box3& box) {
  constexpr std::array<double, 3> steps{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  constexpr int samples = 4096;
  const vec3 extent = box.upper - box.lower;
  content_hash hash;
  for (int i = 0; i < samples; ++i) {
    vec3 p = box.lower;
    for (int axis = 0; axis < 3; ++axis) {
      const double t = i * steps[axis];
      p[axis] += (t - std::floor(t)) * extent[axis];
    }
    hash.number(size(p));
  }
  return hexadecimal(hash.value());
}

run_identity identity_of_run(const mesh_options& options, const model_source& source) {
  run_identity identity{{"model", source.name}};
  const run_identity build = identity_of_build();
  identity.insert(identity.end(), build.begin(), build.end());
  if (!options.model.input.empty()) {
    identity.emplace_back("file", source.file);
    identity.emplace_back("unit", options.model.unit);
    identity.emplace_back("joined", options.model.join ? all_digits(*options.model.join) : "default");
  }
  identity.emplace_back("suppressed", options.model.keep_all   ? "nothing"
                                      : options.model.suppress ? all_digits(*options.model.suppress)
                                                               : "default");
  if (!source.sizing.empty())
    identity.emplace_back("sizing", source.sizing);
  if (!source.sizing_meshes.empty())
    identity.emplace_back("meshes of the sizing", source.sizing_meshes);
  identity.emplace_back("sizes", values_of_field(source.size, source.geometry.bounds()));
  const generate_options numbers = make_generate_options(options);
  identity.emplace_back("enlarged above", all_digits(numbers.enlarged_above));
  identity.emplace_back("undivided elements", all_digits(numbers.undivided_elements));
  identity.emplace_back("least subdomains", std::to_string(numbers.least_subdomains));
  identity.emplace_back("subdomains", options.subdomains ? std::to_string(*options.subdomains) : "default");
  std::string only = numbers.only.empty() ? "all" : "";
  for (const local_id subdomain : numbers.only)
    only.append(std::to_string(subdomain)).append(",");
  identity.emplace_back("only", only);
  if (options.alone)
    identity.emplace_back("alone", "yes");
  identity.emplace_back("coarsening", options.coarsening ? all_digits(*options.coarsening) : "default");
  identity.emplace_back("decomposition",
                        chosen_name(decomposition_names(), options.decomposition, "--decomposition"));
  identity.emplace_back("dimension", std::to_string(options.dimension));
  identity.emplace_back("order", std::to_string(options.order));
  identity.emplace_back("mesher", options.dimension == 3 ? make_mesher<3>(options.mesher).name()
                                                         : make_mesher<2>(options.mesher).name());
  identity.emplace_back("background mesher", make_background_mesher(options.background_mesher).name());
  identity.emplace_back("background improver",
                        options.background_improver.empty() ? "default" : options.background_improver);
  identity.emplace_back("surface mesher", make_surface_mesher(options.surface_mesher).name());
  identity.emplace_back("partitioner", make_partitioner(options.partitioner).name());
  identity.emplace_back(
      "simplifier", make_simplifier(options.simplifier, options.dihedral_angle, options.dimension).name());
  for (const auto& [what, choice] : {std::pair("weights", &mesh_options::weights),
                                     {"super-element bound", &mesh_options::super_element_bound},
                                     {"segment matching", &mesh_options::segment_matching},
                                     {"local repartition", &mesh_options::local_repartition}})
    identity.emplace_back(what, (options.*choice).empty() ? "default" : options.*choice);
  identity.emplace_back("improver", make_improver<3>(options.improver).name());
  return identity;
}

} // namespace dovetail::app
