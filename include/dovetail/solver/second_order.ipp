/// @file
/// What `second_order.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/solver/edge_middles.hpp"
#include "dovetail/solver/moving_middles.hpp"
#include "dovetail/solver/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

namespace dovetail::io {

namespace detail {

/// What a check of a piece gives back of its inner edges.
struct checked_piece {
  global_id inner = 0;
  std::int64_t not_found = 0;
  std::int64_t moved = 0;
  std::int64_t straightened = 0;
};
struct moved_edge {
  local_id edge;
  halvings moved;
};
/// The result, as it is kept.
struct kept_middles {
  std::vector<vec3> points;
  std::vector<global_id> inner;
  middle_counts counts;

  using fields = field_list<&kept_middles::points, &kept_middles::inner, &kept_middles::counts>;
};

/// The entity that a side with this number is on, as the model evaluates it.
template <int D>
host host_of_side([[maybe_unused]] const any_geometry& model, local_id number) {
  if constexpr (D == 3)
    return {2, model.whole_face(number)};
  else
    return {1, number};
}

template <int D>
class second_order_pass {
public:
  second_order_pass(const distributed_simplicial_mesh<D>& mesh, const any_geometry& model,
                    const any_executor& run_tasks, const second_order_options& options)
      : mesh_(mesh), model_(model), run_(run_tasks), options_(options),
        nodes_(std::make_shared<mid_edge_nodes<D>>()), of_piece_(mesh.counts.size()) {}

  std::shared_ptr<const mid_edge_nodes<D>> run(report& summary) {
    nodes_->edges = edges_of(mesh_.skeleton);
    if constexpr (D == 2)
      nodes_->inner_points = [model = model_, least = options_.least_jacobian](
                                 const auto& piece, const auto& edges, const auto& nodes) {
        return inner_points(model, least, piece, edges, nodes);
      };
    const content_key key = key_of_result();
    const auto store = lasting_store_of(run_, "middles");
    const auto find_kept = [&] { return store->find_value<kept_middles>(key); };
    if (auto found = store ? once(run_, find_kept) : std::nullopt) {
      take(*std::move(found), summary);
      return nodes_;
    }
    find_hosts();
    curve();
    check();
    const middle_counts counts = counted();
    summary.set(counts);
    if (store && leads(run_))
      store->keep_value(key, kept_middles{nodes_->points, nodes_->inner, counts});
    return nodes_;
  }

private:
  struct face_of_edge {
    local_id edge;
    local_id face;
  };

  content_key key_of_result() const {
    mesh_hasher skeleton;
    hash_skeleton(skeleton, mesh_.skeleton);
    key_maker make;
    make(static_cast<std::int64_t>(skeleton.value()))(options_.least_jacobian);
    for (const auto& piece : mesh_.counts)
      make(piece.inner_points)(piece.elements);
    return make.key();
  }
  void take(kept_middles kept, report& summary) {
    nodes_->points = std::move(kept.points);
    nodes_->inner = std::move(kept.inner);
    summary.set(kept.counts);
  }

  local_id edge_of(const simplex<1>& vertices) const {
    const local_id edge = find_edge(nodes_->edges, vertices);
    if (edge == no_id)
      throw mesh_error("an edge of the skeleton that lies on a CAD curve belongs to none of its sides");
    return edge;
  }
  host& host_of(local_id edge) { return hosts_[edge]; }

  void find_hosts() {
    const auto& skeleton = mesh_.skeleton;
    hosts_.assign(nodes_->edges.size(), {3, no_id});
    if constexpr (D == 2)
      find_faces();
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
      if (skeleton.side_hosts[s] != no_id)
        for (const auto& local : numbering::edges<D - 1>) {
          host& on = host_of(edge_of(vertices_of_edge(skeleton.sides[s], local)));
          on = std::min(on, host_of_side<D>(model_, skeleton.side_hosts[s]));
        }
    for (std::size_t e = 0; e < skeleton.curve_edges.size(); ++e)
      host_of(edge_of(skeleton.curve_edges[e])) = {1, skeleton.curves[e]};
  }

