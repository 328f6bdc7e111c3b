#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/written_config.hpp"

namespace clatter::config {

/// A configuration with a mistake, and what must be said of it.
struct Wrong {
  std::string text;
  std::string location;  ///< "line:column"
  std::string words;
};

inline void expect_all(const std::string& name, const std::vector<Wrong>& table) {
  for (const Wrong& wrong : table) {
    const std::string mistake = mistake_in(name, wrong.text);
    EXPECT_TRUE(mistake.starts_with(name + ':' + wrong.location + ": ")) << wrong.text << "\ngave " << mistake;
    EXPECT_NE(mistake.find(wrong.words), std::string::npos) << wrong.text << "\ngave " << mistake;
    EXPECT_EQ(mistake.find('\n'), std::string::npos) << mistake;
  }
}

}  // namespace clatter::config
