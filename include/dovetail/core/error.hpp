/// @file
/// The typed exceptions of the library. Every message names the file or entity concerned and what to do.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace dovetail {

/// Base of all errors that the library throws on purpose.
class error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A file that is missing, empty, truncated, foreign or malformed.
class input_error : public error {
public:
  using error::error;
};

/// A shape that cannot be meshed as it is: no solid, open or self-intersecting surface, degenerate entity.
class geometry_error : public error {
public:
  using error::error;
};

/// A sizing field or size out of range, or a sizing file with a wrong key or value.
class sizing_error : public error {
public:
  using error::error;
};

/// Two parts of a surface cross and refinement did not separate them.
class intersection_error : public error {
public:
  using error::error;
};

/// A partitioner could not keep its promises.
class partition_error : public error {
public:
  using error::error;
};

/// A mesher or remesher failed on its input, or its result failed the checks made on it.
class mesher_error : public error {
public:
  using error::error;
};

/// A policy was stopped by a limit of wall-clock time: what is done instead is decided by the machine's load.
class time_limit_error : public mesher_error {
public:
  using mesher_error::mesher_error;
};

/// A mesh that breaks the invariants a function requires.
class mesh_error : public error {
public:
  using error::error;
};

/// Output that could not be written: folder, permission, disk space.
class io_error : public error {
public:
  using error::error;
};

/// A policy was used where its traits forbid it, for example `processes` in a process with threads.
class usage_error : public error {
public:
  using error::error;
};

/// Another rank of the run goes no further, or is gone.
class communication_error : public error {
public:
  using error::error;
};

/// The caller asked to stop.
class cancelled : public error {
public:
  cancelled() : error("cancelled") {}
};

/// Calls what somebody else wrote. What it throws that is none of the errors above becomes an `Error`, which
/// begins with `who()`; a lack of memory stays what it is. Costs nothing where nothing is thrown.
template <class Error, class Who, class F>
decltype(auto) call_policy(const Who& who, const F& f) {
  try {
    return f();
  } catch (const error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(who() + " threw: " + problem.what());
  } catch (...) {
    throw Error(who() + " threw what is no std::exception");
  }
}

/// "the mesher 'mine'"; without quotes when it has no name.
inline std::string named_policy(const std::string& role, const std::string& name) {
  return "the " + role + (name.empty() ? name : " '" + name + "'");
}

} // namespace dovetail
