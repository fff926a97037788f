/// @file
/// The Hilbert curve through a square or a cube: cells that follow each other on it share a side, so what is
/// close in its order is close in space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dovetail {

namespace detail {

/// The curve as an automaton that is fed the quadrants (octants) of a cell from the largest to the smallest.
/// A state is the corner at which the curve enters the quadrant and the axis along which it leaves:
/// C. Hamilton, "Compact Hilbert Indices" (Dalhousie University, CS-2006-07).
template <std::size_t Axes>
class hilbert_automaton {
public:
  struct step {
    std::uint8_t next, place; ///< state; rank of the quadrant on the curve through its siblings
  };

  constexpr hilbert_automaton() {
    for (unsigned state = 0; state < states; ++state)
      for (unsigned quadrant = 0; quadrant < quadrants; ++quadrant)
        steps_[quadrants * state + quadrant] = step_of(state, quadrant);
  }
  constexpr step operator()(unsigned state, unsigned quadrant) const {
    return steps_[quadrants * state + quadrant];
  }

private:
  static constexpr unsigned axes = Axes, quadrants = 1U << axes, states = quadrants * axes;

  static constexpr step step_of(unsigned state, unsigned quadrant) {
    const unsigned entry = state / axes, axis = state % axes, turn = (axis + 1) % axes;
    const unsigned place = inverse_gray(rotated(quadrant ^ entry, axes - turn));
    const unsigned next_entry = entry ^ rotated(entry_of(place), turn);
    const unsigned next_axis = (axis + axis_of(place) + 1) % axes;
    return {static_cast<std::uint8_t>(axes * next_entry + next_axis), static_cast<std::uint8_t>(place)};
  }
  static constexpr unsigned gray(unsigned i) { return i ^ (i >> 1U); }
  static constexpr unsigned inverse_gray(unsigned g) {
    unsigned i = 0;
    for (; g != 0; g >>= 1U)
      i ^= g;
    return i;
  }
  /// The lowest bits, one per axis, turned to the left.
  static constexpr unsigned rotated(unsigned bits, unsigned by) {
    return ((bits << by) | (bits >> (axes - by))) & (quadrants - 1);
  }
  static constexpr unsigned entry_of(unsigned place) { return place == 0 ? 0 : gray((place - 1) & ~1U); }
  static constexpr unsigned axis_of(unsigned place) {
    unsigned ones = place == 0 ? 0 : place % 2 == 0 ? place - 1 : place;
    unsigned trailing = 0;
    for (; (ones & 1U) != 0; ones >>= 1U)
      ++trailing;
    return trailing % axes;
  }

  std::array<step, std::size_t{quadrants} * states> steps_{};
};

template <std::size_t Axes>
inline constexpr hilbert_automaton<Axes> hilbert_steps;

} // namespace detail

/// The place along the Hilbert curve of a cell in a grid of 2^bits cells per axis; `bits` times the number of
/// axes is at most 64. O(bits).
/// \param cell the cell's number along each axis, from 0
template <std::size_t Axes>
  requires(Axes == 2 || Axes == 3)
constexpr std::uint64_t hilbert_place(const std::array<std::uint32_t, Axes>& cell, int bits) {
  std::uint64_t place = 0;
  unsigned state = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    unsigned quadrant = 0;
    for (std::size_t k = 0; k < Axes; ++k)
      quadrant |= (cell[k] >> bit & 1U) << k;
    const auto [next, rank] = detail::hilbert_steps<Axes>(state, quadrant);
    state = next;
    place = place << Axes | rank;
  }
  return place;
}

} // namespace dovetail
