#pragma once

#include "report.hpp"

namespace verify {

/// Whether a special point of the claimed kind lies within the claimed errors.
void check_special(const Certificate& certificate, Report& report);

}  // namespace verify
