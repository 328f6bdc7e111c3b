#pragma once

namespace clatter {

/// The least and the greatest that something can come to.
struct Estimate {
  double least = 0.0, most = 0.0;

  Estimate& operator+=(const Estimate& other) {
    least += other.least, most += other.most;
    return *this;
  }
};

inline Estimate operator*(const Estimate& estimate, double factor) {
  return {estimate.least * factor, estimate.most * factor};
}

}  // namespace clatter
