/// @file
/// How functions that no policy touches are linked, and the pipeline's, instantiated with `any_parameters`.
///
/// `x.hpp` declares them and `x.ipp` beside it defines them. Header-only, the default, x.hpp includes x.ipp.
/// With DOVETAIL_COMPILED, which the CMake target dovetail::compiled defines, x.hpp ends with its
/// declarations, and the definitions are compiled once, into that target's library. DOVETAIL_COMPILED_OCCT,
/// of dovetail::compiled_occt, does the same for the adapter of Open CASCADE, and DOVETAIL_COMPILED_CGAL, of
/// dovetail::compiled_cgal, for those of CGAL.
#pragma once

#ifdef DOVETAIL_COMPILED
#define DOVETAIL_INLINE
#else
#define DOVETAIL_INLINE inline
#endif

#ifdef DOVETAIL_COMPILED_OCCT
#define DOVETAIL_INLINE_OCCT
#else
#define DOVETAIL_INLINE_OCCT inline
#endif

#ifdef DOVETAIL_COMPILED_CGAL
#define DOVETAIL_INLINE_CGAL
#else
#define DOVETAIL_INLINE_CGAL inline
#endif
