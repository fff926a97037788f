/// @file
/// Adapter: what the adapters of Scotch and PT-Scotch have in common.
#pragma once

#include "dovetail/core/error.hpp"

#include <cstdint> // scotch.h does not include what it needs
#include <cstdio>
#include <scotch.h>

#include <string>

namespace dovetail::partition {

/// What Scotch is told to strive for: small cuts (`quality`), little time (`speed`) or even weights
/// (`balance`).
enum class scotch_strategy { quality, speed, balance };

} // namespace dovetail::partition

namespace dovetail::detail {

/// Scotch's functions return 0 when all is well.
inline void require_scotch(int status, const char* what) {
  if (status != 0)
    throw partition_error(std::string("Scotch failed to ") + what + ", status " + std::to_string(status) +
                          "; use another partitioner");
}

/// One of Scotch's objects, released when it goes out of scope.
template <class Object, void (*Exit)(Object*)>
struct scotch_object {
  template <class Init>
  scotch_object(const Init& init, const char* what) {
    require_scotch(init(&object), what);
  }
  scotch_object(const scotch_object&) = delete;
  scotch_object& operator=(const scotch_object&) = delete;
  ~scotch_object() { Exit(&object); }
  Object object;
};
using scotch_strategy_object = scotch_object<SCOTCH_Strat, SCOTCH_stratExit>;

/// One thread, with random numbers of its own.
struct scotch_context : scotch_object<SCOTCH_Context, SCOTCH_contextExit> {
  explicit scotch_context(int seed) : scotch_object(SCOTCH_contextInit, "start") {
    require_scotch(SCOTCH_contextOptionSetNum(&object, SCOTCH_OPTIONNUMDETERMINISTIC, 1), "be deterministic");
    require_scotch(SCOTCH_contextThreadSpawn(&object, 1, nullptr), "run in one thread");
    require_scotch(SCOTCH_contextRandomClone(&object), "make random numbers");
    SCOTCH_contextRandomSeed(&object, seed);
    SCOTCH_contextRandomReset(&object);
  }
};

inline SCOTCH_Num flag_of(partition::scotch_strategy strategy) {
  switch (strategy) {
  case partition::scotch_strategy::speed:
    return SCOTCH_STRATSPEED;
  case partition::scotch_strategy::balance:
    return SCOTCH_STRATBALANCE;
  default:
    return SCOTCH_STRATQUALITY;
  }
}

} // namespace dovetail::detail
