/// @file
/// One description of the fields of a type, from which its bytes follow (`core/encoding.hpp`), and the
/// counters of a report (`core/report.hpp`).
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

namespace dovetail {

/// Pointers to the members of a type, in the order of its bytes.
template <auto... Members>
struct field_list {};

namespace detail {

template <class T>
struct is_field_list : std::false_type {};
template <auto... Members>
struct is_field_list<field_list<Members...>> : std::true_type {};

template <class T, class Visit, auto... Members>
constexpr void visit_fields(T& item, const Visit& visit, field_list<Members...>) {
  (visit(item.*Members), ...);
}

/// The name of a member, which g++ and clang tell of a template's argument: "... Member = &type::name; ...".
template <auto Member>
consteval std::string_view field_name() {
  std::string_view name = __PRETTY_FUNCTION__;
  name.remove_prefix(name.rfind("Member = ") + 9);
  name = name.substr(0, name.find_first_of(";]"));
  return name.substr(name.rfind(':') + 1);
}

template <class T, class Visit, auto... Members>
constexpr void visit_named_fields(T& item, const Visit& visit, field_list<Members...>) {
  (visit(field_name<Members>(), item.*Members), ...);
}

} // namespace detail

/// A type that lists its fields:
///
///     struct reply {
///       local_id piece = no_id;
///       std::vector<vec3> points;
///       using fields = field_list<&reply::piece, &reply::points>;
///     };
///
/// A field that follows from the others may be left out.
template <class T>
concept has_fields = std::default_initializable<T> && detail::is_field_list<typename T::fields>::value;

/// Calls `visit(field)` for each field of `item`, in the order of their list.
template <class T, class Visit>
  requires has_fields<std::remove_const_t<T>>
constexpr void for_each_field(T& item, const Visit& visit) {
  detail::visit_fields(item, visit, typename std::remove_const_t<T>::fields{});
}

/// Calls `visit(name, field)` for each field of `item`, in the order of their list.
template <class T, class Visit>
  requires has_fields<std::remove_const_t<T>>
constexpr void for_each_named_field(T& item, const Visit& visit) {
  detail::visit_named_fields(item, visit, typename std::remove_const_t<T>::fields{});
}

} // namespace dovetail
