#pragma once

#include <string>
#include <vector>

#include "point/problem.hpp"

namespace clatter::hard {

/// A scene that numerical methods get wrong, run from its start for a time in tau.
struct Case {
  std::string row;   ///< row of the table of hard cases, and the name of the file that tests it
  std::string what;  ///< name of the case in its row
  point::Problem scene;
  double duration;
};

/// Every case, in the order of the table.
[[nodiscard]] const std::vector<Case>& cases();

/// The cases of one row. Throws std::out_of_range if there are none.
[[nodiscard]] std::vector<Case> cases_of(const std::string& row);

/// The case of a row that is called `what`. Throws std::out_of_range if there is none.
[[nodiscard]] const Case& case_of(const std::string& row, const std::string& what);

}  // namespace clatter::hard
