#pragma once

#include <string>

#include "config/config.hpp"
#include "terminal/command_line.hpp"

namespace clatter::app {

/// Options that begin a branch at a point of an output.
inline const Option from_option{"from", 0, "FILE.h5",
                                "start from a point of this output of `clatter run` or `clatter branch`"};

/// A configuration with the start that its branch begins with.
struct BranchStart {
  config::Config config;
  std::string file;  ///< the name of the configuration, for messages
  std::string note;  ///< "starts from 'map.h5' at nu = 1.2, period 2"; empty: from the scene
};

/// The configuration of the first operand, or without one that of --from, changed by --set. With --from the parameters
/// that the output varies, and those that the branch is followed along, have their values at the point that --where
/// chooses, and start and period are those of its motion; all of that is in the configuration's text, too. Throws
/// UsageError, also if the scenes differ in anything else, ConfigError and IoError.
[[nodiscard]] BranchStart branch_start_of(const Arguments& arguments);

}  // namespace clatter::app
