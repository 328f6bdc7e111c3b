#pragma once

namespace clatter::plan {

/// The least and the greatest possible value of an estimate.
struct Bounds {
  double least = 0.0, most = 0.0;

  Bounds& operator+=(const Bounds& other) {
    least += other.least, most += other.most;
    return *this;
  }
};

inline Bounds operator*(const Bounds& estimate, double factor) {
  return {estimate.least * factor, estimate.most * factor};
}

}  // namespace clatter::plan
