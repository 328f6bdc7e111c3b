#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace clatter {
inline namespace math {

/// The reference number type: 50 decimal digits, without expression templates, so that source written for double
/// compiles without casts.
using FiftyDigits =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

}  // namespace math
}  // namespace clatter
