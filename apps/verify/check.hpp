#pragma once

#include <string>
#include <vector>

#include "certificate.hpp"

namespace verify {

enum class Verdict { proved, undecided, refuted };

/// The verdict on a certificate.
struct Finding {
  Verdict verdict = Verdict::proved;
  std::vector<std::string> remarks{};  ///< each claim that isn't proved, with both numbers
  slong bits = 0;                      ///< the precision in which it was decided
};

/// Proves or refutes a certificate, in 64 bits (128 if it has a chatter), then in twice as many until it is decided or
/// there are 1024, or the time of this thread's claim is over.
[[nodiscard]] Finding check(const Certificate& certificate);

}  // namespace verify
