#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "results/dataset.hpp"

namespace clatter::results {

/// The variable of a name; null if there is none.
inline const Variable* find(const Dataset& figure, const std::string& name) {
  const auto found =
      std::find_if(figure.variables.begin(), figure.variables.end(), [&](const Variable& v) { return v.name == name; });
  return found == figure.variables.end() ? nullptr : &*found;
}

/// The values of a variable of numbers. Throws std::out_of_range if there is none.
inline const std::vector<double>& values(const Dataset& figure, const std::string& name) {
  const Variable* variable = find(figure, name);
  if (!variable) throw std::out_of_range("no variable " + name);
  return std::get<std::vector<double>>(variable->values);
}

inline std::vector<std::uint8_t> statuses(const Dataset& figure) {
  return std::get<std::vector<std::uint8_t>>(find(figure, "status")->values);
}

/// The same bits, NaN included.
inline void expect_same(const Dataset& a, const Dataset& b) {
  ASSERT_EQ(a.variables.size(), b.variables.size());
  for (std::size_t i = 0; i < a.variables.size(); ++i) {
    ASSERT_EQ(a.variables[i].name, b.variables[i].name);
    std::visit(
        [&](const auto& left) {
          const auto& right = std::get<std::decay_t<decltype(left)>>(b.variables[i].values);
          ASSERT_EQ(left.size(), right.size());
          if constexpr (std::is_same_v<decltype(left), const std::vector<std::string>&>)
            EXPECT_EQ(left, right) << a.variables[i].name;
          else
            EXPECT_EQ(std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])), 0) << a.variables[i].name;
        },
        a.variables[i].values);
  }
}

}  // namespace clatter::results
