/// @file
/// The background mesh as bytes: in the spool of a run, where a resumed run finds it, or to be sent to those
/// who share no memory with the one who made it. A sizing field is a function and stays with the caller; what
/// the surface asks of it are data.
#pragma once

#include "dovetail/core/report_codec.hpp"
#include "dovetail/mesh/mesh_codec.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/pipeline/background.hpp"

#include <optional>

namespace dovetail {

template <int D>
byte_buffer encode(const background_result<D>& background) {
  byte_writer to;
  encode(to, background.mesh);
  to.value(background.plan);
  to.array(background.bounds);
  encode(to, background.summary);
  return to.take();
}

/// Reads back what `encode` wrote, for the field that it was made by. Throws `input_error` when the data end
/// early.
template <int D>
background_result<D> decode_background_result(const byte_buffer& bytes, const erased_sizing& size) {
  byte_reader from(bytes);
  background_result<D> background;
  background.mesh = decode_background<D>(from);
  background.plan = from.value<mesh_plan>();
  background.bounds = from.array<size_ball>();
  background.size = allowed_size<D>(enlarged(size, background.plan), background.bounds);
  background.summary = decode_report(from);
  return background;
}

namespace detail {

/// All that it is a function of is in the identity of the spool. Model and sizes are looked at here too, for
/// an identity that forgets them.
inline content_key background_key(int dimension, const any_geometry& model, const erased_sizing& size) {
  const box3 box = model.bounds();
  key_maker make;
  make(std::int64_t{dimension})(static_cast<std::int64_t>(model.topology().faces.size()));
  for (const vec3 p : {box.lower, box.center(), box.upper})
    make(p.x)(p.y)(p.z)(size(p));
  return make.key();
}

} // namespace detail

/// The background mesh that an earlier run of the spool's identity has kept; "kept" in its summary says so.
/// All ranks have what the one finds that leads.
template <int D>
std::optional<background_result<D>> find_background(const std::optional<spool>& disk,
                                                    const any_geometry& model, const erased_sizing& size,
                                                    const any_executor& run) {
  const stopwatch clock;
  if (!disk)
    return std::nullopt;
  const byte_buffer bytes = run.once([&] {
    return entity_store(disk, "background")
        .find(detail::background_key(D, model, size))
        .value_or(byte_buffer{});
  });
  if (bytes.empty())
    return std::nullopt;
  auto found = decode_background_result<D>(bytes, size);
  found.summary.seconds = clock.seconds(); // of this run
  found.summary.set("kept", 1);
  return found;
}

/// Puts a background mesh into the spool, if there is one.
template <int D>
void keep_background(const std::optional<spool>& disk, const any_geometry& model, const erased_sizing& size,
                     const background_result<D>& background, const any_executor& run) {
  if (disk && run.leads())
    entity_store(disk, "background").keep(detail::background_key(D, model, size), encode(background));
}

} // namespace dovetail
