/// @file
/// One description of the fields of a type, from which its bytes follow (`core/encoding.hpp`).
#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>

namespace dovetail {

/// A type that lists its fields:
///
///     struct reply {
///       local_id piece = no_id;
///       std::vector<vec3> points;
///       static constexpr auto fields = std::tuple(&reply::piece, &reply::points);
///     };
///
/// A field that follows from the others may be left out.
template <class T>
concept has_fields = std::default_initializable<T> && requires {
  std::tuple_size<std::remove_cvref_t<decltype(T::fields)>>::value;
};

/// Calls `visit(field)` for each field of `item`, in the order of their list.
template <class T, class Visit>
  requires has_fields<std::remove_const_t<T>>
constexpr void for_each_field(T& item, const Visit& visit) {
  std::apply([&](auto... field) { (visit(item.*field), ...); }, std::remove_const_t<T>::fields);
}

} // namespace dovetail
