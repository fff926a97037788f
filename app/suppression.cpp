#include "suppression.hpp"

#include "failure.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/kept_details.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dovetail::app {

namespace {

void drop_part(model_source& source, const std::string& name) {
  std::erase_if(source.summary.children, [&](const report& part) { return part.name == name; });
}

/// What is said of details of the source.
void forget(model_source& source) {
  drop_part(source, "virtual topology");
  source.suppressed.clear();
}

/// `most_of_wanted`: share of the elements asked for that details may need.
report account_of(const detail_fit& fit, double most_elements, double most_of_wanted) {
  report account;
  account.name = "kept details";
  account.set(fit);
  if (fit.left > 0)
    account.warnings.push_back(
        "sizes fit " + std::to_string(fit.fitted) + " of " + std::to_string(fit.fitted + fit.left) +
        " details that are far smaller than the size, and elements at the others are flat: to fit all takes "
        "about " +
        number_text(fit.elements_of_all, 3) + " elements more, and " + number_text(most_elements, 3) +
        " are allowed; give --elements of at least " + number_text(fit.elements_of_all / most_of_wanted, 3) +
        ", or leave details out by --suppress");
  return account;
}

} // namespace

suppression::suppression(const model_options& options, int dimension)
    : options_(options), dimension_(dimension) {
  if (options.suppress && (!(*options.suppress > 0) || !std::isfinite(*options.suppress)))
    throw command_line_error("--suppress: " + number_text(*options.suppress) +
                             " is not a length; give a positive number, or --keep-all");
}

void suppression::apply(model_source& source) {
  given_size_ = source.size;
  as_drawn_.reset();
  kept_.clear();
  joined_to_blame_ = 0;
  if (!options_.keep_all) {
    as_drawn_ = source.geometry;
    simplify(source);
  }
  fit_sizes(source);
}

void suppression::fit_sizes(model_source& source) const {
  if (!options_.has_automatic_sizes() || options_.proximity == 0.0)
    return;
  constexpr double most_by_default = 2e5, most_of_wanted = 0.2;
  kept_detail_options allowed;
  allowed.least_size = source.geometry.bounds().diagonal() / most_sizes_across_at_details;
  allowed.growth = options_.growth.value_or(allowed.growth);
  allowed.most_elements = options_.elements ? most_of_wanted * *options_.elements : most_by_default;
  allowed.dimension = dimension_;
  const detail_fit fit = details_to_fit(source.geometry, given_size_, allowed);
  source.size = finer_at(size_beside(fit), fit.places, allowed.growth);
  drop_part(source, "kept details");
  if (fit.fitted + fit.left > 0)
    source.summary.children.push_back(account_of(fit, allowed.most_elements, most_of_wanted));
}

any_sizing suppression::size_beside(const detail_fit& fit) const {
  if (!options_.elements || fit.elements == 0)
    return given_size_;
  const double others = *options_.elements - fit.elements;
  return keep_bounds(
      scaled<any_sizing>(given_size_, std::pow(*options_.elements / others, 1.0 / dimension_)));
}

void suppression::simplify(model_source& source) {
  virtual_options options{.kept_faces = kept_};
  if (options_.suppress)
    options.share_of_size = 1;
  // In D = 2 the faces are what is meshed, each for itself.
  if (dimension_ == 2 || joined_to_blame_ > most_joined_to_blame)
    options.share_of_joined = 0;
  const any_sizing size = options_.suppress        ? any_sizing(uniform_size(*options_.suppress))
                          : source.size_of_details ? source.size_of_details
                                                   : given_size_;
  forget(source);
  const virtual_model model(*as_drawn_, size, options);
  if (model.suppressed().empty()) {
    source.geometry = *std::exchange(as_drawn_, std::nullopt);
    return;
  }
  source.summary.children.push_back(model.summary());
  source.suppressed = model.suppressed();
  source.geometry = any_geometry(model);
}

bool suppression::is_joined(const any_geometry& model, const std::vector<local_id>& faces) {
  for (std::size_t k = 0; k < model.topology().faces.size(); ++k)
    if (const auto f = static_cast<local_id>(k), whole = model.whole_face(f);
        whole != f && std::find(faces.begin(), faces.end(), whole) != faces.end())
      return true;
  return false;
}

bool suppression::keep(model_source& source, const std::vector<local_id>& faces) {
  if (!as_drawn_)
    return false;
  joined_to_blame_ += is_joined(source.geometry, faces) ? 1 : 0;
  const auto is_new = [&](local_id f) { return std::find(kept_.begin(), kept_.end(), f) == kept_.end(); };
  if (kept_.size() < most_kept && std::any_of(faces.begin(), faces.end(), is_new)) {
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(kept_), is_new);
    simplify(source);
    fit_sizes(source);
    return true;
  }
  source.geometry = *std::exchange(as_drawn_, std::nullopt);
  fit_sizes(source);
  forget(source);
  source.summary.warnings.push_back(
      "the model is meshed with all its details: without some of them it could not be");
  return true;
}

} // namespace dovetail::app
