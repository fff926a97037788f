/// @file
/// TetGen's entry point, kept apart from other libraries that contain a TetGen of their own.
///
/// Gmsh exports a changed copy of the class `tetgenmesh` under the same name. In a program linked to both,
/// the dynamic linker gives both libraries the functions of whichever comes first, and the other one crashes:
/// HXT died on most inputs. So where TetGen is a shared library, the build defines
/// DOVETAIL_TETGEN_SHARED_LIBRARY, its path, instead of linking it; it is then loaded with its symbols bound
/// to itself and visible to no one else.
#pragma once

#include "dovetail/core/error.hpp"

#ifndef TETLIBRARY
#define TETLIBRARY // declares the library's interface and makes its errors exceptions
#endif
#include <tetgen.h>
#undef REAL // a macro; MPI has a constant of this name

#include <string>

#ifdef DOVETAIL_TETGEN_SHARED_LIBRARY
#include <dlfcn.h>
#endif

namespace dovetail::detail {

using tetgen_function = void(char* switches, tetgenio* in, tetgenio* out, tetgenio* added,
                             tetgenio* background);

#ifdef DOVETAIL_TETGEN_SHARED_LIBRARY

/// Loads the library at the first call. Throws `mesher_error` when it is not there.
inline tetgen_function* tetgen_entry() {
  static tetgen_function* const entry = [] {
#ifdef __SANITIZE_ADDRESS__
    constexpr int binding = RTLD_NOW | RTLD_LOCAL; // the sanitizer's runtime forbids RTLD_DEEPBIND
#else
    constexpr int binding = RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND;
#endif
    void* const library = ::dlopen(DOVETAIL_TETGEN_SHARED_LIBRARY, binding); // stays for the program's life
    // The mangled name of tetrahedralize(char*, tetgenio*, tetgenio*, tetgenio*, tetgenio*).
    void* const symbol =
        library != nullptr ? ::dlsym(library, "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_") : nullptr;
    if (symbol == nullptr)
      throw mesher_error(std::string("TetGen cannot be loaded: ") + ::dlerror());
    return reinterpret_cast<tetgen_function*>(symbol);
  }();
  return entry;
}

#else

inline tetgen_function* tetgen_entry() {
  return static_cast<tetgen_function*>(&tetrahedralize);
}

#endif

} // namespace dovetail::detail
