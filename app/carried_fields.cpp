#include "carried_fields.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/files/vtu_fields.hpp"
#include "dovetail/solver/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dovetail::app {
namespace {

void require_finite(const std::vector<io::mesh_field>& fields, const std::string& of_what,
                    const std::string& file) {
  for (const auto& field : fields) {
    const auto bad = std::find_if_not(field.values.begin(), field.values.end(),
                                      [](double value) { return std::isfinite(value); });
    if (bad != field.values.end())
      throw input_error(file + ": --fields: the values '" + field.name + "' cannot be carried over: " +
                        of_what + " " + std::to_string((bad - field.values.begin()) / field.components) +
                        " has none that is finite; give it one, or leave the array out");
  }
}

/// All fields as one, whose components are theirs: each place is searched for once.
io::mesh_field joined_field(const std::vector<io::mesh_field>& fields, std::size_t places) {
  io::mesh_field all{{}, {}, 0};
  for (const auto& field : fields)
    all.components += field.components;
  all.values.reserve(places * static_cast<std::size_t>(all.components));
  for (std::size_t i = 0; i < places; ++i)
    for (const auto& field : fields) {
      const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(i) * field.components;
      all.values.insert(all.values.end(), first, first + field.components);
    }
  return all;
}
/// The reverse, with the names of `like`.
std::vector<io::mesh_field> parted(const std::vector<double>& all, const std::vector<io::mesh_field>& like) {
  std::vector<io::mesh_field> fields;
  for (const auto& field : like)
    fields.push_back({field.name, {}, field.components});
  for (auto at = all.begin(); at != all.end();)
    for (auto& field : fields) {
      field.values.insert(field.values.end(), at, at + field.components);
      at += field.components;
    }
  return fields;
}

} // namespace

mesh_fields fields_of(const io::loaded_mesh& mesh, const std::string& file) {
  mesh_fields fields;
  for (const auto& array : mesh.point_scalars)
    if (!io::numbers_points(array.name))
      fields.at_points.push_back({array.name, array.values});
  fields.at_points.insert(fields.at_points.end(), mesh.point_fields.begin(), mesh.point_fields.end());
  fields.in_elements = mesh.element_fields;
  if (fields.at_points.empty() && fields.in_elements.empty())
    throw input_error(file + ": --fields: there are no values at points or in elements");
  require_finite(fields.at_points, "point", file);
  require_finite(fields.in_elements, "element", file);
  return fields;
}

std::string in_words(const mesh_fields& fields) {
  std::string text;
  const auto add = [&](const std::vector<io::mesh_field>& some, const char* where) {
    for (const auto& field : some)
      text += (text.empty() ? "'" : ", '") + field.name + "'";
    if (!some.empty())
      text += where;
  };
  add(fields.at_points, " at points");
  add(fields.in_elements, " in elements");
  return text;
}

template <int D>
mesh_fields carried_over(const mesh_fields& fields, const simplicial_mesh<D>& from,
                         const simplicial_mesh<D>& to) {
  mesh_fields carried;
  if (!fields.at_points.empty()) {
    const auto all = joined_field(fields.at_points, from.points.size());
    carried.at_points =
        parted(transferred_to_points<D>(from, all.values, to.points, all.components), fields.at_points);
  }
  if (!fields.in_elements.empty()) {
    const auto all = joined_field(fields.in_elements, from.elements.size());
    carried.in_elements =
        parted(transferred_to_elements<D>(from, all.values, to, all.components), fields.in_elements);
  }
  return carried;
}

template mesh_fields carried_over<2>(const mesh_fields&, const simplicial_mesh<2>&,
                                     const simplicial_mesh<2>&);
template mesh_fields carried_over<3>(const mesh_fields&, const simplicial_mesh<3>&,
                                     const simplicial_mesh<3>&);

} // namespace dovetail::app
