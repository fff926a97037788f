/// @file
/// The model and sizing field that a command line asks for.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "options.hpp"

#include "dovetail/core/report.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/erased.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

/// Sizes as a command line gives them: a JSON file, one length, how to find them by the model, or nothing.
class given_sizes {
public:
  /// Finds what is wrong without a model: throws `command_line_error` for a size that is no length and other
  /// numbers out of range, and for a file that cannot be used the library's errors.
  given_sizes(std::string file, const std::optional<double>& size);
  explicit given_sizes(const model_options& options);

  /// The file's field, the automatic one or the uniform one; empty when none is given. The first two may ask
  /// for sizes from the model, if there is one. `meshes` receives the checksum of the meshes that the file
  /// names. Throws `sizing_error` for a size that does not suit the domain.
  any_sizing field(const box3& domain, const any_geometry* model = nullptr, std::string* meshes = nullptr,
                   const any_executor& run = parallel::serial{}) const;
  /// What the automatic field is made of, sizes in thin walls included or not; empty when the sizes are not
  /// automatic.
  std::optional<automatic_points> points(const any_geometry& model, bool in_thin_walls,
                                         const any_executor& run) const;
  bool has_file() const { return !file_.empty(); }
  bool is_automatic() const { return automatic_.has_value(); }
  const std::string& text() const { return text_; } ///< of the file, wherever it came from
  /// The one length, if it is given and suits the domain.
  std::optional<double> length(const box3& domain) const;

private:
  std::string file_;
  std::string text_; ///< of the file, which is read once: it may be a pipe
  std::optional<double> size_;
  std::optional<automatic_options> automatic_; ///< its largest size is `size_`
};

/// No automatic size is smaller than the model's diagonal over this, in thin walls.
inline constexpr double most_sizes_across = 5000;
/// The same at details, which need far fewer elements.
inline constexpr double most_sizes_across_at_details = 50'000;

struct model_source {
  std::string name; ///< for the summary
  any_geometry geometry;
  any_sizing size;
  report summary;              ///< of reading and healing
  std::string file{};          ///< checksum of what was read of the model; empty for a built-in one
  std::string sizing{};        ///< of the text of the sizing file; empty without one
  std::string sizing_meshes{}; ///< of the meshes that it names; empty when it names none
  std::function<std::optional<double>()> volume{}; ///< of the model; empty where it does not know it
  std::vector<suppressed_detail> suppressed{};     ///< what of the model is left out
  std::optional<double> own_size{}; ///< the ambient size of a built-in model, which a given size scales
  /// Of automatic sizes that have not been made smaller for thin walls yet, if there are such walls.
  std::optional<automatic_points> thin_walls{};
  any_sizing size_of_details{}; ///< what the size was before; empty when it is `size`
};

/// Reads or builds the model and its sizing field. Throws `command_line_error` for options that contradict
/// each other, and the library's errors for files and sizes that cannot be used. For elements of dimension 2,
/// faces of a CAD file need not enclose solids. What takes long of automatic sizes is divided through `run`.
model_source load_model(const model_options& options, int dimension = 3,
                        const any_executor& run = parallel::serial{});

/// Whether it is a CAD file, and no pipe.
bool may_be_read_again(const std::string& file);

/// Whether a CAD file has faces as near to each other as `options.join`, which is given.
bool has_faces_to_join(const model_options& options, int dimension);

/// The geometry alone of a file, or of the built-in model of that name; a file comes first. Throws the
/// library's errors, and `input_error` when there is neither.
any_geometry load_geometry(const std::string& file_or_name, const std::string& unit, int dimension,
                           const std::optional<double>& join = {});

} // namespace dovetail::app
