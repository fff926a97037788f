/// @file
/// Any simplification rule behind one type, so that the pipeline is compiled once and not once per rule.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/simplification/concepts.hpp"

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace dovetail {

/// Holds any simplification rule for D = 2 and 3; a rule converts to it. Copies share it. What a rule throws
/// that is no error of ours becomes a `usage_error` that names it.
class any_simplification_rule {
public:
  template <class R>
    requires(!std::same_as<R, any_simplification_rule> && simplification_rule<R, 2> &&
             simplification_rule<R, 3>)
  any_simplification_rule(R rule, std::string name = {}) // NOLINT: converts, as any_partitioner does
      : name_(std::move(name)), held_(std::make_shared<const holder<R>>(std::move(rule))) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  side_judgement operator()(const simplicial_mesh<2>& mesh, const side_table<2>& sides) const;
  side_judgement operator()(const simplicial_mesh<3>& mesh, const side_table<3>& sides) const;
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const;
  std::optional<ridge_decision> propagate(const side_below& below) const;
  double penalty(const deficit& missed) const;
  wanted_angles wants(int dimension) const;

private:
  template <class F>
  std::invoke_result_t<const F&> asked(const F& f) const {
    return call_policy<usage_error>([&] { return named_policy("simplification rule", name_); }, f);
  }

  struct interface {
    virtual ~interface() = default;
    virtual side_judgement judge(const simplicial_mesh<2>&, const side_table<2>&) const = 0;
    virtual side_judgement judge(const simplicial_mesh<3>&, const side_table<3>&) const = 0;
    virtual bool prefer_removal(const dihedral_side&, const dihedral_side&) const = 0;
    virtual std::optional<ridge_decision> propagate(const side_below&) const = 0;
    virtual double penalty(const deficit&) const = 0;
    virtual wanted_angles wants(int dimension) const = 0;
  };
  template <class R>
  struct holder final : interface {
    explicit holder(R held) : rule(std::move(held)) {}
    side_judgement judge(const simplicial_mesh<2>& mesh, const side_table<2>& sides) const override {
      return rule(mesh, sides);
    }
    side_judgement judge(const simplicial_mesh<3>& mesh, const side_table<3>& sides) const override {
      return rule(mesh, sides);
    }
    bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const override {
      return rule.prefer_removal(a, b);
    }
    std::optional<ridge_decision> propagate(const side_below& below) const override {
      return rule.propagate(below);
    }
    double penalty(const deficit& missed) const override { return rule.penalty(missed); }
    wanted_angles wants(int dimension) const override {
      return dimension == 2 ? wanted_angles_of<2>(rule) : wanted_angles_of<3>(rule);
    }
    R rule;
  };

  std::string name_;
  std::shared_ptr<const interface> held_;
};
static_assert(simplification_rule<any_simplification_rule, 2> &&
              simplification_rule<any_simplification_rule, 3>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/simplification/any_simplification_rule.ipp"
#endif