  /// The faces on which lines between subdomains run are known to the triangles at them.
  void find_faces() {
    std::vector<std::size_t> all(mesh_.counts.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    run_pieces(
        all,
        [this](const simplicial_piece<D>& piece) {
          const auto edges = edges_of(piece, *nodes_);
          const auto faces = faces_of_edges(piece.mesh, edges.edges);
          std::vector<face_of_edge> found;
          for (std::size_t k = 0; k < faces.size(); ++k)
            if (edges.in_skeleton[k] != no_id)
              found.push_back({edges.in_skeleton[k], faces[k].id});
          return found;
        },
        [this](std::size_t, const std::vector<face_of_edge>& found) {
          for (const auto& [edge, face] : found)
            host_of(edge) = {2, face};
        });
  }

  /// Edges of an entity follow each other, so that a task samples few of them.
  void curve() {
    constexpr std::size_t batch = 8192;
    middles_.straight = straight_middles(nodes_->edges, mesh_.skeleton.points);
    middles_.curved = middles_.straight;
    middles_.moved.assign(nodes_->edges.size(), 0);
    std::vector<local_id> order;
    for (std::size_t k = 0; k < hosts_.size(); ++k)
      if (on_cad(hosts_[k]))
        order.push_back(static_cast<local_id>(k));
    stable_sort_all(order, [&](local_id a, local_id b) { return host_of(a) < host_of(b); });
    const auto task = [&](std::size_t t) {
      edge_middles middle(model_);
      found_middles found;
      for (std::size_t i = t * batch; i < std::min((t + 1) * batch, order.size()); ++i) {
        const auto& [a, b] = nodes_->edges[order[i]];
        const auto point = [&](local_id v) { return mesh_.skeleton.points[v]; };
        found.find(middle, point(a), point(b), hosts_[order[i]]);
      }
      return std::pair(found.not_found, std::move(found.points));
    };
    auto results = map_tasks(run_, (order.size() + batch - 1) / batch, task, how());
    for (std::size_t t = 0; t < results.size(); ++t) {
      const auto [not_found, points] = result_of(std::move(results[t]), "the skeleton");
      not_found_ += not_found;
      std::size_t i = t * batch;
      for (const vec3 p : points)
        middles_.curved[order[i++]] = p;
    }
  }

  void check() {
    nodes_->inner.assign(mesh_.counts.size(), 0);
    std::vector<std::size_t> unchecked(mesh_.counts.size());
    std::iota(unchecked.begin(), unchecked.end(), std::size_t{0});
    for (; !unchecked.empty(); ++rounds_) {
      std::vector<bool> changed(nodes_->edges.size(), false);
      run_pieces(
          unchecked, [this](const simplicial_piece<D>& piece) { return check_piece(piece); },
          [&](std::size_t piece, const std::pair<checked_piece, std::vector<moved_edge>>& checked) {
            of_piece_[piece] = checked.first;
            for (const auto& [edge, moved] : checked.second) {
              auto& known = middles_.moved[edge];
              changed[edge] = true;
              known = std::max(known, moved);
            }
          });
      unchecked = pieces_at(changed);
    }
    for (std::size_t p = 0; p < of_piece_.size(); ++p)
      nodes_->inner[p] = of_piece_[p].inner;
    for (std::size_t k = 0; k < nodes_->edges.size(); ++k)
      nodes_->points.push_back(middles_.at(k));
  }

  std::vector<std::size_t> pieces_at(const std::vector<bool>& changed) const {
    std::vector<std::size_t> pieces;
    const auto& skeleton = mesh_.skeleton;
    if (std::find(changed.begin(), changed.end(), true) == changed.end())
      return pieces;
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
      for (const auto& local : numbering::edges<D - 1>)
        if (changed[edge_of(vertices_of_edge(skeleton.sides[s], local))])
          for (const local_id p : skeleton.subdomains[s])
            if (p != no_id)
              pieces.push_back(static_cast<std::size_t>(p));
    sort_unique(pieces);
    return pieces;
  }

  /// Runs in a worker.
  std::pair<checked_piece, std::vector<moved_edge>> check_piece(const simplicial_piece<D>& piece) const {
    const auto edges = edges_of(piece, *nodes_);
    found_middles inner;
    moving_middles middles = middles_of(model_, piece, edges, inner);
    for (std::size_t k = 0; k < edges.in_skeleton.size(); ++k)
      if (const local_id shared = edges.in_skeleton[k]; shared != no_id) {
        middles.curved[k] = middles_.curved[shared];
        middles.moved[k] = middles_.moved[shared];
      }
    settle(piece.mesh, edges.edges, middles, options_.least_jacobian, [](std::size_t) { return true; });
    checked_piece result{.not_found = inner.not_found};
    std::vector<moved_edge> moved;
    for (std::size_t k = 0; k < edges.in_skeleton.size(); ++k)
      if (const local_id shared = edges.in_skeleton[k]; shared == no_id) {
        ++result.inner;
        result.moved += middles.moved[k] > 0 ? 1 : 0;
        result.straightened += middles.moved[k] == all_the_way ? 1 : 0;
      } else if (middles.moved[k] > middles_.moved[shared])
        moved.push_back({shared, middles.moved[k]});
    return {result, std::move(moved)};
  }

  /// Those of inner edges; of the others the straight ones.
  static moving_middles middles_of(const any_geometry& model, const simplicial_piece<D>& piece,
                                   const piece_edges<D>& edges, found_middles& inner) {
    const auto& vertices = edges.edges.vertices;
    moving_middles middles;
    middles.straight = straight_middles(vertices, piece.mesh.points);
    middles.curved = middles.straight;
    middles.moved.assign(vertices.size(), 0);
    if constexpr (D == 2) {
      edge_middles middle(model);
      const auto faces = faces_of_edges(piece.mesh, edges.edges);
      for (std::size_t k = 0; k < vertices.size(); ++k)
        if (edges.in_skeleton[k] == no_id) {
          inner.find(middle, piece.mesh.points[vertices[k][0]], piece.mesh.points[vertices[k][1]], faces[k]);
          middles.curved[k] = inner.points.back();
        }
    }
    return middles;
  }

  /// What the last check of the piece has found, when those of the skeleton are where they stay.
  static std::vector<vec3> inner_points(const any_geometry& model, double least,
                                        const simplicial_piece<D>& piece, const piece_edges<D>& edges,
                                        const mid_edge_nodes<D>& nodes) {
    found_middles inner;
    moving_middles middles = middles_of(model, piece, edges, inner);
    const auto is_inner = [&](std::size_t k) { return edges.in_skeleton[k] == no_id; };
    for (std::size_t k = 0; k < edges.in_skeleton.size(); ++k)
      if (!is_inner(k))
        middles.curved[k] = nodes.points[edges.in_skeleton[k]];
    settle(piece.mesh, edges.edges, middles, least, is_inner);
    std::vector<vec3> points;
    for (std::size_t k = 0; k < edges.in_skeleton.size(); ++k)
      if (is_inner(k))
        points.push_back(middles.at(k));
    return points;
  }

  run_options how() const {
    run_options tasks;
    tasks.limit_seconds = options_.limit_seconds;
    tasks.on_progress = options_.on_progress;
    tasks.stage = "second order";
    return tasks;
  }
  template <class T>
  static T result_of(task_result<T> result, const std::string& of) {
    if (!result.value)
      throw mesh_error("the middles of edges of " + of + " could not be found: " + result.failure);
    return *std::move(result.value);
  }
  template <class Task, class Take>
  void run_pieces(const std::vector<std::size_t>& pieces, const Task& task, const Take& take) {
    auto results = map_tasks(
        run_, pieces.size(),
        [&](std::size_t i) { return task(load_checked(mesh_, static_cast<local_id>(pieces[i]))); }, how());
    for (std::size_t i = 0; i < pieces.size(); ++i)
      take(pieces[i], result_of(std::move(results[i]), "subdomain " + std::to_string(pieces[i])));
  }

  middle_counts counted() const {
    middle_counts counts = count_middles(hosts_, middles_, not_found_);
    for (const auto& piece : of_piece_) {
      counts.nodes += piece.inner;
      counts.on_cad += D == 2 ? piece.inner : 0;
      counts.not_found += piece.not_found;
      counts.moved_back += piece.moved;
      counts.straightened += piece.straightened;
    }
    counts.rounds = rounds_;
    return counts;
  }

  const distributed_simplicial_mesh<D>& mesh_;
  const any_geometry& model_;
  const any_executor& run_;
  const second_order_options& options_;
  std::shared_ptr<mid_edge_nodes<D>> nodes_;
  std::vector<checked_piece> of_piece_;
  std::vector<host> hosts_; ///< per edge of the skeleton
  moving_middles middles_;  ///< of these
  std::int64_t not_found_ = 0;
  std::int64_t rounds_ = 0;
};

/// The entity of each edge of a gathered mesh.
template <int D>
std::vector<host> hosts_of_edges(const gathered_mesh<D>& mesh, const edge_table<D>& edges,
                                 const any_geometry& model) {
  std::vector<host> hosts(edges.vertices.size());
  if constexpr (D == 2)
    hosts = faces_of_edges(mesh.mesh, edges);
  const auto at = [&](const simplex<1>& vertices) -> host& {
    return hosts[find_edge(edges.vertices, vertices)];
  };
  for (std::size_t s = 0; s < mesh.sides.size(); ++s)
    for (const auto& local : numbering::edges<D - 1>) {
      host& on = at(vertices_of_edge(mesh.sides[s], local));
      on = std::min(on, host_of_side<D>(model, mesh.side_hosts[s]));
    }
  for (std::size_t e = 0; e < mesh.curve_edges.size(); ++e)
    at(mesh.curve_edges[e]) = {1, mesh.curves[e]};
  return hosts;
}

} // namespace detail

template <int D>
report add_mid_nodes(distributed_simplicial_mesh<D>& mesh, const any_geometry& model,
                     const any_executor& run_tasks, const second_order_options& options) {
  const stopwatch clock;
  report summary{"second order", 0, {}, {}, {}};
  mesh.mid_nodes = detail::second_order_pass<D>(mesh, model, run_tasks, options).run(summary);
  detail::warn_of_middles(summary.as<middle_counts>(), summary);
  summary.seconds = clock.seconds();
  return summary;
}

template <int D>
second_order_mesh<D> second_order(const gathered_mesh<D>& mesh, const any_geometry& model,
                                  const second_order_options& options) {
  const stopwatch clock;
  const auto& corners = mesh.mesh.points;
  const auto edges = build_edges<D>(span_of(mesh.mesh.elements), corners.size());
  const auto hosts = detail::hosts_of_edges(mesh, edges, model);
  detail::moving_middles middles;
  middles.straight = detail::straight_middles(edges.vertices, corners);
  middles.moved.assign(hosts.size(), 0);
  edge_middles middle(model);
  detail::found_middles found;
  for (std::size_t k = 0; k < hosts.size(); ++k) {
    const auto& [a, b] = edges.vertices[k];
    found.find(middle, corners[a], corners[b], hosts[k]);
  }
  middles.curved = std::move(found.points);
  detail::settle(mesh.mesh, edges, middles, options.least_jacobian, [](std::size_t) { return true; });

  second_order_mesh<D> result{corners, {}, {}, {"second order", 0, {}, {}, {}}};
  for (std::size_t k = 0; k < hosts.size(); ++k)
    result.points.push_back(middles.at(k));
  const auto first = static_cast<local_id>(corners.size());
  const auto quadratic = [&]<int K>(const simplex<K>& simple, quadratic_simplex<K>& nodes) {
    std::copy(simple.begin(), simple.end(), nodes.begin());
    for (std::size_t i = 0; i < edges_per_element<K>; ++i)
      nodes[K + 1 + i] = first + find_edge(edges.vertices, vertices_of_edge(simple, numbering::edges<K>[i]));
  };
  for (const auto& element : mesh.mesh.elements)
    quadratic.template operator()<D>(element, result.elements.emplace_back());
  for (const auto& side : mesh.sides)
    quadratic.template operator()<D - 1>(side, result.sides.emplace_back());
  const middle_counts counts = detail::count_middles(hosts, middles, found.not_found);
  result.summary.set(counts);
  detail::warn_of_middles(counts, result.summary);
  result.summary.seconds = clock.seconds();
  return result;
}

#ifdef DOVETAIL_COMPILED
template report add_mid_nodes<2>(distributed_simplicial_mesh<2>&, const any_geometry&, const any_executor&,
                                 const second_order_options&);
template report add_mid_nodes<3>(distributed_simplicial_mesh<3>&, const any_geometry&, const any_executor&,
                                 const second_order_options&);
template second_order_mesh<2> second_order<2>(const gathered_mesh<2>&, const any_geometry&,
                                              const second_order_options&);
template second_order_mesh<3> second_order<3>(const gathered_mesh<3>&, const any_geometry&,
                                              const second_order_options&);
#endif

} // namespace dovetail::io
