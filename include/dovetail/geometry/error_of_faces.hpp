/// @file
/// Errors that say which faces of a model are to blame, and how entities are called in messages.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <concepts>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// A face, curve or solid of a model in messages: its `number` and, if it has one, its `name`.
/// \param kind "face", "curve" or "solid"
template <std::integral Number>
std::string entity_name(const char* kind, Number number, const std::string& name) {
  return std::string(kind) + " " + std::to_string(number) + (name.empty() ? "" : " (" + name + ")");
}

/// What an error of the library also is when faces of the model are to blame: who has simplified the model
/// may catch it, and keep these as they were drawn.
class blames_faces {
public:
  explicit blames_faces(std::vector<local_id> faces) : faces_(std::move(faces)) {}
  virtual ~blames_faces() = default;

  /// Their numbers in the model.
  const std::vector<local_id>& faces() const { return faces_; }

private:
  std::vector<local_id> faces_;
};

/// An `Error` of the library that names faces.
template <class Error>
class error_of_faces : public Error, public blames_faces {
public:
  /// A message, and the numbers of the faces in the model.
  error_of_faces(const std::string& message, std::vector<local_id> faces)
      : Error(message), blames_faces(std::move(faces)) {}
};

} // namespace dovetail
