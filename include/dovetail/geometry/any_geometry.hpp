/// @file
/// Any geometry model behind one type, so that the stages are compiled once and not once per kind of model.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/topology_checks.hpp"

#include <cmath>
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace dovetail {

/// Holds any geometry model by value; a geometry model converts to it. Copies of a model that threads may
/// share do share it; of another one they are copies, so that each thread may have its own. A query costs one
/// virtual call more than the model's own. Throws `geometry_error` that names the entity when the topology
/// refers to what is not there, when a query at finite parameters gives a point that is not finite, and for
/// what a model throws that is no error of ours.
class any_geometry {
public:
  template <class G>
    requires(!std::same_as<G, any_geometry> && geometry_model<G>)
  any_geometry(G held); // NOLINT: converts, as std::function does

  any_geometry(const any_geometry& other) : held_(other.thread_safe() ? other.held_ : other.held_->copy()) {}
  any_geometry(any_geometry&&) = default;
  any_geometry& operator=(const any_geometry& other) { return *this = any_geometry(other); }
  any_geometry& operator=(any_geometry&&) = default;
  ~any_geometry() = default;

  const geometry_topology& topology() const { return held_->topology(); }
  vec3 curve_point(local_id c, double t) const { return held_->curve_point(c, t); }
  dovetail::curve_frame curve_frame(local_id c, double t) const { return held_->curve_frame(c, t); }
  vec2 curve_uv(local_id f, int k, double t) const { return held_->curve_uv(f, k, t); }
  vec3 face_point(local_id f, vec2 uv) const { return held_->face_point(f, uv); }
  surface_frame face_frame(local_id f, vec2 uv) const { return held_->face_frame(f, uv); }
  double face_curvature(local_id f, vec2 uv) const { return held_->face_curvature(f, uv); }
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const { return held_->project_to_face(f, p, seed); }
  double project_to_curve(local_id c, vec3 p, double seed) const {
    return held_->project_to_curve(c, p, seed);
  }
  box3 bounds() const { return held_->bounds(); }
  bool thread_safe() const { return held_->thread_safe(); }
  /// Nothing when the held model is no `geometry_model_with_planes`.
  std::optional<surface_frame> plane_of_face(local_id f) const { return held_->plane_of_face(f); }
  /// The face itself when the held model is no `geometry_model_with_members`.
  local_id face_at(local_id f, vec3 p) const { return held_->face_at(f, p); }
  /// Likewise.
  local_id whole_face(local_id f) const { return held_->whole_face(f); }

private:
  struct interface {
    virtual ~interface() = default;
    virtual std::shared_ptr<const interface> copy() const = 0;
    virtual const geometry_topology& topology() const = 0;
    virtual vec3 curve_point(local_id c, double t) const = 0;
    virtual dovetail::curve_frame curve_frame(local_id c, double t) const = 0;
    virtual vec2 curve_uv(local_id f, int k, double t) const = 0;
    virtual vec3 face_point(local_id f, vec2 uv) const = 0;
    virtual surface_frame face_frame(local_id f, vec2 uv) const = 0;
    virtual double face_curvature(local_id f, vec2 uv) const = 0;
    virtual vec2 project_to_face(local_id f, vec3 p, vec2 seed) const = 0;
    virtual double project_to_curve(local_id c, vec3 p, double seed) const = 0;
    virtual box3 bounds() const = 0;
    virtual bool thread_safe() const = 0;
    virtual std::optional<surface_frame> plane_of_face(local_id f) const = 0;
    virtual local_id face_at(local_id f, vec3 p) const = 0;
    virtual local_id whole_face(local_id f) const = 0;
  };

  template <class G>
  struct model final : interface {
    explicit model(G g) : held(std::move(g)) {}
    std::shared_ptr<const interface> copy() const override { return std::make_shared<const model>(held); }
    const geometry_topology& topology() const override { return held.topology(); }
    vec3 curve_point(local_id c, double t) const override {
      return finite(of_curve(c, [&] { return held.curve_point(c, t); }), std::isfinite(t), "curve", c);
    }
    dovetail::curve_frame curve_frame(local_id c, double t) const override {
      const auto frame = of_curve(c, [&] { return held.curve_frame(c, t); });
      finite(frame.point, std::isfinite(t), "curve", c);
      return frame;
    }
    vec2 curve_uv(local_id f, int k, double t) const override {
      return of_face(f, [&] { return held.curve_uv(f, k, t); });
    }
    vec3 face_point(local_id f, vec2 uv) const override {
      return finite(of_face(f, [&] { return held.face_point(f, uv); }), is_number(uv), "face", f);
    }
    surface_frame face_frame(local_id f, vec2 uv) const override {
      const auto frame = of_face(f, [&] { return held.face_frame(f, uv); });
      finite(frame.point, is_number(uv), "face", f);
      return frame;
    }
    double face_curvature(local_id f, vec2 uv) const override {
      return of_face(f, [&] { return held.face_curvature(f, uv); });
    }
    vec2 project_to_face(local_id f, vec3 p, vec2 seed) const override {
      return of_face(f, [&] { return held.project_to_face(f, p, seed); });
    }
    double project_to_curve(local_id c, vec3 p, double seed) const override {
      return of_curve(c, [&] { return held.project_to_curve(c, p, seed); });
    }
    box3 bounds() const override { return held.bounds(); }
    bool thread_safe() const override { return held.thread_safe(); }
    std::optional<surface_frame> plane_of_face(local_id f) const override {
      return dovetail::plane_of_face(held, f);
    }
    local_id face_at(local_id f, vec3 p) const override { return dovetail::face_at(held, f, p); }
    local_id whole_face(local_id f) const override { return dovetail::whole_face(held, f); }
    /// What a model throws that is no error of ours becomes a `geometry_error` that names the entity.
    template <class F>
    static auto of_face(local_id f, const F& query) {
      return call_policy<geometry_error>([&] { return "the model's face " + std::to_string(f); }, query);
    }
    template <class F>
    static auto of_curve(local_id c, const F& query) {
      return call_policy<geometry_error>([&] { return "the model's curve " + std::to_string(c); }, query);
    }
    /// At parameters that are numbers there is a point; who asks elsewhere looks at the answer.
    static vec3 finite(vec3 p, bool asked_by_numbers, const char* kind, local_id id) {
      if (asked_by_numbers && !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
        throw geometry_error("the model's " + std::string(kind) + " " + std::to_string(id) +
                             " has a point that is not finite");
      return p;
    }
    static bool is_number(vec2 uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }
    G held;
  };

  std::shared_ptr<const interface> held_;
};

// Outside of the class: not inline, so that the library's own models are held by code that is compiled once.
template <class G>
  requires(!std::same_as<G, any_geometry> && geometry_model<G>)
any_geometry::any_geometry(G held) : held_(std::make_shared<const model<G>>(std::move(held))) {
  check_topology(topology());
}

static_assert(geometry_model_with_planes<any_geometry> && geometry_model_with_members<any_geometry>);

} // namespace dovetail
