/// @file
/// Any plain value as bytes and back: how results travel between processes and lie on the disk. What a type
/// is made of it says once (`core/fields.hpp`).
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// A type that knows its own bytes, where these are not those of its fields.
template <class T>
concept encodes_itself = requires(byte_writer& to, byte_reader& from, const T& item) {
  item.encode(to);
  { T::decode(from) } -> std::same_as<T>;
};
/// Whole numbers of 64 bits, which are mostly small counts: seven bits to a byte.
template <class T>
concept wide_integer = std::integral<T> && sizeof(T) == 8;

/// Its bytes are those in memory, and an array of them is copied as a whole.
template <class T>
concept plain_bytes =
    std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T> && !std::is_pointer_v<T>;

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};
template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};
/// Pairs, tuples and arrays.
template <class T>
concept tuple_like = requires {
  std::tuple_size<T>::value;
};
template <class T>
constexpr bool can_be_encoded();

template <class... Fields>
constexpr bool can_encode_members(std::type_identity<std::tuple<Fields...>>) {
  return (can_be_encoded<Fields>() && ...);
}
template <class T, class Field>
constexpr bool can_encode_field() {
  return std::same_as<Field, std::vector<T>> || can_be_encoded<Field>(); // a tree has itself
}
template <class T, auto... Members>
constexpr bool can_encode_fields(field_list<Members...>) {
  return (can_encode_field<T, std::remove_cvref_t<decltype(std::declval<T&>().*Members)>>() && ...);
}

template <class T>
constexpr bool can_be_encoded() {
  if constexpr (encodes_itself<T> || std::same_as<T, std::string> || std::same_as<T, std::filesystem::path>)
    return true;
  else if constexpr (has_fields<T>)
    return can_encode_fields<T>(typename T::fields{});
  else if constexpr (is_vector<T>::value || is_optional<T>::value)
    return can_be_encoded<typename T::value_type>();
  else if constexpr (plain_bytes<T>)
    return true;
  else if constexpr (requires { typename T::first_type; })
    return can_be_encoded<typename T::first_type>() && can_be_encoded<typename T::second_type>();
  else if constexpr (tuple_like<T> && requires { typename T::value_type; })
    return can_be_encoded<typename T::value_type>();
  else if constexpr (tuple_like<T>)
    return can_encode_members(std::type_identity<T>{});
  else
    return false;
}

/// -1, which is "none", is as short as 1.
template <wide_integer T>
std::uint64_t folded(T number) {
  const auto bits = static_cast<std::uint64_t>(number);
  return std::signed_integral<T> ? (bits << 1) ^ (~(bits >> 63) + 1) : bits;
}
template <wide_integer T>
T unfolded(std::uint64_t bits) {
  return static_cast<T>(std::signed_integral<T> ? (bits >> 1) ^ (~(bits & 1) + 1) : bits);
}

} // namespace detail

/// A type of which values can be sent: numbers, texts, what is trivially copyable, types with `fields`, and
/// vectors, arrays, pairs, tuples and optional ones of these; or one with its own `item.encode(to)` and
/// `T::decode(from)`.
template <class T>
concept encodable = detail::can_be_encoded<T>();

/// Appends a value to bytes. Linear in its size.
template <encodable T>
void encode(byte_writer& to, const T& item) {
  if constexpr (detail::encodes_itself<T>) {
    item.encode(to);
  } else if constexpr (std::same_as<T, std::string>) {
    to.text(item);
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    encode(to, item.string());
  } else if constexpr (has_fields<T>) {
    for_each_field(item, [&](const auto& field) { encode(to, field); });
  } else if constexpr (detail::is_vector<T>::value) {
    if constexpr (detail::plain_bytes<typename T::value_type>) {
      to.array(item);
    } else {
      to.count(item.size());
      for (const auto& each : item)
        encode(to, each);
    }
  } else if constexpr (detail::is_optional<T>::value) {
    to.value(static_cast<std::uint8_t>(item.has_value()));
    if (item)
      encode(to, *item);
  } else if constexpr (detail::wide_integer<T>) {
    to.count(detail::folded(item));
  } else if constexpr (!detail::plain_bytes<T>) {
    std::apply([&](const auto&... each) { (encode(to, each), ...); }, item);
  } else {
    to.value(item);
  }
}

/// The value that `encode` appended. Throws `input_error` when the data end early.
template <encodable T>
T decode(byte_reader& from) {
  if constexpr (detail::encodes_itself<T>) {
    return T::decode(from);
  } else if constexpr (std::same_as<T, std::string>) {
    return from.text();
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    return decode<std::string>(from);
  } else if constexpr (has_fields<T>) {
    T item{};
    for_each_field(item, [&](auto& field) { field = decode<std::remove_cvref_t<decltype(field)>>(from); });
    return item;
  } else if constexpr (detail::is_vector<T>::value) {
    if constexpr (detail::plain_bytes<typename T::value_type>) {
      return from.array<typename T::value_type>();
    } else {
      T items;
      for (std::uint64_t left = from.count(); left > 0; --left)
        items.push_back(decode<typename T::value_type>(from));
      return items;
    }
  } else if constexpr (detail::is_optional<T>::value) {
    if (from.value<std::uint8_t>() == 0)
      return std::nullopt;
    return decode<typename T::value_type>(from);
  } else if constexpr (detail::wide_integer<T>) {
    return detail::unfolded<T>(from.count());
  } else if constexpr (!detail::plain_bytes<T>) {
    T item;
    std::apply([&](auto&... each) { ((each = decode<std::remove_cvref_t<decltype(each)>>(from)), ...); },
               item);
    return item;
  } else {
    return from.value<T>();
  }
}

/// A value as bytes.
template <encodable T>
byte_buffer encoded(const T& item) {
  byte_writer to;
  encode(to, item);
  return to.take();
}
/// The value of bytes; throws `input_error` unless they are those of one.
template <encodable T>
T decoded(const byte_buffer& bytes) {
  byte_reader from(bytes);
  return decode<T>(from);
}

} // namespace dovetail
