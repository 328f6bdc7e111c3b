#pragma once

#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// The result of a run of a problem, certified.
inline CertifiedPoint certified_run(const point::Problem& problem) {
  point::ThreadScratch scratch;
  return certified(problem, {problem, point::run_point(problem, scratch)}, scratch);
}

}  // namespace clatter::certificates
