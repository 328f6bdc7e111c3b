#pragma once

#include <functional>
#include <string>

#include "result.hpp"

namespace verify {

/// How files are examined.
struct Manner {
  unsigned threads = 1;
  double limit = 60;  ///< seconds for a claim
  std::function<Finding(const Certificate&)> check = verify::check;
};

/// Examines the lines of a file of certificates; `-` is standard input.
void examine_file(const std::string& name, const Manner& manner, Result& result);

}  // namespace verify
