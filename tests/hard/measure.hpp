#pragma once

#include <limits>
#include <string>

#include "hard/cases.hpp"
#include "support/deviation.hpp"

namespace clatter::hard {

/// The measurements of a hard case, for its line in tests/README.md.
struct Measured {
  accuracy::RunRecord record;
  double error = 0.0;  ///< largest error of a time, a speed or the end, each relative (see Deviation)
  double one_ulp = std::numeric_limits<double>::quiet_NaN();  ///< the same when the inputs are moved by one ulp;
                                                              ///< NaN: not measured
  std::size_t impacts = 0, chatters = 0, rests = 0;
};

/// Appends a line to the file that the environment variable CLATTER_HARD_CASES names, if it is set.
void report(const Case& one, const Measured& measured);

/// Runs a case in double and in 50 digits, reports it, and expects that it is completed with the same impacts and rests
/// and an error of at most 64 times the effect of one ulp of its inputs, or 64 times `rounding`, that of an ulp of
/// time.
Measured expect_agreement(const Case& one, double rounding = epsilon<double>());

/// The same for all cases of a row.
void expect_agreement(const std::string& row);

}  // namespace clatter::hard
